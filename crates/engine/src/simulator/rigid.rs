//! Whether a body can move as a whole, which equilibrium does not allow.

use nalgebra::{Matrix6, Vector3, Vector6};

use super::Refusal;
use fem_scene::Body;

/// A motion is held where its stiffness is more than this part of the largest.
const LEAST: f64 = 1e-9;

/// Refuses a body of which a part can move or turn without deforming. Parts that springs join are left to the solver.
pub(super) fn check(body: &Body) -> Result<(), Refusal> {
    let part = parts(body);
    let grams = grams(&body.shape.mesh.vertices, &part, &held(body));
    let joined: Vec<usize> = body.springs.iter().flat_map(|spring| spring.nodes).map(|node| part[node]).collect();
    for root in (0..part.len()).filter(|&node| part[node] == node && !joined.contains(&node)) {
        let values = grams[root].symmetric_eigenvalues();
        // NaN is no hold either.
        let is_held = values.min() > LEAST * values.max();
        if !is_held {
            let text = format!(
                "is static, and nothing keeps the part of the body with node {root} from moving or turning as a whole; hold it \
                 by [fixed] or [[prescribed]]"
            );
            return Err(("time.integrator", text));
        }
    }
    Ok(())
}

/// Which directions of each node something holds.
fn held(body: &Body) -> Vec<[bool; 3]> {
    let mut held = vec![[false; 3]; body.shape.mesh.vertices.len()];
    if let Some(drag) = &body.drag {
        held[drag.node] = [true; 3];
    }
    for condition in &body.dirichlet {
        for &node in &condition.nodes {
            held[node] = std::array::from_fn(|i| held[node][i] || condition.components[i]);
        }
    }
    held
}

/// For each part, at its first node, Σ r rᵀ over what is held: a direction e at the arm a from the middle, in lengths of the
/// part, sees of a translation t and a turn ω the motion r · (t, ω) = e · t + (a × e) · ω.
fn grams(vertices: &[Vector3<f64>], part: &[usize], held: &[[bool; 3]]) -> Vec<Matrix6<f64>> {
    let mut middle = vec![(0.0, Vector3::zeros()); vertices.len()];
    for (x, &root) in vertices.iter().zip(part) {
        middle[root].0 += 1.0;
        middle[root].1 += x;
    }
    let arm = |x: &Vector3<f64>, root: usize| x - middle[root].1 / middle[root].0;
    let mut length = vec![0.0f64; vertices.len()];
    for (x, &root) in vertices.iter().zip(part) {
        length[root] = length[root].max(arm(x, root).norm());
    }
    let mut grams = vec![Matrix6::zeros(); vertices.len()];
    for ((x, &root), held) in vertices.iter().zip(part).zip(held) {
        let arm = arm(x, root) / length[root];
        for i in (0..3).filter(|&i| held[i]) {
            let axis = Vector3::ith(i, 1.0);
            let turn = arm.cross(&axis);
            let row = Vector6::new(axis.x, axis.y, axis.z, turn.x, turn.y, turn.z);
            grams[root] += row * row.transpose();
        }
    }
    grams
}

/// The first node of the connected part that each node belongs to.
fn parts(body: &Body) -> Vec<usize> {
    let nodes = body.shape.mesh.vertices.len();
    let mut parent: Vec<usize> = (0..nodes).collect();
    fn root(parent: &mut [usize], mut node: usize) -> usize {
        while parent[node] != node {
            parent[node] = parent[parent[node]];
            node = parent[node];
        }
        node
    }
    for element in &body.shape.mesh.elements {
        for &node in &element[1..] {
            let (a, b) = (root(&mut parent, element[0]), root(&mut parent, node));
            let least = a.min(b);
            parent[a] = least;
            parent[b] = least;
        }
    }
    (0..nodes).map(|node| root(&mut parent, node)).collect()
}
