//! The keys of a scene that are set when nodes are painted, faces loaded, or a method is chosen.

use fem_model::Integrator;
use fem_scene::tables::{FixedTable, TractionTable};
use fem_scene::{Override, Scene};
use serde::Serialize;

use super::change::{Edit, Effect};

/// Time step of a scene that had none, s.
const DT: f64 = 0.01;

/// The kind of a prescribed motion that is set by hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// From the first step on, m.
    Displacement,
    /// m/s
    Velocity,
}

impl Motion {
    /// The key in scene files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Velocity => "velocity",
        }
    }
}

/// `[fixed]` with these nodes; without nodes the table is removed.
pub fn fixed(scene: &Scene, nodes: &[usize]) -> Edit {
    let until = scene.fixed.as_ref().and_then(|FixedTable { until, .. }| *until);
    let mut overrides = vec![Override::without("fixed")];
    if !nodes.is_empty() {
        overrides.push(Override::to("fixed.nodes", nodes));
        overrides.extend(until.map(|until| Override::to("fixed.until", until)));
    }
    Edit { table: "fixed".to_owned(), overrides, effect: Effect::Supports }
}

/// A `[[prescribed]]` with these nodes, the motion of a new one beside them; without nodes the table is removed.
pub fn prescribed(number: usize, nodes: &[usize], new: Option<(Motion, [f64; 3])>) -> Edit {
    let table = format!("prescribed.{number}");
    let overrides = match (nodes, new) {
        ([], _) => vec![Override::without(&table)],
        (nodes, Some((motion, vector))) => {
            let key = |key: &str| format!("{table}.{key}");
            vec![Override::to(&key("nodes"), nodes), Override::to(&key(motion.key()), vector)]
        }
        (nodes, None) => {
            let others = ["on", "box", "sphere", "set"].map(|key| Override::without(&format!("{table}.{key}")));
            others.into_iter().chain([Override::to(&format!("{table}.nodes"), nodes)]).collect()
        }
    };
    Edit { table, overrides, effect: Effect::Supports }
}

/// Another displacement (m) or velocity (m/s) of a `[[prescribed]]`.
pub fn prescribed_vector(number: usize, motion: Motion, vector: [f64; 3]) -> Edit {
    let table = format!("prescribed.{number}.{}", motion.key());
    Edit { overrides: vec![Override::to(&table, vector)], table, effect: Effect::Supports }
}

/// A force on faces of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Force {
    /// Follower load: pressure against the deformed surface, Pa.
    Pressure(f64),
    /// Dead load, Pa.
    PerArea([f64; 3]),
}

/// A `[[traction]]` on these faces, triangles or edges by their nodes; without faces the table is removed. A curve stays.
pub fn load(scene: &Scene, number: usize, faces: &[&[usize]], force: Force) -> Edit {
    let table = format!("traction.{number}");
    let Some(first) = faces.first() else { return without_load(number) };
    let (key, ends) = if first.len() == 3 { ("faces", 3) } else { ("edges", 2) };
    let faces: Vec<&[usize]> = faces.iter().map(|face| &face[..ends]).collect();
    let (force, other) = match force {
        Force::Pressure(pressure) => (Override::to(&format!("{table}.pressure"), pressure), "force_per_area"),
        Force::PerArea(force) => (Override::to(&format!("{table}.force_per_area"), force), "pressure"),
    };
    let selectors = scene.traction.get(number).map_or(Vec::new(), TractionTable::selectors);
    let others = selectors.iter().map(|selector| selector.key()).filter(|other| *other != key).chain([other]);
    let mut overrides = vec![Override::to(&format!("{table}.{key}"), faces), force];
    overrides.extend(others.map(|key| Override::without(&format!("{table}.{key}"))));
    Edit { table, overrides, effect: Effect::Loads }
}

/// The scene without a `[[traction]]`.
pub fn without_load(number: usize) -> Edit {
    let table = format!("traction.{number}");
    Edit { overrides: vec![Override::without(&table)], table, effect: Effect::Loads }
}

/// Another time integration method; tables without effect on it are removed, and it is given a time step if it needs one.
pub fn integrator(scene: &Scene, integrator: Integrator) -> Edit {
    let mut next = scene.clone();
    next.time.integrator = integrator;
    let unused = next.remove_unused_tables();
    let mut overrides = vec![Override::to("time.integrator", integrator.name())];
    overrides.extend(unused.into_iter().map(Override::without));
    match integrator {
        Integrator::Static => overrides.push(Override::without("time.substeps")),
        _ if scene.time.dt.is_none() => overrides.push(Override::to("time.dt", DT)),
        _ => {}
    }
    Edit { table: "time.integrator".to_owned(), overrides, effect: Effect::Method }
}

