//! The loop that steps a simulation, and the files of its run: energies, statistics, the final mesh with its fields, a series of meshes.
//!
//! All of it is about a [`Simulation`], whatever has built that: a scene file or a program.

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use
#![allow(clippy::needless_range_loop)] // indices of tensors are the notation of the field
#![allow(clippy::neg_cmp_op_on_partial_ord)] // written so that NaN fails

mod element_field;
mod energies;
mod fields;
mod probe;
mod recovery;
mod run;
mod series;
mod stress_error;

pub use element_field::ElementField;
pub use energies::{EnergyRow, write_energies};
pub use fields::{stresses_at_nodes, von_mises};
pub use probe::Probe;
pub use run::{Run, quantile, run};
pub use series::Series;
pub use stress_error::StressError;

use fields::export_fields;

use std::path::Path;

use serde::Serialize;

use fem_mesh::write::{Frame, save_bytes, write_glb, write_surface};
use fem_mesh::{MeshError, Problem, SurfaceMesh};
use fem_model::simulation::{EnergyLedger, Part, PlaneContact, PlasticFlow, Simulation};

/// File extensions that [`export`] supports.
pub const EXPORTS: [&str; 3] = ["obj", "vtu", "glb"];

/// The numbers of a run, in the order of the statistics file.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)] // the names are the keys of the file; docs/book/commands.md explains them
pub struct Stats {
    pub scene: String,
    /// `done`, `interrupted`, or `failed` with the reason.
    pub status: String,
    pub nodes: usize,
    pub elements: usize,
    pub steps: usize,
    pub seconds_setup: f64,
    pub seconds_per_step_median: Option<f64>,
    pub seconds_per_step_p95: Option<f64>,
    pub newton_iterations: usize,
    /// Steps in which Newton's method did not reach its tolerance.
    pub unconverged_steps: usize,
    pub factorizations: usize,
    pub symbolic_factorizations: usize,
    /// Sum over all iterative solutions.
    pub solver_iterations: usize,
    pub stiffness_assemblies: usize,
    pub energy_evaluations: usize,
    pub line_search_backtracks: usize,
    pub projections: usize,
    pub accepted_steps: usize,
    pub rejected_steps: usize,
    pub skinning_rows: usize,
    /// Peak memory of the process; `None` if the operating system does not report it.
    pub peak_memory_bytes: Option<usize>,
    #[serde(rename = "min_J")]
    pub min_J: f64,
    /// Largest plastic strain of an element; without a key for a body without plasticity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_plastic_strain: Option<f64>,
    /// Energy that plastic flow has dissipated, J; without a key for a body without plasticity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dissipated_energy: Option<f64>,
    /// Estimated error of the stresses, as a part of their energy norm; no key where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stress_error: Option<f64>,
    /// Reaction force of each Dirichlet condition, N; empty without conditions or if the pipeline does not compute reactions.
    pub reactions: serde_json::Map<String, serde_json::Value>,
    /// Force (N) and smallest gap (m) of each obstacle; no key without obstacles.
    #[serde(skip_serializing_if = "serde_json::Map::is_empty")]
    pub contacts: serde_json::Map<String, serde_json::Value>,
    /// Largest relative change that the normal forces of friction were left with in a step; no key without such forces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lag_residual: Option<f64>,
    /// The energy ledger at the end, J; no key in statics, and for a pipeline that does not compute it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy: Option<EnergyLedger>,
    pub parts: serde_json::Map<String, serde_json::Value>,
}

impl Stats {
    /// Collects the numbers after a run.
    pub fn of(simulation: &dyn Simulation, run: &Run, seconds_setup: f64) -> Self {
        let (shape, counters) = (simulation.shape(), simulation.counters());
        let flow = simulation.plastic_flow();
        let built = simulation.parts().into_iter().filter(|part| part.built);
        let reactions =
            simulation.reactions().into_iter().map(|reaction| (reaction.name, reaction.force.to_vec().into()));
        let contact = |contact: PlaneContact| {
            let value = serde_json::json!({ "force": contact.force, "smallest_gap": contact.smallest_gap });
            (contact.name, value)
        };
        let cost = |part: &Part| serde_json::json!({ "bytes": part.bytes, "uses": part.uses, "seconds": part.seconds });
        Self {
            scene: simulation.name().to_owned(),
            status: match &run.failure {
                Some(failure) => format!("failed: {failure}"),
                None if run.interrupted => "interrupted".to_owned(),
                None => "done".to_owned(),
            },
            nodes: shape.mesh.vertices().len(),
            elements: shape.mesh.elements(),
            steps: counters.steps,
            seconds_setup,
            seconds_per_step_median: quantile(&run.step_seconds, 0.5),
            seconds_per_step_p95: quantile(&run.step_seconds, 0.95),
            newton_iterations: counters.newton_iterations,
            unconverged_steps: counters.unconverged_steps,
            factorizations: counters.factorizations,
            symbolic_factorizations: counters.symbolic_factorizations,
            solver_iterations: counters.solver_iterations,
            stiffness_assemblies: counters.stiffness_assemblies,
            energy_evaluations: counters.energy_evaluations,
            line_search_backtracks: counters.line_search_backtracks,
            projections: counters.projections,
            accepted_steps: counters.accepted_steps,
            rejected_steps: counters.rejected_steps,
            skinning_rows: counters.skinning_rows,
            peak_memory_bytes: peak_memory_bytes(),
            min_J: simulation.min_J().0,
            largest_plastic_strain: flow.as_ref().map(PlasticFlow::largest_strain),
            dissipated_energy: flow.map(|flow| flow.dissipated),
            stress_error: StressError::of(simulation).map(|error| error.relative),
            reactions: reactions.collect(),
            contacts: simulation.contacts().into_iter().map(contact).collect(),
            lag_residual: simulation.lag_residual(),
            energy: simulation.energy_ledger(),
            parts: built.map(|part| (part.name.to_owned(), cost(&part))).collect(),
        }
    }

    /// Writes the numbers as JSON.
    pub fn write(&self, path: &Path) -> Result<(), MeshError> {
        let text = serde_json::to_string_pretty(self).expect("numbers and strings have a JSON form");
        save_bytes(path, (text + "\n").as_bytes())
    }
}

/// Peak memory of the process, which Linux reports.
fn peak_memory_bytes() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(1024 * line.trim().strip_suffix("kB")?.trim().parse::<usize>().ok()?)
}

/// Writes the final mesh by extension: `.obj` the display surface, `.vtu` the simulation mesh with its fields, `.glb` the display surface with the motion in `frames`.
pub fn export(path: &Path, simulation: &dyn Simulation, frames: &[Frame]) -> Result<(), MeshError> {
    let shape = simulation.shape();
    let faces = shape.display.as_ref().map_or(&shape.boundary, |display| &display.elements);
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("obj") => write_surface(path, &SurfaceMesh::new(simulation.display_positions(), faces.clone())),
        Some("glb") => {
            let rest = shape.display.as_ref().map_or(shape.mesh.vertices(), |display| &display.vertices[..]);
            write_glb(path, rest, faces, frames)
        }
        Some("vtu") => export_fields(path, simulation),
        other => Err(unknown_export(path, other.unwrap_or_default())),
    }
}

/// The error of an extension that [`export`] does not support.
pub fn unknown_export(path: &Path, extension: &str) -> MeshError {
    MeshError::in_file(path, Problem::UnknownExtension { found: extension.to_owned(), known: ".obj, .vtu, .glb" })
}
