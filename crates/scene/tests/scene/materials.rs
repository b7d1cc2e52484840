//! `[[materials]]`: the elements of each, and its errors at their lines.

use crate::errors::assert_refused;
use crate::{LEAST, body, edit};

const LEFT: &str = "[[materials]]\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\nmodel = \"linear\"\nyoung = 1e3\n\
     poisson = 0.3\ndensity = 2000.0\n";

#[test]
fn elements_belong_to_the_last_table_whose_region_holds_their_centroid() {
    let body = body(&format!("{LEAST}{LEFT}")).unwrap();
    // The box rule: the elements of the left cube come first.
    assert_eq!(body.regions[0].elements, (0..6).collect::<Vec<_>>());
    assert_eq!((&body.regions[0].material.model[..], &body.material.model[..]), ("linear", "neo_hookean"));
    assert_eq!(body.density_factors, [[2.0; 6], [1.0; 6]].concat());
    let all = edit(LEFT, "box = { min = [0, 0, 0], max = [1, 1, 1] }", "on = \"all\"");
    let two = crate::body(&format!("{LEAST}{all}{LEFT}")).unwrap();
    let names: Vec<_> = two.regions.iter().map(|region| (&region.name[..], region.elements.len())).collect();
    assert_eq!(names, [("materials[0]", 6), ("materials[1]", 6)]);
    let hidden = crate::body(&format!("{LEAST}{LEFT}{all}")).unwrap();
    assert_eq!((hidden.regions.len(), &hidden.regions[0].name[..]), (1, "materials[1]"));
}

#[test]
fn the_centre_of_mass_is_that_of_all_materials() {
    let spin = "[[initial_velocity]]\nangular = { axis = [0, 0, 1], rate = 1 }\n";
    let velocity = body(&format!("{LEAST}{LEFT}{spin}")).unwrap().initial_velocity[0];
    // 2 kg at ½ and 1 kg at 3/2: the centre lies at 5/6.
    assert!((velocity.y + 5.0 / 6.0).abs() < 1e-14, "{velocity}");
}

#[test]
fn materials_are_checked_at_their_line() {
    let refused = |from: &str, to: &str, line: usize, beginning: &str| {
        assert_refused(&format!("{LEAST}{}", edit(LEFT, from, to)), line, beginning);
    };
    refused("density = 2000.0", "density = 0", 17, "materials[0].density is 0; give a positive number of kg/m³");
    refused("young = 1e3", "young = -1", 15, "materials[0].young is -1; give a positive number of Pa");
    refused("\"linear\"", "\"rubber\"", 14, "materials[0].model is `rubber`, which is no law");
    refused("young = 1e3", "C = 1e3", 15, "materials[0].C belongs to neo_hookean; give this model");
    refused(
        "box = { min = [0, 0, 0], max = [1, 1, 1] }\n",
        "",
        12,
        "materials[0] needs one of on, box, sphere and set",
    );
    let outside = format!("{LEAST}{}", edit(LEFT, "max = [1, 1, 1]", "max = [0.1, 1, 1]"));
    let message = body(&outside).unwrap_err().to_string();
    assert!(message.contains("materials[0].box") && message.contains("names no element"), "{message}");
}
