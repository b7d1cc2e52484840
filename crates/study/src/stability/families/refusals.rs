//! Unusable scenes and meshes, which an error that names the element or key must refuse.

use std::path::Path;

use fem_mesh::TetrahedralMesh;
use fem_model::Integrator;
use fem_scene::parse;
use nalgebra::Vector3;

use super::*;

const FAMILY: &str = "refusals";

/// Adds the family.
pub fn add(cases: &mut Vec<Case>) {
    for (name, from, to, names) in FIELDS {
        cases.push(refusal(name, format!("`{}`", to.replace('\n', "; ")), names, move || {
            let scene = parse(&scene(Integrator::ImplicitEuler).replace(from, to), Path::new("case.toml"));
            let body = scene.and_then(|scene| fem_scene::body(&scene, Path::new("")));
            body.map(|_| ()).map_err(|error| error.to_string())
        }));
    }
    for (name, spoil, names) in MESHES {
        cases.push(refusal(name, "a box of 12 vertices and 12 tetrahedra".to_owned(), names, move || {
            let spoiled = moved_box([2.0, 1.0, 1.0], 1, |x| *x).and_then(|mut mesh| {
                spoil(&mut mesh);
                Setup::small(Integrator::ImplicitEuler, "neo_hookean").build_on::<f64>(mesh)
            });
            spoiled.map(|_| ()).map_err(|finding| finding.note)
        }));
    }
}

/// A scene file of a clamped box.
pub fn scene(integrator: Integrator) -> String {
    format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [2, 1, 1], pattern = \"kuhn\", cells_per_unit = 1 }}\n[material]\nmodel = \"neo_hookean\"\n\
         young = 1e5\npoisson = 0.3\ndensity = 1e3\n[time]\ndt = 1e-2\nintegrator = \"{}\"\n[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n",
        integrator.name()
    )
}

/// Name of the defect, text to replace, replacement, and the words that the error must contain.
const FIELDS: [(&str, &str, &str, &str); 24] = [
    ("density is zero", "density = 1e3", "density = 0", "material.density"),
    ("density is negative", "density = 1e3", "density = -1000", "material.density"),
    ("density is NaN", "density = 1e3", "density = nan", "material.density"),
    ("density is infinite", "density = 1e3", "density = inf", "material.density"),
    ("E is zero", "young = 1e5", "young = 0", "material.young"),
    ("E is negative", "young = 1e5", "young = -1e5", "material.young"),
    ("E is NaN", "young = 1e5", "young = nan", "material.young"),
    ("E is infinite", "young = 1e5", "young = inf", "material.young"),
    ("nu is a half", "poisson = 0.3", "poisson = 0.5", "material.poisson"),
    ("nu is above a half", "poisson = 0.3", "poisson = 0.6", "material.poisson"),
    ("nu is -1", "poisson = 0.3", "poisson = -1.0", "material.poisson"),
    ("nu is NaN", "poisson = 0.3", "poisson = nan", "material.poisson"),
    ("dt is zero", "dt = 1e-2", "dt = 0.0", "time.dt"),
    ("dt is negative", "dt = 1e-2", "dt = -0.01", "time.dt"),
    ("dt is NaN", "dt = 1e-2", "dt = nan", "time.dt"),
    ("dt is infinite", "dt = 1e-2", "dt = inf", "time.dt"),
    ("unknown integrator", "\"implicit_euler\"", "\"leapfrog\"", "leapfrog"),
    ("unknown material", "\"neo_hookean\"", "\"rubber\"", "rubber"),
    ("unknown key", "poisson = 0.3", "poisson = 0.3\nviscosity = 1", "viscosity"),
    ("a fixed node out of range", "plane = { axis = \"x\", below = 1e-9 }", "nodes = [12]", "fixed.nodes"),
    ("a box with half cells", "[2, 1, 1]", "[2.5, 1, 1]", "along x"),
    ("a box of length 0", "[2, 1, 1]", "[0, 1, 1]", "along x"),
    ("a box with too many cells", "cells_per_unit = 1", "cells_per_unit = 1000", "mesh.box"),
    ("a scale of zero", "cells_per_unit = 1 }", "cells_per_unit = 1 }\nscale = 0", "mesh.scale"),
];

type Spoil = fn(&mut TetrahedralMesh);

const MESHES: [(&str, Spoil, &str); 12] = [
    ("an element without volume", |mesh| mesh.vertices[5] = mesh.vertices[4], "element"),
    ("an element flattened to a plane", |mesh| flatten(mesh, 1.0, 1.0, 0.0), "element 0"),
    ("all elements on a line", |mesh| flatten(mesh, 1.0, 0.0, 0.0), "element 0"),
    ("all elements in a point", |mesh| flatten(mesh, 0.0, 0.0, 0.0), "element 0"),
    ("an inverted element", |mesh| mesh.elements[7].swap(0, 1), "element 7"),
    ("an index out of range", |mesh| mesh.elements[3][2] = 12, "element 3"),
    ("a vertex twice in an element", |mesh| mesh.elements[4][1] = mesh.elements[4][0], "element 4"),
    ("a vertex without an element", |mesh| mesh.vertices.push(Vector3::zeros()), "vertex 12"),
    ("a coordinate that is NaN", |mesh| mesh.vertices[6].y = f64::NAN, "vertex 6"),
    ("a coordinate that is infinite", |mesh| mesh.vertices[2].x = f64::INFINITY, "vertex 2"),
    ("coordinates too large", |mesh| flatten(mesh, 1e200, 1e200, 1e200), "element 0"),
    ("no elements", |mesh| mesh.elements.clear(), "tetrahedra"),
];

fn flatten(mesh: &mut TetrahedralMesh, x: f64, y: f64, z: f64) {
    for vertex in &mut mesh.vertices {
        vertex.component_mul_assign(&Vector3::new(x, y, z));
    }
}

/// A case that must be refused by an error with some words.
pub fn refusal(
    name: &str,
    parameters: String,
    names: &'static str,
    attempt: impl FnOnce() -> Result<(), String> + Send + 'static,
) -> Case {
    Case {
        family: FAMILY,
        case: name.to_owned(),
        parameters,
        integrator: "-".to_owned(),
        material: "-".to_owned(),
        expected: Outcome::Refused,
        margin_is: "1 if the message names the element or key, else 0",
        seed: None,
        work: Box::new(move |_| match attempt() {
            Ok(()) => Finding::new(Outcome::Accepted, 0.0, ""),
            Err(message) if message.contains(names) => Finding::new(Outcome::Refused, 1.0, message),
            Err(message) => Finding::new(Outcome::Deviates, 0.0, format!("the error does not name {names}: {message}")),
        }),
    }
}
