//! Aggregates, the coarse nodes: neighbourhoods of nodes, each of which moves like a rigid body.

use super::blocks::Blocks;

/// Marks a node without an aggregate.
const NONE: u32 = u32::MAX;

/// Coarse nodes of an aggregate in its first pass. A coarse matrix couples a node with three or four times as many, and aggregates of
/// all of them would leave too few nodes for the motions of the next level: the cycle would need more iterations with each level.
const COARSE_NEIGHBOURS: usize = 8;

/// Adjacent nodes at more than this multiple of the distance of the nearest one are weakly coupled: with them, an aggregate of stretched elements
/// would be long, and the smoother, which is slow along weak couplings, would leave too much to the coarse level.
const FAR: f64 = 4.0;

/// The aggregate of each node, and the number of aggregates, from the pattern of A and the positions of its nodes. First whole
/// neighbourhoods become aggregates, then each remaining node joins an adjacent one (Vaněk, Mandel and Brezina, Algebraic Multigrid by
/// Smoothed Aggregation for Second and Fourth Order Elliptic Problems, 1996), or becomes one of its own if there is none.
pub fn aggregate<const D: usize>(A: &Blocks<D, D>, positions: &[[f64; 3]]) -> (Vec<u32>, usize) {
    let mut aggregates = vec![NONE; A.rows()];
    let mut count = 0;
    for node in 0..A.rows() {
        if aggregates[node] != NONE {
            continue;
        }
        let neighbours = neighbours(A, node, positions);
        if neighbours.iter().all(|&other| aggregates[other as usize] == NONE) {
            neighbours.iter().for_each(|&other| aggregates[other as usize] = count);
            count += 1;
        }
    }
    // Nodes join aggregates of the first pass only, so that no aggregate grows across the body.
    let first = aggregates.clone();
    for node in 0..A.rows() {
        let adjacent = || neighbours(A, node, positions).into_iter().chain(A.row(node).0.iter().copied());
        if aggregates[node] == NONE {
            let near = adjacent().map(|other| first[other as usize]).find(|&near| near != NONE);
            aggregates[node] = near.unwrap_or(count);
            count += u32::from(near.is_none());
        }
    }
    (aggregates, count as usize)
}

/// The node and the nodes that join its aggregate: on the finest level the adjacent ones that are not [far](FAR), on the others the nearest.
fn neighbours<const D: usize>(A: &Blocks<D, D>, node: usize, positions: &[[f64; 3]]) -> Vec<u32> {
    let mut neighbours = A.row(node).0.to_vec();
    let squared_distance =
        |&other: &u32| (0..3).map(|i| (positions[other as usize][i] - positions[node][i]).powi(2)).sum::<f64>();
    if D > 3 && neighbours.len() > COARSE_NEIGHBOURS {
        neighbours.sort_by(|a, b| squared_distance(a).total_cmp(&squared_distance(b)).then(a.cmp(b)));
        neighbours.truncate(COARSE_NEIGHBOURS);
    }
    if D == 3 {
        let others = neighbours.iter().filter(|&&other| other as usize != node);
        let nearest = others.map(squared_distance).fold(f64::INFINITY, f64::min);
        neighbours.retain(|other| squared_distance(other) <= FAR * FAR * nearest);
    }
    neighbours
}

/// Mean position of the nodes of each aggregate.
pub fn centres(aggregates: &[u32], count: usize, positions: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 4]; count];
    for (&aggregate, position) in aggregates.iter().zip(positions) {
        let sum = &mut sums[aggregate as usize];
        (0..3).for_each(|i| sum[i] += position[i]);
        sum[3] += 1.0;
    }
    sums.iter().map(|sum| [sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]]).collect()
}
