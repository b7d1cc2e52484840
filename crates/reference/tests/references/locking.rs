//! Beams that lock, and those that do not.

use fem_reference::space::locking::{bend, ratios};
use fem_reference::{LINEAR, WITHOUT_LOCKING};

#[test]
fn a_nearly_incompressible_beam_locks() {
    let bent = bend(LINEAR, 0.4999, 2).unwrap();
    assert!(bent.ratio > 0.0 && bent.ratio < 0.1, "{bent:?}");
    assert!(bend(LINEAR, 0.0, 2).unwrap().ratio > 5.0 * bent.ratio);
}

#[test]
fn elements_without_locking_bend() {
    for elements in WITHOUT_LOCKING {
        let ratio = bend(elements, ratios(elements).last().unwrap(), 2).unwrap().ratio;
        assert!((0.5..1.05).contains(&ratio), "{elements}: {ratio}");
    }
}
