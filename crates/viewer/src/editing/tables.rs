//! Tables that the panel adds to a scene that lacks them, and removes.

use fem_model::Integrator;
use fem_model::simulation::Shape;
use fem_scene::tables::PlasticModel;
use fem_scene::{Override, Scene};
use nalgebra::Vector3;

use super::change::{Edit, Effect};
use super::parameters::{components, resized_gravity, young};

/// Size of gravity, m/s².
const GRAVITY: f64 = 9.81;
/// Distance of a floor from the undeformed body, in heights of the body.
const DISTANCE: f64 = 0.1;
/// Friction of a floor, for methods with velocities.
const FRICTION: f64 = 0.4;
/// Strain at which a body begins to flow.
const YIELD_STRAIN: f64 = 0.05;
/// Rate of the additive flow, 1/s.
const CREEP: f64 = 5.0;
/// Mass-proportional damping, 1/s.
const DAMPING: f64 = 0.5;

/// A table that the panel can add or remove.
#[derive(Clone, Debug, PartialEq)]
pub struct TableOffer {
    /// The name in the panel of what it adds or removes.
    pub name: &'static str,
    /// The scene has the table, and the edit removes it.
    pub is_there: bool,
    /// The edit that adds or removes it.
    pub edit: Edit,
}

/// Tables: their keys, the first of which the others need, the names of what is added and of what is removed, and the effect on the motion.
type Tables = (&'static [&'static str], [&'static str; 2], Effect);

/// The tables that the panel adds and removes.
const TABLES: [Tables; 4] = [
    (&["gravity"], ["gravity"; 2], Effect::Loads),
    (&["planes", "contact"], ["floor", "planes"], Effect::Supports),
    (&["plasticity"], ["plastic flow"; 2], Effect::Supports),
    (&["damping"], ["damping"; 2], Effect::Loads),
];

/// The tables that can be added to a scene or removed from it, as far as the scene's own checks accept the result. A table that `initial`,
/// the scene before all changes, has comes back as it was.
pub fn offers(scene: &Scene, initial: &Scene, shape: &Shape, up: &Vector3<f64>) -> Vec<TableOffer> {
    let offer = |(keys, names, effect): Tables| {
        let is_there = scene.source.contains_key(keys[0]);
        let candidates = match is_there {
            true => vec![keys.iter().map(|key| Override::without(key)).collect()],
            false => former(initial, keys).into_iter().chain(new(scene, keys[0], shape, up)).collect(),
        };
        let overrides = candidates.into_iter().find(|overrides: &Vec<_>| scene.changed(overrides).is_ok())?;
        let edit = Edit { table: keys[0].to_owned(), overrides, effect };
        Some(TableOffer { name: names[usize::from(is_there)], is_there, edit })
    };
    TABLES.into_iter().filter_map(offer).collect()
}

/// The keys as the scene had them at first.
fn former(initial: &Scene, keys: &[&str]) -> Option<Vec<Override>> {
    let values = keys.iter().filter_map(|key| Some(Override::to(key, initial.source.get(*key)?)));
    initial.source.contains_key(keys[0]).then(|| values.collect())
}

/// A new table; `None` if no values suit the body's law.
fn new(scene: &Scene, table: &str, shape: &Shape, up: &Vector3<f64>) -> Option<Vec<Override>> {
    let to = |key: &str, value: f64| Override::to(&format!("{table}.{key}"), value);
    Some(match table {
        "gravity" => vec![Override::to("gravity.acceleration", resized_gravity(scene, GRAVITY, up))],
        "planes" => {
            let heights = || shape.mesh.vertices().iter().map(|x| x.dot(up));
            let (low, high) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
            let point = up * (low - DISTANCE * (high - low));
            let friction = if scene.time.integrator == Integrator::Static { 0.0 } else { FRICTION };
            let vector = |key: &str, x: Vector3<f64>| Override::to(&format!("planes.0.{key}"), components(x));
            vec![vector("point", point), vector("normal", *up), to("0.friction", friction)]
        }
        "plasticity" => {
            let models = [PlasticModel::Additive, PlasticModel::J2];
            let model = models.into_iter().find(|model| model.law() == scene.material.model)?;
            let name = Override::to("plasticity.model", model.name());
            match model {
                PlasticModel::Additive => vec![name, to("yield_strain", YIELD_STRAIN), to("creep", CREEP)],
                PlasticModel::J2 => vec![name, to("yield_stress", YIELD_STRAIN * young(scene)?)],
            }
        }
        _ => vec![to("alpha", DAMPING)],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editing::parameters::parameters;

    const SCENE: &str = r#"
pipeline = "engine"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 1 }
[material]
model = "corotated"
young = 1e5
poisson = 0.3
density = 1000
[time]
dt = 0.01
integrator = "implicit_euler"
"#;

    fn scene(text: &str) -> Scene {
        fem_scene::parse(text, "bare.toml".as_ref()).unwrap()
    }

    fn offers_of(scene: &Scene, initial: &Scene) -> Vec<TableOffer> {
        let mesh: fem_model::BodyMesh = fem_mesh::box_mesh([2.0, 1.0, 1.0], 1, fem_mesh::Pattern::Kuhn).unwrap().into();
        let shape = Shape { boundary: mesh.surface(), mesh, display: None, picture: None };
        offers(scene, initial, &shape, &Vector3::z())
    }

    /// The scene after the click on an offer.
    fn after(scene: &Scene, initial: &Scene, name: &str) -> Scene {
        let offer = offers_of(scene, initial).into_iter().find(|offer| offer.name == name).unwrap();
        scene.changed(&offer.edit.overrides).unwrap()
    }

    fn names(scene: &Scene, is_there: bool) -> Vec<&'static str> {
        let offers = offers_of(scene, scene).into_iter().filter(|offer| offer.is_there == is_there);
        offers.map(|offer| offer.name).collect()
    }

    #[test]
    fn a_bare_scene_is_given_all_tables_whose_sliders_then_appear_and_loses_them_again() {
        let bare = scene(SCENE);
        let all = ["gravity", "floor", "plastic flow", "damping"];
        assert_eq!((names(&bare, false), names(&bare, true)), (all.to_vec(), vec![]));
        let full = all.iter().fold(bare.clone(), |scene, name| after(&scene, &bare, name));
        let removed = ["gravity", "planes", "plastic flow", "damping"];
        assert_eq!((names(&full, false), names(&full, true)), (vec![], removed.to_vec()));
        assert_eq!(full.gravity.as_ref().unwrap().acceleration, [0.0, 0.0, -9.81]);
        let plane = &full.planes[0];
        assert_eq!((plane.point, plane.normal, plane.friction), ([0.0, 0.0, -0.1], [0.0, 0.0, 1.0], 0.4));
        let sliders = parameters(&full, &bare).into_iter().map(|parameter| (parameter.key, parameter.value));
        let values: Vec<_> = sliders.collect();
        for slider in [("gravity", 9.81), ("yield", 0.05), ("creep", 5.0), ("friction", 0.4), ("alpha", 0.5)] {
            assert!(values.contains(&slider), "{slider:?} in {values:?}");
        }
        assert_eq!(removed.iter().fold(full, |scene, name| after(&scene, &bare, name)).source, bare.source);
    }

    #[test]
    fn a_table_that_was_removed_comes_back_as_the_scene_had_it() {
        let planes =
            "[[planes]]\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n[[planes]]\npoint = [-3, 0, 0]\nnormal = [1, 0, 0]\n";
        let first = scene(&format!("{SCENE}{planes}[contact]\nactivation_distance = 0.01\n"));
        let none = after(&first, &first, "planes");
        assert!(none.planes.is_empty() && none.contact.is_none());
        assert_eq!(after(&none, &first, "floor").source, first.source);
    }

    #[test]
    fn the_flow_is_that_of_the_law_and_no_other_law_is_offered_one() {
        let hencky = scene(&SCENE.replace("corotated", "hencky"));
        let flow = after(&hencky, &hencky, "plastic flow").plasticity.unwrap();
        assert_eq!((flow.model, flow.yield_stress.map(f64::round)), (PlasticModel::J2, Some(5000.0)));
        assert!(!names(&scene(&SCENE.replace("corotated", "neo_hookean")), false).contains(&"plastic flow"));
    }

    #[test]
    fn what_the_method_cannot_take_is_not_offered() {
        let statics = scene(&SCENE.replace("implicit_euler", "static"));
        assert_eq!(names(&statics, false), ["gravity", "floor"]);
        assert_eq!(after(&statics, &statics, "floor").planes[0].friction, 0.0);
        let bathe = scene(&SCENE.replace("implicit_euler", "bathe"));
        assert_eq!(names(&bathe, false), ["gravity", "plastic flow", "damping"]);
    }
}