/// Another `[solver]`, `[newton]` or `[iterations]`; `None` removes the table, so that the engine chooses.
pub fn of_method(name: &str, table: Option<&impl Serialize>) -> Edit {
    let change = table.map_or_else(|| Override::without(name), |table| Override::to(name, table));
    Edit { table: name.to_owned(), overrides: vec![change], effect: Effect::Method }
}

#[cfg(test)]
mod tests {
    use fem_model::SolverKind;
    use fem_scene::tables::{NewtonTable, SolverTable};

    use super::*;

    const SCENE: &str = r#"
pipeline = "engine"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 1 }
[material]
model = "neo_hookean"
young = 1e5
poisson = 0.3
density = 1000
[fixed]
plane = { axis = "x", below = 1e-9 }
until = 2.0
[[prescribed]]
on = { axis = "x", side = "max", within = 1e-9 }
displacement = [1, 0, 0]
[[traction]]
on = "all"
force_per_area = [1, 0, 0]
curve = { ramp = 1.0 }
[newton]
tolerance = 1e-8
[time]
dt = 0.01
integrator = "implicit_euler"
"#;

    fn scene() -> Scene {
        fem_scene::parse(SCENE, "setup.toml".as_ref()).unwrap()
    }

    fn after(edit: &Edit) -> Scene {
        scene().changed(&edit.overrides).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn painted_nodes_take_the_place_of_a_selector_and_no_nodes_remove_the_table() {
        let table = after(&fixed(&scene(), &[3, 1])).fixed.unwrap();
        assert_eq!((table.nodes, table.plane, table.until), (Some(vec![3, 1]), None, Some(2.0)));
        assert_eq!(after(&fixed(&scene(), &[])).fixed, None);
        let table = &after(&prescribed(0, &[2], None)).prescribed[0];
        assert_eq!((&table.nodes, &table.on, table.displacement), (&Some(vec![2]), &None, Some([1.0, 0.0, 0.0])));
        let new = &after(&prescribed(1, &[4], Some((Motion::Velocity, [0.0, 0.5, 0.0])))).prescribed[1];
        assert_eq!((&new.nodes, new.velocity), (&Some(vec![4]), Some([0.0, 0.5, 0.0])));
        assert!(after(&prescribed(0, &[], None)).prescribed.is_empty());
    }

    #[test]
    fn a_load_keeps_its_curve_and_has_one_force() {
        let faces: [&[usize]; 1] = [&[0, 1, 2]];
        let table = after(&load(&scene(), 0, &faces, Force::Pressure(-5.0))).traction.remove(0);
        assert_eq!((table.faces, table.on, table.force_per_area), (Some(vec![[0, 1, 2]]), None, None));
        assert!(table.pressure == Some(-5.0) && table.curve.is_some());
        let edges: [&[usize]; 1] = [&[0, 1]];
        let table = after(&load(&scene(), 1, &edges, Force::PerArea([1.0, 0.0, 0.0]))).traction.remove(1);
        assert_eq!((table.edges, table.force_per_area), (Some(vec![[0, 1]]), Some([1.0, 0.0, 0.0])));
        assert!(after(&load(&scene(), 0, &[], Force::Pressure(1.0))).traction.is_empty());
    }

    #[test]
    fn every_integrator_can_be_chosen_without_a_table_in_its_way() {
        for kind in Integrator::ALL {
            let mut free = scene();
            free.prescribed.clear();
            let overrides = [
                integrator(&free, kind).overrides,
                ["fixed.until", "traction.0.curve"].map(Override::without).to_vec(),
            ]
            .concat();
            assert_eq!(scene().changed(&overrides).unwrap().time.integrator, kind);
        }
    }

    #[test]
    fn every_solver_and_preconditioner_has_its_name() {
        use fem_model::Preconditioner::{BlockJacobi, Multigrid, Ssor};
        for kind in [BlockJacobi, Multigrid, Ssor] {
            let table = SolverTable {
                kind: SolverKind::Pcg,
                tolerance: Some(1e-9),
                preconditioner: Some(kind),
                precision: None,
            };
            assert_eq!(after(&of_method("solver", Some(&table))).solver, Some(table));
        }
        use SolverKind::{Cg, Cholesky, Gpu, Lu};
        for kind in [Cholesky, Lu, Cg, Gpu] {
            let table = SolverTable { kind, tolerance: None, preconditioner: None, precision: None };
            assert_eq!(after(&of_method("solver", Some(&table))).solver, Some(table));
        }
        assert_eq!(after(&of_method("solver", None::<&SolverTable>)).solver, None);
    }

    #[test]
    fn numbers_of_newtons_method_are_set_and_taken_back() {
        let table = NewtonTable { max_iterations: Some(7), ..NewtonTable::default() };
        assert_eq!(after(&of_method("newton", Some(&table))).newton, Some(table));
    }
}
