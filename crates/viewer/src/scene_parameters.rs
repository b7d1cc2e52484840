//! The numbers of a scene that the panel changes, beside those that a running simulation takes itself.

use std::path::{Path, PathBuf};

use fem_model::simulation::Parameter;
use fem_scene::tables::MeshTable;
use fem_scene::{Override, Scene};
use nalgebra::Vector3;

use crate::change::Change;

/// Factor between the value of the scene and the ends of the range of a logarithmic slider.
const DECADES: f64 = 100.0;

/// The parameters of a scene. `initial` is the scene before all changes, whose values set the ranges of the sliders. Typed
/// values may lie outside; the scene's own checks apply to them.
pub fn parameters(scene: &Scene, initial: &Scene) -> Vec<Parameter> {
    let of = |scene: &Scene| values(scene);
    let ranges = of(initial);
    let parameter = |(key, label, unit, value): Value| {
        let start = ranges.iter().find(|other| other.0 == key).map_or(value, |other| other.3);
        let (range, logarithmic) = range(key, start);
        Parameter { key, label, unit, value, range, logarithmic }
    };
    of(scene).into_iter().map(parameter).collect()
}

/// The picture of a scene whose body is made from one.
pub fn object(scene: &Scene) -> Option<PathBuf> {
    scene.mesh.picture.as_ref().map(|picture| picture.file.clone())
}

/// Key, name, unit and value of a parameter.
type Value = (&'static str, &'static str, &'static str, f64);

fn values(scene: &Scene) -> Vec<Value> {
    let mut values = mesh_values(&scene.mesh);
    if let Some(gravity) = &scene.gravity {
        values.push(("gravity", "gravity", "m/s²", Vector3::from(gravity.acceleration).norm()));
    }
    values.push(("density", "density", "kg/m³", scene.material.density));
    if let Some((lambda, mu)) = lame(scene) {
        values.push(("lambda", "λ", "Pa", lambda));
        values.push(("mu", "μ", "Pa", mu));
    }
    if let Some(flow) = &scene.plasticity {
        let given = [
            ("yield", "yield strain", "", flow.yield_strain),
            ("creep", "creep", "1/s", flow.creep),
            ("maximum", "maximum strain", "", flow.maximum),
            ("yield_stress", "yield stress", "Pa", flow.yield_stress),
            ("hardening", "hardening", "Pa", flow.hardening),
        ];
        values.extend(given.into_iter().filter_map(|(key, label, unit, value)| Some((key, label, unit, value?))));
    }
    if let Some(plane) = scene.planes.first() {
        values.push(("friction", "friction", "", plane.friction));
    }
    if let Some(damping) = &scene.damping {
        values.push(("alpha", "damping α", "1/s", damping.alpha));
        values.push(("beta", "damping β", "s", damping.beta));
    }
    values
}

fn mesh_values(mesh: &MeshTable) -> Vec<Value> {
    let mut values = Vec::new();
    let cells = mesh.cuboid.as_ref().map(|table| table.cells_per_unit);
    if let Some(cells) = cells.or(mesh.rectangle.as_ref().map(|table| table.cells_per_unit)) {
        values.push(("cells", "resolution", "1/m", cells as f64));
    }
    let made = mesh.picture.as_ref().map(|table| (table.edge, table.improve));
    if let Some((edge, improve)) = made.or(mesh.surface.as_ref().map(|table| (table.edge, table.improve))) {
        values.push(("edge", "resolution: edge", "m", edge));
        values.push(("improve", "detail: smoothing", "", improve as f64));
    }
    values.push(("scale", "scale", "", mesh.scale));
    values
}

/// Ends of a slider, and whether it is logarithmic.
fn range(key: &str, value: f64) -> ((f64, f64), bool) {
    match key {
        "gravity" => ((0.0, f64::max(30.0, 2.0 * value)), false),
        "friction" => ((0.0, f64::max(1.5, 2.0 * value)), false),
        "improve" => ((0.0, f64::max(20.0, 2.0 * value)), false),
        "alpha" => ((0.0, f64::max(10.0, 4.0 * value)), false),
        "beta" => ((0.0, f64::max(0.02, 4.0 * value)), false),
        "creep" => ((0.0, f64::max(20.0, 4.0 * value)), false),
        "yield" | "maximum" => ((0.0, f64::max(1.0, 2.0 * value)), false),
        "edge" | "scale" => ((value / 5.0, 5.0 * value), true),
        "cells" => ((1.0, 5.0 * value), false),
        _ if value > 0.0 => ((value / DECADES, DECADES * value), true),
        _ => ((0.0, 1e6), false),
    }
}

/// Young's modulus at small strain, Pa; `None` where the scene gives other parameters.
pub fn young(scene: &Scene) -> Option<f64> {
    lame(scene).map(|(lambda, mu)| mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu)).or(scene.material.young)
}

