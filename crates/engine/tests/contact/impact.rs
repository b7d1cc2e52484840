//! A bar that hits a wall: the wave of compression runs to its free end and back.

use fem_scene::simulation::Simulation;

use crate::{build, contact_force, momentum, run};

/// A bar of 1 m in 100 squares without lateral motion, which meets a wall at x = 0 with 0.1 m/s; c = 10 m/s.
fn bar(method: &str, dt: f64, contact: &str) -> String {
    format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [1, 0.01], cells_per_unit = 100 }}\n\
         [material]\nmodel = \"linear\"\nyoung = 1e5\npoisson = 0\ndensity = 1000\n\
         [time]\ndt = {dt:e}\nintegrator = \"{method}\"\n\
         [[planes]]\npoint = [-1e-6, 0, 0]\nnormal = [1, 0, 0]\n{contact}\
         [[initial_velocity]]\nvelocity = [-0.1, 0, 0]\n"
    )
}

#[test]
fn an_elastic_bar_leaves_the_wall_after_two_passages_of_the_wave() {
    let fine = "[contact]\nactivation_distance = 2e-5\n";
    for (method, dt, contact) in
        [("verlet", 4e-4, ""), ("semi_implicit_euler", 4e-4, ""), ("implicit_euler", 4e-4, fine)]
    {
        let mut simulation = build(&bar(method, dt, contact));
        let before = momentum(&simulation)[0];
        let (mut first, mut last, mut impulse, mut steady) = (f64::INFINITY, 0.0, 0.0, Vec::new());
        while simulation.time() < 0.3 {
            run(&mut simulation, 1);
            let (time, force) = (simulation.time(), contact_force(&simulation)[0]);
            impulse += dt * force;
            if force > 0.0 {
                (first, last) = (f64::min(first, time), time);
            }
            if (0.04..0.16).contains(&time) {
                steady.push(force / 0.01);
            }
        }
        let duration = last - first;
        assert!((duration - 0.2).abs() < 0.02 * 0.2, "{method}: in contact for {duration} s");
        // ρ c v = 1000 Pa
        let stress = steady.iter().sum::<f64>() / steady.len() as f64;
        assert!((stress - 1000.0).abs() < 20.0, "{method}: {stress} Pa");
        let change = momentum(&simulation)[0] - before;
        assert!((impulse - change).abs() < 1e-5 * change, "{method}: {impulse} {change}");
    }
}
