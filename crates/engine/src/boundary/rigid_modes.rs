//! Rigid modes: a body that can move without deforming has no unique static equilibrium.

use fem_model::{Body, Refusal};
use nalgebra::{DMatrix, Matrix6, Vector3, Vector6};

use fem_elements::vector::triple;

/// A rigid motion is constrained if its stiffness is more than this part of the largest.
const LEAST: f64 = 1e-9;

/// The note on a body whose rigid motions are stabilized.
pub(crate) const STABILIZED: &str = "the constraints leave the body a rigid motion, so each load step is stabilized by a term on the mass, which is \
                          reduced until the forces that it leaves are 1e-9 of all forces or less; the body keeps its place where no \
                          force moves it";

/// Refuses a body of which a connected part can move or rotate without deforming. Obstacles may hold it.
pub(crate) fn check(body: &Body) -> Result<(), Refusal> {
    match free_part(body) {
        Some(root) if body.contact.is_none() => {
            let text = format!(
                "is static, and the part of the body with node {root} can move or rotate as a rigid body; constrain it by \
                 [fixed] or [[prescribed]], or let it rest on [[planes]]"
            );
            Err(Refusal::new("time.integrator", text))
        }
        _ => Ok(()),
    }
}

/// The first node of a connected part that can move or rotate without deforming; `None` if the constraints hold all of them. Parts that are
/// joined by springs are left to the solver.
pub(crate) fn free_part(body: &Body) -> Option<usize> {
    let part = body.shape.mesh.parts();
    let grams = gram_matrices(body.shape.mesh.vertices(), &part, &constrained_directions(body));
    let joined: Vec<usize> = body.springs.iter().flat_map(|spring| spring.nodes).map(|node| part[node]).collect();
    let is_free = |root: usize| {
        // Matrices of any size: the engine has their eigenvalues compiled already.
        let values = DMatrix::from_column_slice(6, 6, grams[root].as_slice()).symmetric_eigenvalues();
        // NaN is no constraint.
        !(values.min() > LEAST * values.max())
    };
    (0..part.len()).find(|&node| part[node] == node && !joined.contains(&node) && is_free(node))
}

/// The constrained directions of each node. The spring of a drag counts as one.
fn constrained_directions(body: &Body) -> Vec<[bool; 3]> {
    let mut constrained = vec![body.shape.mesh.fixed_directions(); body.shape.mesh.vertices().len()];
    for condition in &body.dirichlet {
        for &node in &condition.nodes {
            let before = constrained[node];
            constrained[node] = triple(|i| before[i] || condition.components[i]);
        }
    }
    if let Some(drag) = &body.drag {
        constrained[drag.node] = [true; 3];
    }
    constrained
}

/// Gram matrix of each part, at its first node: Σ r rᵀ over its constrained degrees of freedom: a direction e at the arm a from
/// the centre, in lengths of the part, moves by r · (t, ω) = e · t + (a × e) · ω under a translation t and a rotation ω.
fn gram_matrices(vertices: &[Vector3<f64>], part: &[usize], constrained: &[[bool; 3]]) -> Vec<Matrix6<f64>> {
    let mut centre = vec![(0.0, Vector3::zeros()); vertices.len()];
    for (x, &root) in vertices.iter().zip(part) {
        centre[root].0 += 1.0;
        centre[root].1 += x;
    }
    let arm = |x: &Vector3<f64>, root: usize| x - centre[root].1 / centre[root].0;
    let mut length = vec![0.0f64; vertices.len()];
    for (x, &root) in vertices.iter().zip(part) {
        length[root] = length[root].max(arm(x, root).norm());
    }
    let mut grams = vec![Matrix6::zeros(); vertices.len()];
    for ((x, &root), constrained) in vertices.iter().zip(part).zip(constrained) {
        let arm = arm(x, root) / length[root];
        for i in (0..3).filter(|&i| constrained[i]) {
            let axis = Vector3::ith(i, 1.0);
            let moment = arm.cross(&axis);
            let row = Vector6::new(axis.x, axis.y, axis.z, moment.x, moment.y, moment.z);
            grams[root] += row * row.transpose();
        }
    }
    grams
}
