//! The numbers of a scene that the panel changes, beside those that a running simulation takes itself.

use std::path::{Path, PathBuf};

use fem_model::simulation::Parameter;
use fem_scene::{Override, Scene};
use nalgebra::Vector3;

use super::change::Change;

/// Key, name, unit, value in a scene that has the parameter, and the range of its slider.
type Number = (&'static str, &'static str, &'static str, fn(&Scene) -> Option<f64>, Range);

/// The range of a slider by the value at first.
#[derive(Clone, Copy)]
enum Range {
    /// From 0 to this end, or to so many times the value if that is more.
    UpTo(f64, f64),
    /// Logarithmic, by this factor to both sides; up to 1e6 from a value of 0.
    By(f64),
    /// From 1 to so many times the value.
    Count(f64),
}

impl Range {
    /// Ends of the slider, and whether it is logarithmic.
    fn around(self, value: f64) -> ((f64, f64), bool) {
        match self {
            Self::UpTo(end, times) => ((0.0, f64::max(end, times * value)), false),
            Self::By(factor) if value > 0.0 => ((value / factor, factor * value), true),
            Self::By(_) => ((0.0, 1e6), false),
            Self::Count(times) => ((1.0, times * value), false),
        }
    }
}

/// The parameters in the order of the panel, that of figure 5.1 of the thesis.
const NUMBERS: [Number; 16] = [
    ("improve", "detail: smoothing", "", |scene| Some(filled(scene)?.1 as f64), Range::UpTo(20.0, 2.0)),
    ("edge", "resolution: edge", "m", |scene| Some(filled(scene)?.0), Range::By(5.0)),
    ("cells", "resolution", "1/m", |scene| Some(cells(scene)? as f64), Range::Count(5.0)),
    ("scale", "scale", "", |scene| Some(scene.mesh.scale), Range::By(5.0)),
    ("gravity", "gravity", "m/s²", gravity, Range::UpTo(30.0, 2.0)),
    ("density", "density", "kg/m³", |scene| Some(scene.material.density), Range::By(100.0)),
    ("lambda", "λ", "Pa", |scene| Some(lame(scene)?.0), Range::By(100.0)),
    ("mu", "μ", "Pa", |scene| Some(lame(scene)?.1), Range::By(100.0)),
    ("yield", "yield strain", "", |scene| scene.plasticity.as_ref()?.yield_strain, Range::UpTo(1.0, 2.0)),
    ("creep", "creep", "1/s", |scene| scene.plasticity.as_ref()?.creep, Range::UpTo(20.0, 4.0)),
    ("maximum", "maximum strain", "", |scene| scene.plasticity.as_ref()?.maximum, Range::UpTo(1.0, 2.0)),
    ("yield_stress", "yield stress", "Pa", |scene| scene.plasticity.as_ref()?.yield_stress, Range::By(100.0)),
    ("hardening", "hardening", "Pa", |scene| scene.plasticity.as_ref()?.hardening, Range::By(100.0)),
    ("friction", "friction", "", |scene| Some(scene.planes.first()?.friction), Range::UpTo(1.5, 2.0)),
    ("alpha", "damping α", "1/s", |scene| Some(scene.damping.as_ref()?.alpha), Range::UpTo(10.0, 4.0)),
    ("beta", "damping β", "s", |scene| Some(scene.damping.as_ref()?.beta), Range::UpTo(0.02, 4.0)),
];

/// The parameters of a scene. `initial` is the scene before all changes, whose values set the ranges of the sliders. Typed
/// values may lie outside; the scene's own checks apply to them.
pub fn parameters(scene: &Scene, initial: &Scene) -> Vec<Parameter> {
    let parameter = |(key, label, unit, of, range): Number| {
        let value = of(scene)?;
        let (range, logarithmic) = range.around(of(initial).unwrap_or(value));
        Some(Parameter { key, label, unit, value, range, logarithmic })
    };
    NUMBERS.into_iter().filter_map(parameter).collect()
}

/// The picture of a scene whose body is made from one.
pub fn object(scene: &Scene) -> Option<PathBuf> {
    scene.mesh.picture.as_ref().map(|picture| picture.file.clone())
}

/// Edge and number of improvements of a mesh that is made from a picture or a surface.
fn filled(scene: &Scene) -> Option<(f64, usize)> {
    let of_picture = scene.mesh.picture.as_ref().map(|table| (table.edge, table.improve));
    of_picture.or(scene.mesh.surface.as_ref().map(|table| (table.edge, table.improve)))
}

/// Cells per metre of a box or a rectangle.
fn cells(scene: &Scene) -> Option<usize> {
    let of_box = scene.mesh.cuboid.as_ref().map(|table| table.cells_per_unit);
    of_box.or(scene.mesh.rectangle.as_ref().map(|table| table.cells_per_unit))
}

fn gravity(scene: &Scene) -> Option<f64> {
    Some(Vector3::from(scene.gravity.as_ref()?.acceleration).norm())
}

/// Young's modulus at small strain, Pa; `None` where the scene gives other parameters.
pub fn young(scene: &Scene) -> Option<f64> {
    lame(scene).map(|(lambda, mu)| mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu)).or(scene.material.young)
}

/// Lamé's constants λ and μ of the law at small strain, Pa: as given, of `young` and `poisson`, or of `C` and `D`.
fn lame(scene: &Scene) -> Option<(f64, f64)> {
    let material = &scene.material;
    match (material.young, material.poisson, material.C, material.D) {
        _ if material.lambda.is_some() => material.lambda.zip(material.mu),
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
        "gravity" => vec![Override::to("gravity.acceleration", resized_gravity(scene, value, up))],
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
pub fn resized_gravity(scene: &Scene, size: f64, up: &Vector3<f64>) -> [f64; 3] {
    let now = scene.gravity.as_ref().map_or(Vector3::zeros(), |gravity| gravity.acceleration.into());
    components(now.try_normalize(0.0).unwrap_or(-up) * size)
}

/// The components of a vector for a scene, without a sign before zero.
pub fn components(x: Vector3<f64>) -> [f64; 3] {
    x.map(|x| x + 0.0).into()
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
    } else if scene.material.mu.is_some() {
        [("lambda", lambda), ("mu", mu)]
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
        let of_lame = SCENE.replace("young = 112500.0\npoisson = 0.25", "lambda = 45000.0\nmu = 45000.0");
        for scene in [scene(), fem_scene::parse(&of_lame, "flat.toml".as_ref()).unwrap()] {
            reach(&scene);
        }
    }

    fn reach(scene: &Scene) {
        for parameter in parameters(scene, scene) {
            let wanted = if parameter.key == "improve" { 7.0 } else { 1.25 * parameter.value };
            let next = changed(scene, &Change::Number(parameter.key, wanted));
            let found = value(&next, parameter.key);
            assert!((found - wanted).abs() <= 1e-12 * wanted, "{}: {found} and not {wanted}", parameter.key);
            for other in parameters(scene, scene).into_iter().filter(|other| other.key != parameter.key) {
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
