//! Bodies that start with a velocity.

use nalgebra::Vector3;

use crate::{DYNAMIC, build, run, soft};

const THROW: &str = "[[initial_velocity]]\nvelocity = [1, 2, -3]\n";

#[test]
fn a_thrown_body_flies_straight_without_deforming_under_every_method() {
    for integrator in DYNAMIC {
        let mut simulation = build(&soft(integrator, 0.01, THROW));
        let start = simulation.positions();
        let kinetic = simulation.energies().kinetic;
        assert!((kinetic - 0.5 * 2000.0 * 14.0).abs() < 1e-9, "{integrator}: {kinetic}");
        run(&mut *simulation, 10);
        for (i, (x, before)) in simulation.positions().iter().zip(start.iter()).enumerate() {
            let expected = before + 0.1 * [1.0, 2.0, -3.0][i % 3];
            assert!((x - expected).abs() < 1e-12, "{integrator}: {x} {expected}");
        }
    }
}

#[test]
fn a_reset_restores_the_initial_velocity() {
    let spin = "[[initial_velocity]]\nangular = { axis = [1, 2, 3], rate = 0.5 }\n";
    for integrator in DYNAMIC {
        let mut simulation = build(&soft(integrator, 0.01, spin));
        let start = (simulation.positions(), simulation.velocities());
        assert!(start.1.amax() > 0.1);
        run(&mut *simulation, 3);
        let first = simulation.positions();
        simulation.reset();
        assert_eq!((simulation.positions(), simulation.velocities(), simulation.time()), (start.0, start.1, 0.0));
        run(&mut *simulation, 3);
        assert_eq!(simulation.positions(), first, "{integrator}");
    }
}

#[test]
fn constrained_nodes_keep_their_prescribed_motion() {
    let tables =
        format!("{THROW}[fixed]\nnodes = [0]\n[[prescribed]]\nnodes = [1]\ndisplacement = [0.5, 0, 0]\nover = 1\n");
    for integrator in DYNAMIC {
        let mut simulation = build(&soft(integrator, 1e-3, &tables));
        let at =
            |values: &nalgebra::DVector<f64>, node: usize| -> Vector3<f64> { values.fixed_rows::<3>(3 * node).into() };
        let v = simulation.velocities();
        assert_eq!(
            (at(&v, 0), at(&v, 1), at(&v, 2)),
            (Vector3::zeros(), Vector3::zeros(), Vector3::new(1.0, 2.0, -3.0))
        );
        run(&mut *simulation, 20);
        let x = simulation.positions();
        assert_eq!(at(&x, 0), Vector3::zeros());
        assert!((at(&x, 1) - Vector3::new(1.01, 0.0, 0.0)).norm() < 1e-13, "{integrator}: {}", at(&x, 1));
    }
}
