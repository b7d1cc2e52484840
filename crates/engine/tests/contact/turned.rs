//! A scene that is turned as a whole has the same answer.

use fem_engine::simulator::Simulator;
use fem_mesh::TetrahedralMesh;
use fem_model::simulation::{Diagnostics, Shape, Simulation};
use nalgebra::{Rotation3, Vector3};

use crate::{CUBE, METHODS, is_implicit, run, scene, text};

/// A cube that falls, spins and slides into the corner of two rough planes, all turned.
fn falling(turn: Rotation3<f64>, method: &str, dt: f64) -> Simulator<f64> {
    let vector = |x: f64, y: f64, z: f64| {
        let v = turn * Vector3::new(x, y, z);
        format!("[{:e}, {:e}, {:e}]", v.x, v.y, v.z)
    };
    let plane =
        |point: String, normal: String| format!("[[planes]]\npoint = {point}\nnormal = {normal}\nfriction = 0.4\n");
    let axis = turn * Vector3::new(0.2, 1.0, 0.3);
    let tables = format!(
        "{}{}[gravity]\nacceleration = {}\n[[initial_velocity]]\nvelocity = {}\nangular = {{ axis = [{:e}, {:e}, {:e}], rate = 2 }}\n",
        plane(vector(0.0, -3e-3, 0.0), vector(0.0, 1.0, 0.0)),
        plane(vector(-0.01, 0.0, 0.0), vector(1.0, 0.2, 0.0)),
        vector(0.0, -9.81, 0.0),
        vector(-0.3, -0.2, 0.5),
        axis.x,
        axis.y,
        axis.z
    );
    let of_text = |tables: &str| scene(&text(CUBE, "stable_neo_hookean", 1e5, method, dt, tables));
    // The planes would go through the upright cube.
    let mut shape: Shape = fem_scene::body(&of_text(""), "no data".as_ref()).unwrap().shape;
    let scene = of_text(&tables);
    let mut mesh: TetrahedralMesh = shape.mesh.mesh().unwrap();
    mesh.vertices.iter_mut().for_each(|x| *x = turn * *x);
    shape.mesh = mesh.into();
    Simulator::new(fem_scene::body_of_shape(&scene, shape, "no data".as_ref()).unwrap(), &scene.method()).unwrap()
}

#[test]
fn a_scene_that_is_turned_as_a_whole_ends_where_the_upright_one_does() {
    let turn = Rotation3::from_euler_angles(0.3, -0.7, 1.9);
    for method in METHODS {
        let dt = if is_implicit(method) { 5e-3 } else { 5e-4 };
        let (mut upright, mut turned) = (falling(Rotation3::identity(), method, dt), falling(turn, method, dt));
        let steps = (0.1 / dt) as usize;
        run(&mut upright, steps);
        run(&mut turned, steps);
        assert!(upright.contacts().iter().all(|contact| contact.force[0] > 0.0 || contact.force[1] > 0.0), "{method}");
        let (q, of_turned) = (upright.positions(), turned.positions());
        for node in 0..q.len() / 3 {
            let x = turn * Vector3::from(q.fixed_rows::<3>(3 * node));
            let apart = (x - of_turned.fixed_rows::<3>(3 * node)).norm();
            assert!(apart < 1e-8, "{method}: node {node} is {apart:e} m apart");
        }
    }
}
