//! `[[fibres]]`: the direction of the fibres in each element, and its errors at their lines.

use nalgebra::Vector3;

use crate::errors::assert_refused;
use crate::{LEAST, body, edit};

const HALF: &str = "box = { min = [0, 0, 0], max = [1, 1, 1] }";

fn scene(lines: &str) -> String {
    format!("{LEAST}[[fibres]]\nmodulus = 1e4\n{lines}\n")
}

fn directions(lines: &str) -> Vec<(usize, Vector3<f64>)> {
    body(&scene(lines)).unwrap_or_else(|error| panic!("{error}")).fibres[0].directions.clone()
}

#[test]
fn a_direction_of_any_length_holds_for_all_elements_or_for_those_selected() {
    let expected = Vector3::new(0.6, 0.0, -0.8);
    for direction in ["[3, 0, -4]", "[3e50, 0, -4e50]", "[3e-200, 0, -4e-200]"] {
        let all = directions(&format!("direction = {direction}"));
        assert!(all.len() == 12 && all.iter().all(|(_, a)| (a - expected).norm() < 1e-15), "{all:?}");
    }
    let some = directions(&format!("direction = [3, 0, -4]\n{HALF}"));
    assert_eq!(some.iter().map(|(element, _)| *element).collect::<Vec<_>>(), (0..6).collect::<Vec<_>>());
}

#[test]
fn a_helix_has_its_angle_with_the_circumferential_direction_of_each_element() {
    let body = body(&scene("around = { axis = [0, 0, 2], center = [5, -3, 9], angle = 30 }")).unwrap();
    let mesh = &body.shape.mesh;
    for (element, a) in &body.fibres[0].directions {
        let centroid = mesh.corners_of(*element).iter().map(|&node| mesh.vertices()[node]).sum::<Vector3<f64>>() / 4.0;
        let radius = Vector3::new(centroid.x - 5.0, centroid.y + 3.0, 0.0);
        let around = Vector3::z().cross(&radius).normalize();
        assert!((a.norm() - 1.0).abs() < 1e-15 && a.dot(&radius).abs() < 1e-14 && (a.z - 0.5).abs() < 1e-15, "{a}");
        assert!((a.dot(&around) - 0.75f64.sqrt()).abs() < 1e-15, "{a}");
    }
    let corners = mesh.corners_of(7).iter().map(|&node| mesh.vertices()[node]);
    let [x, y, z] = (corners.sum::<Vector3<f64>>() / 4.0).into();
    let on_axis = format!("around = {{ axis = [0, 0, 1], center = [{x}, {y}, {z}], angle = 0 }}");
    let message = crate::body(&scene(&on_axis)).unwrap_err().to_string();
    assert!(
        message.contains("fibres[0].around has no circumferential direction on its axis in element 7; "),
        "{message}"
    );
}

#[test]
fn a_file_gives_a_direction_for_each_element() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("fibres.csv");
    let of_file = |text: &str, rest: &str| {
        std::fs::write(&file, text).unwrap();
        body(&scene(&format!("per_element = {:?}\n{rest}", file.to_str().unwrap()))).map(|body| body.fibres)
    };
    let lines: String = (0..12).map(|element| format!("{element}, 0,-4\n")).collect();
    let found = of_file(&format!("ax,ay,az\n{lines}"), "").unwrap();
    assert!((found[0].directions[3].1 - Vector3::new(0.6, 0.0, -0.8)).norm() < 1e-15);
    let refused = |text: &str, part: &str| {
        let message = of_file(text, "").unwrap_err().to_string();
        assert!(message.starts_with("folder/name.toml, line ") && message.contains("fibres[0].per_element is "));
        assert!(message.contains(part), "{message}");
    };
    refused("1,2,3\n", "which has 1 lines; the mesh has 12 elements, give a line for each");
    refused(&lines.replacen("-4", "east", 1), "line 1 is no list of numbers; write x,y,z, the direction of the fibres");
    let zero = format!("x,y,z\n{}", lines.replacen("7, 0,-4", "0,0,0", 1));
    refused(&zero, "whose line 9, of element 7, is zero; give the direction of its fibres");
    // Elements without fibres need no direction.
    assert_eq!(of_file(&zero, HALF).unwrap()[0].directions.len(), 6);
}

#[test]
fn fibres_are_checked_at_their_line() {
    let refused = |lines: &str, line: usize, beginning: &str| assert_refused(&scene(lines), line, beginning);
    let x = "direction = [1, 0, 0]";
    refused("", 12, "fibres[0] needs one of direction, around and per_element; give one and only one");
    refused(&format!("{x}\nper_element = \"a.csv\""), 12, "fibres[0] needs one of direction");
    refused("direction = [0, 0, 0]", 14, "fibres[0].direction is zero; give the direction");
    refused("direction = [nan, 0, 0]", 14, "fibres[0].direction is NaN");
    refused("around = { axis = [0, 0, 0], angle = 1 }", 14, "fibres[0].around.axis is zero");
    refused("around = { axis = [0, 0, 1], angle = inf }", 14, "fibres[0].around.angle is inf");
    refused(&format!("{x}\nexponent = -1"), 15, "fibres[0].exponent is -1; give ");
    refused(&format!("{x}\ndispersion = 0.4"), 15, "fibres[0].dispersion is 0.4; give a number from 0");
    refused(&format!("{x}\ndispersion = nan"), 15, "fibres[0].dispersion is NaN");
    refused(&format!("{x}\n{HALF}\non = \"all\""), 12, "fibres[0] needs one of on, box, sphere and set");
    assert_refused(
        &edit(&scene(x), "modulus = 1e4", "modulus = 0"),
        13,
        "fibres[0].modulus is 0; give a positive number",
    );
    let flat = edit(&scene("direction = [1, 0, 1]"), "box = { size = [2, 1, 1]", "rectangle = { size = [2, 1]");
    let message = body(&edit(&flat, "course", "engine")).unwrap_err().to_string();
    assert!(message.contains("fibres[0].direction points out of the plane of a flat body in element 0"), "{message}");
    let outside = body(&scene(&format!("{x}\nset = \"media\""))).unwrap_err().to_string();
    assert!(outside.contains("fibres[0].set") && outside.contains("the mesh has no sets"), "{outside}");
}
