//! Vectors and blocks go to the nodes of their lanes and come from them.

use fem_elements::number::{Float, Lanes};

fn lanes<L: Lanes>(value: impl Fn(usize) -> f64) -> L {
    let mut lanes = L::zero();
    (0..L::LANES).for_each(|lane| lanes.set_lane(lane, L::Element::of(value(lane))));
    lanes
}

fn each_lane_is_added_to_its_own_target<L: Lanes>() {
    let entry = |i: usize, j: usize, lane: usize| (100 * i + 10 * j + lane) as f64;
    let block: [[L; 3]; 3] = [0, 1, 2].map(|i| [0, 1, 2].map(|j| lanes(|lane| entry(i, j, lane))));
    let target = |lane: usize| (2 * lane) as u32; // the last is out of range
    let mut blocks = vec![[[L::Element::of(1.0); 3]; 3]; 2 * L::LANES - 2];
    L::add_by_lane(&block, &mut blocks, target);
    let mut sums = vec![[L::Element::of(1.0); 3]; 2 * L::LANES - 2];
    L::add_vectors_by_lane(&block[2], &mut sums, target);
    for (number, (block, sum)) in blocks.iter().zip(&sums).enumerate() {
        let added = |i, j| if number % 2 == 0 { entry(i, j, number / 2) } else { 0.0 };
        for j in 0..3 {
            (0..3).for_each(|i| assert_eq!(block[i][j], L::Element::of(1.0 + added(i, j)), "block {number}"));
            assert_eq!(sum[j], L::Element::of(1.0 + added(2, j)), "vector {number}");
        }
    }
    let gathered = L::zero().gather(&sums, |lane| (lane % sums.len()) as u32);
    for lane in 0..L::LANES {
        (0..3).for_each(|j| assert_eq!(gathered[j].lane(lane), sums[lane % sums.len()][j]));
    }
}

#[test]
fn vectors_and_blocks_of_each_lane_reach_the_nodes_that_they_name_and_no_other() {
    each_lane_is_added_to_its_own_target::<<f64 as Float>::Lanes>();
    each_lane_is_added_to_its_own_target::<<f32 as Float>::Lanes>();
}
