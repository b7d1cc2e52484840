//! The sweeps with each kind of registers.

use super::super::super::coarse::Row;
use super::super::{Pair, Ssor};
use super::registers::{Kernel, Portable};
use super::{Backward, Forward};
use crate::ApproximateInverse;
use crate::beam::{Beam, random};
use fem_elements::sparse::Stored;

fn prepared(cells: usize) -> (Ssor, Vec<[f64; 3]>) {
    let beam = Beam::new(cells, Stored::Lower);
    let mut ssor = Ssor::new(&beam.pattern, &beam.rest);
    ssor.prepare(&beam.values::<f64>()).unwrap();
    (ssor, random(beam.pattern.rows(), 5))
}

/// The vectors after one iteration up to the curvature, which is returned too.
fn swept(is_portable: bool) -> (Vec<Row>, Vec<Pair>, f64) {
    let (mut ssor, b) = prepared(4);
    ssor.start(&b, 1.0);
    ssor.coarse.solve();
    if !is_portable {
        let curvature = ssor.next_direction(0.5);
        return (ssor.p, ssor.st, curvature);
    }
    let Ssor { matrix, coarse, shares, r, p, st, sums, .. } = &mut ssor;
    Backward { matrix, coarse, beta: 0.5, r, rows: 0..b.len(), first: 0, p, st, sums }.run(Portable);
    let ((change, places), points) = (shares.all(), &coarse.grid.nodes);
    let curvature = Forward { matrix, points, places, rows: 0..b.len(), first: 0, p, st, change }.run(Portable);
    (ssor.p, ssor.st, curvature)
}

#[test]
fn sweeps_with_the_registers_of_this_processor_and_with_those_of_every_processor_agree() {
    let ((p, st, curvature), (q, uv, other)) = (swept(false), swept(true));
    let close = |a: &[f32], b: &[f32]| {
        let largest = a.iter().fold(0.0, |largest: f32, a| largest.max(a.abs()));
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-5 * largest)
    };
    assert!(close(p.as_flattened(), q.as_flattened()));
    assert!(close(st.as_flattened().as_flattened(), uv.as_flattened().as_flattened()));
    assert!((curvature - other).abs() <= 1e-5 * other, "{curvature} {other}");
    assert!(p.iter().chain(st.as_flattened()).all(|row| row[3] == 0.0));
}
