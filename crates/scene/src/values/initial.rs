//! Velocities of the nodes at the start.

use std::path::{Path, PathBuf};

use fem_model::{BodyMesh, Refusal, nodes};
use nalgebra::Vector3;

use super::chosen;
use crate::Scene;
use crate::tables::{AngularVelocityTable, InitialVelocityTable};

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
        let per_node =
            path.map(|path| velocities(&path, mesh.vertices().len()).map_err(|reason| Refusal::new(&field, reason)));
        let per_node = per_node.transpose()?.unwrap_or_default();
        for node in nodes {
            sum[node] += velocity(table, &centre_of_mass, &mesh.vertices()[node]);
            sum[node] += per_node.get(node).copied().unwrap_or_default();
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

/// Reads a velocity for each node: three numbers a line, after a line of titles if there is one. The error continues a sentence that
/// begins with the field.
fn velocities(path: &Path, nodes: usize) -> Result<Vec<Vector3<f64>>, String> {
    let file = path.display();
    let text = std::fs::read_to_string(path)
        .map_err(|error| format!("is {file}, which cannot be read: {error}; check the path"))?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let has_titles = |line: &str| line.split(',').all(|word| word.trim().parse::<f64>().is_err());
    let mut velocities = Vec::new();
    for (number, line) in lines.filter(|(number, line)| *number > 0 || !has_titles(line)) {
        let at = || format!("is {file}, whose line {}", number + 1);
        let numbers: Result<Vec<f64>, _> = line.split(',').map(|word| word.trim().parse()).collect();
        let numbers = numbers.map_err(|_| format!("{} is no list of numbers; write x,y,z in m/s", at()))?;
        let [x, y, z] = numbers[..] else {
            return Err(format!("{} has {} numbers; write x,y,z in m/s", at(), numbers.len()));
        };
        if !numbers.iter().all(|number| number.abs() <= LARGEST) {
            return Err(format!("{} has a number that is not finite or too large; give at most {LARGEST:e}", at()));
        }
        velocities.push(Vector3::new(x, y, z));
    }
    if velocities.len() == nodes {
        return Ok(velocities);
    }
    Err(format!("is {file}, which has {} lines; the mesh has {nodes} nodes, give a line for each", velocities.len()))
}

/// Largest component of a velocity, m/s: squares of it do not overflow.
const LARGEST: f64 = 1e60;
