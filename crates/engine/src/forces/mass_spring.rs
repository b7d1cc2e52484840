//! Mass-spring bodies: every edge of the mesh is a spring with a damper beside it, and no element is elastic.
//!
//! With `young` an edge of length l has k = E Σ V / l², summed over its elements: Van Gelder, Approximate simulation of elastic membranes by
//! triangulated spring meshes (1998), eq. 20. His triangles are those of a flat body with V = area times thickness.
//!
//! Springs transmit central forces, so the stiffness tensor C = Σ k l² n⊗n⊗n⊗n / V of an affine deformation has Cauchy's symmetry: an
//! isotropic lattice has λ = μ, which is ν = 1/4 in space and ν = 1/3 in the plane (Love, Mathematical Theory of Elasticity, 1927, note B).

use fem_model::{Body, EdgeStiffness, Law, Spring};

use super::Potential;
use super::springs::{Source, Springs};
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Key in the statistics.
pub const NAME: &str = "mass_spring";

/// The springs of a mass-spring body; `None` for a body of elastic elements.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    let edges = edges(body);
    if edges.is_empty() {
        return None;
    }
    let source = Source { name: NAME, table: "material", description: description(&edges) };
    Some(Box::new(Springs::new(source, body, &edges, numbering)))
}

/// The spring of each edge of a mass-spring body, with its nodes in the mesh's numbers; empty for a body of elastic elements.
pub fn edges(body: &Body) -> Vec<Spring> {
    let Law::MassSpring { stiffness, damping } = body.material.law else { return Vec::new() };
    let mesh = &body.shape.mesh;
    let stiffness = |share: EdgeVolume, square: f64| match stiffness {
        // The factors on the moduli of elements scale a common stiffness by their mean over the edge's elements.
        EdgeStiffness::Uniform(stiffness) => stiffness * share.weighted / share.volume,
        EdgeStiffness::Young(young) => young * share.weighted / square,
    };
    let spring = |(nodes, share): ([usize; 2], EdgeVolume)| {
        let [a, b] = nodes.map(|node| mesh.vertices()[node]);
        Spring {
            nodes,
            stiffness: stiffness(share, (b - a).norm_squared()),
            rest_length: (b - a).norm(),
            is_initially_relaxed: true,
            damping,
        }
    };
    volumes_of_edges(body).into_iter().map(spring).collect()
}

/// Shear modulus of the isotropic mean of a mass-spring body's springs in an affine deformation, Pa: Σ k l² / (d (d + 2) V) in d dimensions. Zero for a body of elastic elements.
pub fn shear_modulus(body: &Body) -> f64 {
    let sum: f64 = edges(body).iter().map(|spring| spring.stiffness * spring.rest_length * spring.rest_length).sum();
    if sum == 0.0 {
        return 0.0;
    }
    let volume: f64 = body.shape.mesh.volumes().iter().sum();
    let dimension = body.shape.mesh.dimension();
    sum / (volume * (dimension * (dimension + 2)) as f64)
}

/// Volume of the elements around an edge, m³, and its sum weighted by the factors on their moduli.
#[derive(Clone, Copy, Default)]
struct EdgeVolume {
    volume: f64,
    weighted: f64,
}

/// The edges of the mesh, each once with its smaller node first, in ascending order.
fn volumes_of_edges(body: &Body) -> Vec<([usize; 2], EdgeVolume)> {
    let mesh = &body.shape.mesh;
    let factor = |element: usize| body.stiffness_factors.get(element).copied().unwrap_or(1.0);
    let mut shares: Vec<([usize; 2], EdgeVolume)> = Vec::new();
    for (element, (nodes, volume)) in mesh.corners().zip(mesh.volumes()).enumerate() {
        let share = EdgeVolume { volume, weighted: factor(element) * volume };
        for (i, &a) in nodes.iter().enumerate() {
            shares.extend(nodes[..i].iter().map(|&b| ([a.min(b), a.max(b)], share)));
        }
    }
    // Stable, so that sums over the elements of an edge keep their order.
    shares.sort_by_key(|(nodes, _)| *nodes);
    let add = |sum: EdgeVolume, (_, share): &([usize; 2], EdgeVolume)| EdgeVolume {
        volume: sum.volume + share.volume,
        weighted: sum.weighted + share.weighted,
    };
    let same = shares.chunk_by(|one, next| one.0 == next.0);
    same.map(|of_edge| (of_edge[0].0, of_edge.iter().fold(EdgeVolume::default(), add))).collect()
}

fn description(edges: &[Spring]) -> String {
    let stiffness = edges.iter().map(|spring| spring.stiffness);
    let (least, most) = stiffness.fold((f64::INFINITY, 0.0), |(least, most), k| (k.min(least), k.max(most)));
    let range = if least == most { format!("{least:.4e}") } else { format!("{least:.4e} to {most:.4e}") };
    let damping = match edges[0].damping {
        0.0 => String::new(),
        damping => format!(", damping {damping:.4e} N s/m along each"),
    };
    format!("[material] with model \"mass_spring\": {} edges of {range} N/m{damping}", edges.len())
}
