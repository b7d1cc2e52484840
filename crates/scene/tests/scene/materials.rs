//! `[[materials]]`: the elements of each, and its errors at their lines.

use fem_model::Law;

use crate::errors::assert_refused;
use crate::{LEAST, body, edit};

const LEFT: &str = "[[materials]]\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\nmodel = \"linear\"\nyoung = 1e3\n\
     poisson = 0.3\ndensity = 2000.0\n";

#[test]
fn elements_belong_to_the_last_table_whose_region_holds_their_centroid() {
    let body = body(&format!("{LEAST}{LEFT}")).unwrap();
    // The box rule: the elements of the left cube come first.
    assert_eq!(body.regions[0].elements, (0..6).collect::<Vec<_>>());
    assert_eq!((body.regions[0].material.law.name(), body.material.law.name()), ("linear", "neo_hookean"));
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
    refused("young = 1e3", "C = 1e3", 15, "materials[0].C belongs to neo_hookean, gent; give this model");
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

/// The warnings of a scene.
fn warnings(text: &str) -> Vec<String> {
    fem_scene::warnings(&crate::read(text), &body(text).unwrap())
}

#[test]
fn a_poissons_ratio_above_0_45_is_warned_of_in_every_material() {
    let of = |poisson: &str| edit(LEFT, "poisson = 0.3", &format!("poisson = {poisson}"));
    assert!(warnings(&format!("{LEAST}{LEFT}{}", of("0.45"))).is_empty());
    let found = warnings(&format!("{LEAST}{}{LEFT}", of("0.46").replace("[1, 1, 1]", "[2, 1, 1]")));
    assert_eq!(found.len(), 1, "{found:?}");
    let beginning = "folder/name.toml: materials[0]: Poisson's ratio is 0.4600, and linear tetrahedra lock near ½";
    assert!(
        found[0].starts_with(beginning) && found[0].contains("mesh.order = 2") && found[0].contains("refine the mesh"),
        "{found:?}"
    );
}

#[test]
fn the_poissons_ratio_of_every_law_s_parameters_is_known() {
    // K = 2D and G = 2C: K/G = 4 gives ν = 10/26, and K/G = 1000 locks.
    let ratio = |parameters: &str| {
        let text = edit(LEAST, "model = \"neo_hookean\"\nC = 1e5\nD = 4e5", parameters);
        (crate::read(&text).material.value().law.poissons_ratio().unwrap(), warnings(&text).len())
    };
    for law in [
        "model = \"neo_hookean\"\nC = 1e5",
        "model = \"mooney_rivlin\"\nC10 = 6e4\nC01 = 4e4",
        "model = \"yeoh\"\nC1 = 1e5\nC2 = 1\nC3 = 1",
        "model = \"gent\"\nC = 1e5\nJm = 40",
    ] {
        let (usual, close) = (ratio(&format!("{law}\nD = 4e5")), ratio(&format!("{law}\nD = 1e8")));
        assert!((usual.0 - 10.0 / 26.0).abs() < 1e-12 && usual.1 == 0, "{law}: {usual:?}");
        assert!((close.0 - 2998.0 / 6002.0).abs() < 1e-12 && close.1 == 1, "{law}: {close:?}");
    }
}

#[test]
fn plane_stress_is_refused_for_laws_without_a_form_for_it_and_for_solid_bodies() {
    let stress = |text: &str| edit(text, "[material]\n", "[material]\nplane = \"stress\"\n");
    let of_law = "material.plane is \"stress\", which material.model = \"neo_hookean\" has no form for";
    assert_refused(&stress(LEAST), 5, of_law);
    let table = LEFT.replace("linear", "stable_neo_hookean");
    let linear =
        edit(LEAST, "model = \"neo_hookean\"\nC = 1e5\nD = 4e5", "model = \"linear\"\nyoung = 1e5\npoisson = 0.3");
    let of_table = "material.plane is \"stress\", which materials[0].model = \"stable_neo_hookean\" has no form for";
    assert_refused(&format!("{}{table}", stress(&linear)), 5, of_table);
    let message = body(&stress(&linear)).unwrap_err().to_string();
    assert!(message.contains("material.plane belongs to flat bodies"), "{message}");
}

/// The smallest scene of the engine with another material.
fn with_springs(parameters: &str) -> String {
    let text = edit(LEAST, "model = \"neo_hookean\"\nC = 1e5\nD = 4e5", "model = \"mass_spring\"\nPARAMETERS");
    text.replace("PARAMETERS", parameters).replace("\"course\"", "\"engine\"")
}

#[test]
fn springs_have_a_stiffness_or_a_modulus_and_a_damping() {
    for parameters in ["stiffness = 5", "young = 5", "stiffness = 5\ndamping = 0", "young = 5\ndamping = 1"] {
        let material = crate::read(&with_springs(parameters)).material;
        assert!(material.is_mass_spring() && !material.value().locks(), "{parameters}");
    }
    assert!(!crate::read(LEAST).material.is_mass_spring());
    assert_refused(
        &with_springs("damping = 1"),
        4,
        "material needs either stiffness or young or stiffness and damping or",
    );
    assert_refused(&with_springs("stiffness = 1\nyoung = 1"), 4, "material needs either stiffness or young or");
    assert_refused(&with_springs("stiffness = -1"), 6, "material.stiffness is -1; give a positive number of N/m");
    assert_refused(&with_springs("stiffness = 1\ndamping = -1"), 7, "material.damping is -1; give 0 N s/m or more");
    assert_refused(&with_springs("young = 1\npoisson = 0.3"), 7, "material.poisson belongs to linear, ");
    let foreign = edit(LEAST, "C = 1e5\nD = 4e5", "stiffness = 1");
    assert_refused(
        &foreign,
        6,
        "material.stiffness belongs to mass_spring; give this model C and D or young and poisson or lambda and mu",
    );
}

#[test]
fn every_law_with_youngs_modulus_takes_lames_constants_in_its_place() {
    for facts in Law::FACTS.iter().filter(|facts| facts.parameters.iter().any(|set| set.contains(&"young"))) {
        let with = |parameters: &str| {
            let model = format!("model = \"{}\"\n{parameters}", facts.name);
            edit(LEAST, "model = \"neo_hookean\"\nC = 1e5\nD = 4e5", &model).replace("\"course\"", "\"engine\"")
        };
        let [given, of_lame] = ["young = 112500\npoisson = 0.25", "lambda = 45000\nmu = 45000"]
            .map(|parameters| crate::read(&with(parameters)).material.value().law);
        assert_eq!(given, of_lame, "{}", facts.name);
        for (parameters, message) in [
            ("lambda = 1e4", "lambda and mu"),
            ("lambda = 1e4\nyoung = 1e4", "lambda and mu"),
            ("lambda = -1e5\nmu = 1e5", "material.lambda is -1e5 Pa; give more than -2/3 of mu"),
            ("lambda = 1e5\nmu = 0", "material.mu is 0; give a positive number of Pa"),
        ] {
            let error = fem_scene::parse(&with(parameters), "scene.toml".as_ref()).unwrap_err().to_string();
            assert!(error.contains(message), "{parameters}: {error}");
        }
    }
}

#[test]
fn what_needs_elastic_elements_is_refused_beside_springs() {
    let springs = with_springs("young = 1e5");
    assert_refused(
        &format!("{springs}{LEFT}"),
        11,
        "materials[0] gives elements a law, and material.model = \"mass_spring\"",
    );
    let part = edit(
        &format!("{LEAST}{LEFT}"),
        "model = \"linear\"\nyoung = 1e3\npoisson = 0.3",
        "model = \"mass_spring\"\nyoung = 1",
    );
    assert_refused(
        &part.replace("\"course\"", "\"engine\""),
        14,
        "materials[0].model is \"mass_spring\", which is a model of whole",
    );
    let flow = "[plasticity]\nmodel = \"j2\"\nyield_stress = 1\n";
    assert_refused(
        &format!("{springs}{flow}"),
        5,
        "material.model is \"mass_spring\", and plasticity.model = \"j2\" is a flow",
    );
    for plane in ["strain", "stress"] {
        let text = with_springs(&format!("young = 1e5\nplane = \"{plane}\""));
        assert_refused(
            &text,
            7,
            "material.plane is a state of elastic elements, and material.model = \"mass_spring\" has none",
        );
    }
    let quadratic =
        edit(&springs, "[mesh]\nbox = { size = [2, 1, 1],", "[mesh]\norder = 2\nrectangle = { size = [2, 1],");
    assert_refused(
        &quadratic,
        3,
        "mesh.order is 2, and the springs of material.model = \"mass_spring\" are the edges of linear",
    );
}