/// Lamé's constants λ and μ of the law at small strain, Pa: of `young` and `poisson`, or of `C` and `D`.
fn lame(scene: &Scene) -> Option<(f64, f64)> {
    let material = &scene.material;
    match (material.young, material.poisson, material.C, material.D) {
        (Some(young), Some(nu), ..) => Some((young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), young / (2.0 * (1.0 + nu)))),
        (_, _, Some(c), Some(d)) => Some((2.0 * d - 4.0 / 3.0 * c, 2.0 * c)),
        _ => None,
    }
}

/// The keys of a scene that a change sets, with their values.
pub fn overrides(scene: &Scene, change: &Change, up: &Vector3<f64>) -> Result<Vec<Override>, String> {
    match change {
        Change::Object(file) => Ok(vec![Override::to("mesh.picture.file", beside(object(scene), file))]),
        Change::Number(key, value) => number(scene, key, *value, up),
        Change::Edit(edit) => Ok(edit.overrides.clone()),
    }
}

/// The path of a picture in the folder of another one, as the scene writes it.
fn beside(present: Option<PathBuf>, file: &Path) -> String {
    let folder = present.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
    folder.join(file.file_name().unwrap_or_default()).to_string_lossy().into_owned()
}

/// The keys that another value of a parameter sets.
fn number(scene: &Scene, key: &str, value: f64, up: &Vector3<f64>) -> Result<Vec<Override>, String> {
    if !value.is_finite() {
        return Err(format!("{key} is {value}; give a finite number"));
    }
    let made = if scene.mesh.picture.is_some() { "mesh.picture" } else { "mesh.surface" };
    let cells = if scene.mesh.cuboid.is_some() { "mesh.box" } else { "mesh.rectangle" };
    let whole = value.round().max(0.0) as u64;
    let to = |path: &str, value: f64| vec![Override::to(path, value)];
    Ok(match key {
        "edge" => to(&format!("{made}.edge"), value),
        "improve" => vec![Override::to(&format!("{made}.improve"), whole)],
        "cells" => vec![Override::to(&format!("{cells}.cells_per_unit"), whole)],
        "scale" => to("mesh.scale", value),
        "density" => to("material.density", value),
        "gravity" => vec![Override::to("gravity.acceleration", gravity(scene, value, up))],
        "lambda" | "mu" => moduli(scene, key, value)?,
        "yield" => to("plasticity.yield_strain", value),
        "creep" | "maximum" | "yield_stress" | "hardening" => to(&format!("plasticity.{key}"), value),
        "friction" => {
            (0..scene.planes.len()).map(|plane| Override::to(&format!("planes.{plane}.friction"), value)).collect()
        }
        "alpha" | "beta" => to(&format!("damping.{key}"), value),
        other => return Err(format!("there is no parameter {other}")),
    })
}

/// Gravity of this size in its direction; downwards if it has none.
fn gravity(scene: &Scene, size: f64, up: &Vector3<f64>) -> [f64; 3] {
    let now = scene.gravity.as_ref().map_or(Vector3::zeros(), |gravity| gravity.acceleration.into());
    (now.try_normalize(0.0).unwrap_or(-up) * size).into()
}

