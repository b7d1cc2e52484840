//! Velocities of the nodes at the start.

use std::path::{Path, PathBuf};

use fem_model::{BodyMesh, Refusal, nodes};
use nalgebra::Vector3;

use super::chosen;
use super::vectors::{Rows, vectors};
use crate::Scene;
use crate::tables::{AngularVelocityTable, InitialVelocityTable};

const PER_NODE: Rows = Rows { each: "nodes", form: "x,y,z in m/s" };

/// The velocity of each node at the start, m/s: the sum over all `[[initial_velocity]]`; empty without such a table. `density` is that
/// of each element, kg/m³, and `find` turns the path of a file in the scene into the path to open.
pub(crate) fn initial_velocity(
    scene: &Scene,
    mesh: &BodyMesh,
    density: impl Fn(usize) -> f64,
    find: impl Fn(&Path) -> PathBuf,
) -> Result<Vec<Vector3<f64>>, Refusal> {
    if scene.initial_velocity.is_empty() {
        return Ok(Vec::new());
    }
    let centre_of_mass = centre_of_mass(mesh, density);
    let mut sum = vec![Vector3::zeros(); mesh.vertices().len()];
    for (number, table) in scene.initial_velocity.iter().enumerate() {
        let name = format!("initial_velocity[{number}]");
        let nodes = match table.selectors() {
            selectors if selectors.is_empty() => (0..mesh.vertices().len()).collect(),
            selectors => nodes(&name, &chosen(selectors), mesh)?,
        };
        let field = format!("{name}.per_node");
        let path = table.per_node.as_deref().map(&find);
        let per_node = path.map(|path| {
            vectors(&path, mesh.vertices().len(), &PER_NODE).map_err(|reason| Refusal::new(&field, reason))
        });
        let per_node = per_node.transpose()?.unwrap_or_default();
        for node in nodes {
            sum[node] += velocity(table, &centre_of_mass, &mesh.vertices()[node]);
            sum[node] += per_node.get(node).map_or(Vector3::zeros(), |row| row.vector);
        }
    }
    Ok(sum)
}

/// Velocity of the table's translation and rotation at an undeformed position, m/s.
fn velocity(table: &InitialVelocityTable, centre_of_mass: &Vector3<f64>, X: &Vector3<f64>) -> Vector3<f64> {
    let translation = Vector3::from(table.velocity.unwrap_or_default());
    let rotation = table.angular.as_ref().map(|AngularVelocityTable { axis, center, rate }| {
        let arm = X - center.map_or(*centre_of_mass, Vector3::from);
        (*rate * Vector3::from(*axis).normalize()).cross(&arm)
    });
    translation + rotation.unwrap_or_default()
}

/// Centre of mass of the undeformed body, m.
fn centre_of_mass(mesh: &BodyMesh, density: impl Fn(usize) -> f64) -> Vector3<f64> {
    let (mut mass, mut moment) = (0.0, Vector3::zeros());
    for (number, (nodes, volume)) in mesh.corners().zip(mesh.volumes()).enumerate() {
        let share = density(number) * volume;
        let sum = nodes.iter().map(|&node| mesh.vertices()[node]).sum::<Vector3<f64>>();
        mass += share;
        moment += share / nodes.len() as f64 * sum;
    }
    moment / mass
}
