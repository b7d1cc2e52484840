//! Springs of a drag and of a pull.

use fem_model::simulation::Pull;
use fem_model::{Anchor, Drag, Interaction};
use nalgebra::Vector3;

fn dragged() -> Interaction {
    let direction = Vector3::new(0.0, 2.0, 0.0);
    let drag = Drag { node: 1, stiffness: 5.0, direction, amplitude: 0.5, frequency: 0.25 };
    Interaction::new(Some(drag), 0.0)
}

const VERTICES: [Vector3<f64>; 2] = [Vector3::new(0.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0)];

#[test]
fn the_target_of_a_drag_is_a_sine_of_time() {
    let interaction = dragged();
    let at = |time| interaction.anchors(&VERTICES, time).next().unwrap();
    assert_eq!(at(0.0), Anchor { node: 1, displacement: Vector3::zeros() });
    assert_eq!(at(1.0).displacement, Vector3::new(0.0, 1.0, 0.0));
    assert!((at(3.0).displacement - Vector3::new(0.0, -1.0, 0.0)).norm() < 1e-15);
}

#[test]
fn a_pull_replaces_the_drag_until_it_ends() {
    let mut interaction = dragged();
    let place = Vector3::new(0.0, 0.0, 0.25);
    interaction.set_pull(Some(Pull { anchors: vec![(0, place)], offset: Vector3::x() }));
    let expected = Anchor { node: 0, displacement: Vector3::new(1.0, 0.0, 0.25) };
    assert_eq!(interaction.anchors(&VERTICES, 1.0).collect::<Vec<_>>(), [expected]);
    interaction.set_pull(None);
    assert_eq!(interaction.anchors(&VERTICES, 1.0).next().unwrap().node, 1);
}
