//! Parts of a matrix, and products by parts.

use fem_elements::sparse::{Block, Pattern, Stored};
use fem_solvers::krylov;
use fem_solvers::parts::Part;

use super::beam::{Beam, random};

fn parts(pattern: &Pattern) -> Part {
    Part::new(pattern.rows(), |row| &pattern.columns[pattern.row(row)])
}

fn assert_independent(part: &Part, pattern: &Pattern) {
    let Some([a, b]) = part.halves.as_deref() else { return };
    assert_eq!((a.rows.start, a.rows.end, b.rows.end), (part.rows.start, b.rows.start, part.own().start));
    for row in b.rows.clone() {
        assert!(pattern.columns[pattern.row(row)].iter().all(|&column| !a.rows.contains(&(column as usize))));
    }
    assert_eq!((a.numbers.end, b.numbers.end), (b.numbers.start, part.numbers.end - 1));
    assert_independent(a, pattern);
    assert_independent(b, pattern);
}

#[test]
fn a_large_beam_falls_into_halves_without_a_common_block_and_a_thin_separator() {
    for stored in [Stored::Lower, Stored::Full] {
        let beam = Beam::new(12, stored);
        let part = parts(&beam.pattern);
        assert_independent(&part, &beam.pattern);
        assert!(part.numbers.len() >= 7, "{part:?}");
        assert!(part.own().len() < 400, "{part:?}");
    }
}

#[test]
fn a_small_beam_is_one_part() {
    let pattern = Beam::new(4, Stored::Lower).pattern;
    let part = parts(&pattern);
    assert!(part.halves.is_none() && part.own() == (0..pattern.rows()));
}

#[test]
fn rows_that_are_all_coupled_are_one_part() {
    let elements: Vec<[u32; 2]> = (1..4000).map(|row| [0, row]).collect();
    assert!(parts(&Pattern::new(4000, &elements, Stored::Lower)).halves.is_none());
}

fn product(pattern: &Pattern, values: &[Block<f64, 3>], x: &[[f64; 3]], y: &mut [[f64; 3]]) {
    krylov::product(pattern, &krylov::parts(pattern), values, x, y);
}

#[test]
fn a_product_sums_blocks_times_nodes() {
    let pattern = Pattern::new(2, &[[0, 1]], Stored::Full);
    let scaled = |a: f64| [[a, 0.0, 0.0], [0.0, a, 0.0], [0.0, 0.0, a]];
    let values = [[[1.0, 2.0, 0.0], [3.0, 4.0, 0.0], [0.0, 0.0, 1.0]], scaled(0.5), [[0.0; 3]; 3], scaled(2.0)];
    let mut y = [[0.0; 3]; 2];
    product(&pattern, &values, &[[1.0, 1.0, 3.0], [2.0, 4.0, -2.0]], &mut y);
    assert_eq!(y, [[4.0, 9.0, 2.0], [4.0, 8.0, -4.0]]);
}

#[test]
fn full_and_lower_storage_give_the_same_product() {
    let (full, lower) = (Beam::new(10, Stored::Full), Beam::new(10, Stored::Lower));
    assert!(krylov::parts(&lower.pattern).halves.is_some());
    let x = random::<f64>(full.pattern.rows(), 1);
    let (mut y, mut z) = (vec![[0.0; 3]; x.len()], vec![[f64::NAN; 3]; x.len()]);
    product(&full.pattern, &full.values(), &x, &mut y);
    product(&lower.pattern, &lower.values(), &x, &mut z);
    for (y, z) in y.as_flattened().iter().zip(z.as_flattened()) {
        approx::assert_relative_eq!(y, z, max_relative = 1e-9, epsilon = 1e-6);
    }
}