/// The parameters of the law with another λ or μ: E = μ (3λ + 2μ)/(λ + μ) and ν = λ/(2 (λ + μ)), or C = μ/2 and D = λ/2 + μ/3.
fn moduli(scene: &Scene, key: &str, value: f64) -> Result<Vec<Override>, String> {
    let Some((lambda, mu)) = lame(scene) else { return Err("the law has no λ and μ".to_owned()) };
    let (lambda, mu) = if key == "lambda" { (value, mu) } else { (lambda, value) };
    if !(mu > 0.0 && 3.0 * lambda + 2.0 * mu > 0.0) {
        return Err(format!("λ = {lambda:e} Pa and μ = {mu:e} Pa; give μ > 0 and λ > -2μ/3"));
    }
    let [(a, first), (b, second)] = if scene.material.C.is_some() {
        [("C", 0.5 * mu), ("D", 0.5 * lambda + mu / 3.0)]
    } else {
        [("young", mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu)), ("poisson", 0.5 * lambda / (lambda + mu))]
    };
    Ok(vec![Override::to(&format!("material.{a}"), first), Override::to(&format!("material.{b}"), second)])
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = r#"
pipeline = "engine"
[mesh]
picture = { file = "pictures/donut.png", height = 1.0, edge = 0.1 }
[material]
model = "corotated"
young = 112500.0
poisson = 0.25
density = 140.5
[plasticity]
model = "additive"
yield_strain = 0.02
creep = 5.0
[gravity]
acceleration = [0, -9.81, 0]
[damping]
alpha = 0.5
[[planes]]
point = [0, -2.8, 0]
normal = [0, 1, 0]
friction = 0.4
[[planes]]
point = [-2.24, -1.68, 0]
normal = [4, 3, 0]
[time]
dt = 0.01
integrator = "implicit_euler"
"#;

    fn scene() -> Scene {
        fem_scene::parse(SCENE, "flat.toml".as_ref()).unwrap()
    }

    fn changed(scene: &Scene, change: &Change) -> Scene {
        scene.changed(&overrides(scene, change, &Vector3::y()).unwrap()).unwrap()
    }

    fn value(scene: &Scene, key: &str) -> f64 {
        parameters(scene, scene).iter().find(|parameter| parameter.key == key).unwrap().value
    }

    #[test]
    fn every_parameter_reaches_the_scene() {
        let scene = scene();
        for parameter in parameters(&scene, &scene) {
            let wanted = if parameter.key == "improve" { 7.0 } else { 1.25 * parameter.value };
            let next = changed(&scene, &Change::Number(parameter.key, wanted));
            let found = value(&next, parameter.key);
            assert!((found - wanted).abs() <= 1e-12 * wanted, "{}: {found} and not {wanted}", parameter.key);
            for other in parameters(&scene, &scene).into_iter().filter(|other| other.key != parameter.key) {
                let now = value(&next, other.key);
                assert!((now - other.value).abs() <= 1e-12 * other.value, "{} changed {}", parameter.key, other.key);
            }
        }
    }

    #[test]
    fn the_moduli_of_the_thesis_are_those_of_the_scene() {
        assert!((value(&scene(), "lambda") - 45000.0).abs() < 1e-6 && (value(&scene(), "mu") - 45000.0).abs() < 1e-6);
    }

    #[test]
    fn another_object_lies_in_the_same_folder() {
        let next = changed(&scene(), &Change::Object("data/pictures/bunny.png".into()));
        assert_eq!(object(&next), Some("pictures/bunny.png".into()));
    }

    #[test]
    fn friction_changes_on_all_planes() {
        let next = changed(&scene(), &Change::Number("friction", 0.7));
        assert!(next.planes.iter().all(|plane| plane.friction == 0.7));
    }

    #[test]
    fn gravity_that_was_switched_off_comes_back_downwards() {
        let none = changed(&scene(), &Change::Number("gravity", 0.0));
        let back = changed(&none, &Change::Number("gravity", 2.0));
        assert_eq!(back.gravity.unwrap().acceleration, [0.0, -2.0, 0.0]);
    }

    #[test]
    fn values_without_sense_are_refused_with_a_remedy() {
        let scene = scene();
        let refused = |key: &'static str, value: f64| {
            let found = overrides(&scene, &Change::Number(key, value), &Vector3::y());
            found.and_then(|changes| scene.changed(&changes).map_err(|error| error.problem())).unwrap_err()
        };
        assert!(refused("density", -1.0).contains("material.density is -1"));
        assert!(refused("mu", -1.0).contains("give μ > 0"));
        assert!(refused("friction", f64::NAN).contains("finite"));
    }
}
