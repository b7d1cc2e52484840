//! Batches on a graphics device that diverge or do not converge.

use fem_model::simulation::Cause;

use crate::batch::{BEAM, ONE, VARIED, batch, build, gpu};

#[test]
fn a_run_on_the_device_whose_end_is_not_to_be_trusted_says_so() {
    let stiff = BEAM.replace("young = 2e5", "young = 2e9");
    // The linear law never inverts an element, and its numbers have not overflowed yet.
    let diverging = stiff.replace("METHOD", "semi_implicit_euler").replace("neo_hookean", "linear");
    let Some(mut batch_of_one) = batch(&format!("{diverging}{}{ONE}", gpu("f32"))) else { return };
    batch_of_one.advance(6).unwrap();
    assert!(batch_of_one.failures().unwrap().is_empty());
    batch_of_one.check_ends().unwrap();
    let failure = batch_of_one.failures().unwrap()[0].failure.clone();
    assert!(matches!(failure.cause, Cause::EnergyGained { .. }), "{failure}");

    let sound = BEAM.replace("METHOD", "verlet") + &gpu("f32");
    let mut sound = batch(&format!("{sound}{VARIED}")).unwrap();
    sound.advance(50).unwrap();
    sound.check_ends().unwrap();
    assert!(sound.failures().unwrap().is_empty() && sound.unconverged_steps() == 0);
}

#[test]
fn too_few_sweeps_on_the_device_are_unconverged_steps() {
    let text = BEAM.replace("METHOD", "vbd").replace("young = 2e5", "young = 1e12").replace("dt = 2e-3", "dt = 1e-2");
    let text = text.replace("neo_hookean", "stable_neo_hookean").replace("[0.5, -1, 0.25]", "[0, 0, 0]");
    let text = format!("{text}[iterations]\ncount = 1\n");
    let Some(mut device) = batch(&format!("{text}{}{ONE}", gpu("f64"))) else { return };
    let mut processor = build(&text).unwrap();
    device.advance(3).unwrap();
    processor.advance(3).unwrap();
    assert_eq!(device.unconverged_steps(), 0);
    device.check_ends().unwrap();
    println!("{} on the device, {} on the processor", device.unconverged_steps(), processor.unconverged_steps());
    assert!(device.unconverged_steps() > 0 && processor.unconverged_steps() > 0);
}
