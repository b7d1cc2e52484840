//! A run with contact that is resumed from a checkpoint goes on bit for bit.

use fem_model::simulation::{Diagnostics, Simulation};

use crate::{CUBE, METHODS, build, floor, gravity, is_implicit, run, text};

#[test]
fn a_resumed_run_with_friction_and_a_moving_plane_ends_bit_for_bit_where_the_whole_one_does() {
    for method in METHODS {
        let dt = if is_implicit(method) { 0.01 } else { 5e-4 };
        let start = "[[initial_velocity]]\nvelocity = [1, -1, 0]\n";
        let plane = floor(-2e-3, "friction = 0.3\nvelocity = [0.1, 0.05, 0]\nuntil = 0.15");
        let text = text(CUBE, "neo_hookean", 1e5, method, dt, &(gravity(0.0, -9.81) + &plane + start));
        let mut whole = build(&text);
        run(&mut whole, 7);
        let checkpoint = whole.checkpoint();
        let (contacts, forces) = (whole.contacts(), whole.nodal_forces());
        run(&mut whole, 9);
        let mut resumed = build(&text);
        resumed.restore(&checkpoint).unwrap();
        assert_eq!(resumed.contacts(), contacts, "{method}");
        assert_eq!(resumed.nodal_forces(), forces, "{method}");
        run(&mut resumed, 9);
        assert!(contacts[0].force[1] > 0.0, "{method}: no contact yet");
        assert_eq!(resumed.positions(), whole.positions(), "{method}");
        assert_eq!(resumed.velocities(), whole.velocities(), "{method}");
        assert_eq!(resumed.contacts(), whole.contacts(), "{method}");
        whole.reset();
        assert_eq!(whole.contacts()[0].force, [0.0; 3], "{method}");
    }
}
