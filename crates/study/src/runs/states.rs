//! State files, from which every error can be recomputed.

use std::path::Path;

use nalgebra::DVector;

use fem_mesh::write::save_bytes;
use fem_model::BodyMesh;
use fem_reference::space::norms;
use fem_reference::time::Reference;

/// The state at the end of a run.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    /// Time, s.
    pub time: f64,
    /// Positions of all nodes, m.
    pub q: &'a DVector<f64>,
    /// Velocities of all nodes, m/s.
    pub qdot: &'a DVector<f64>,
    /// Kinetic and potential energy, J.
    pub energies: (f64, f64),
}

/// Writes `time`, `kinetic`, `potential`, `q`, `qdot` with 17 significant digits.
pub fn write_state(path: &Path, snapshot: &Snapshot) -> Result<(), String> {
    save_bytes(path, format!("{{\n{}\n}}\n", fields(snapshot)).as_bytes()).map_err(|error| error.to_string())
}

/// Writes a reference: a state with its self-check, and the data of the error norms: `rest`, `elements`, `weights` (m³), `length`
/// (m) and `density` (kg/m³).
pub fn write_reference(
    path: &Path,
    mesh: &BodyMesh,
    density: f64,
    reference: Option<&Reference>,
) -> Result<(), String> {
    let rest = mesh.vertices().iter().flat_map(|x| x.iter().copied());
    let elements: Vec<String> = mesh.corners().map(|nodes| format!("{nodes:?}")).collect();
    let state = reference.map_or(String::new(), |reference| {
        let Reference { time, q, qdot, kinetic, potential, check, evaluations } = reference;
        let snapshot = Snapshot { time: *time, q, qdot, energies: (*kinetic, *potential) };
        let (u, v) = check;
        let check = format!("\"self_check\": {u:e},\n\"self_check_velocities\": {v:e}");
        format!("{},\n{check},\n\"force_evaluations\": {evaluations},\n", fields(&snapshot))
    });
    let text = format!(
        "{{\n{state}\"length\": {:e},\n\"density\": {density:e},\n\"weights\": [{}],\n\"rest\": [{}],\n\"elements\": [{}]\n}}\n",
        norms::length(mesh),
        list(norms::weights(mesh).into_iter()),
        list(rest),
        elements.join(", ")
    );
    save_bytes(path, text.as_bytes()).map_err(|error| error.to_string())
}

fn fields(snapshot: &Snapshot) -> String {
    let Snapshot { time, q, qdot, energies: (kinetic, potential) } = snapshot;
    let (q, qdot) = (list(q.iter().copied()), list(qdot.iter().copied()));
    let (kinetic, potential) = (json(*kinetic), json(*potential));
    format!(
        "\"time\": {time:e},\n\"kinetic\": {kinetic},\n\"potential\": {potential},\n\"q\": [{q}],\n\"qdot\": [{qdot}]"
    )
}

/// JSON has no infinity and no NaN: they become null.
fn json(value: f64) -> String {
    if value.is_finite() { format!("{value:.16e}") } else { "null".to_owned() }
}

fn list(values: impl Iterator<Item = f64>) -> String {
    values.map(json).collect::<Vec<_>>().join(", ")
}
