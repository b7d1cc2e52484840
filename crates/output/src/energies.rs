//! The energies of a run, step by step.

use std::fmt::Write;
use std::path::Path;

use fem_mesh::MeshError;
use fem_mesh::write::save_bytes;

use fem_model::simulation::{Energies, EnergyLedger, Simulation};

/// Energies at a time, J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyRow {
    /// s
    pub time: f64,
    /// Kinetic and potential energy.
    pub energies: Energies,
    /// The ledger since the start; `None` where the simulation has none.
    pub ledger: Option<EnergyLedger>,
}

impl EnergyRow {
    /// The energies now.
    pub fn of(simulation: &dyn Simulation) -> Self {
        Self { time: simulation.time(), energies: simulation.energies(), ledger: simulation.energy_ledger() }
    }
}

/// Writes `time,kinetic,potential,total` (s and J), and with a ledger what is stored, has been supplied and dissipated; a line for the
/// first state and for each step.
pub fn write_energies(path: &Path, rows: &[EnergyRow]) -> Result<(), MeshError> {
    let mut text = "time,kinetic,potential,total".to_owned();
    if rows.iter().any(|row| row.ledger.is_some()) {
        text += ",stored,loads,motions,obstacles,plastic,rayleigh,dampers,friction,numerical";
    }
    for EnergyRow { time, energies, ledger } in rows {
        let Energies { kinetic, potential } = energies;
        // Writing to a string cannot fail.
        let _ = write!(text, "\n{time:.9e},{kinetic:.16e},{potential:.16e},{:.16e}", energies.total());
        let Some(ledger) = ledger else { continue };
        let EnergyLedger { stored, loads, motions, obstacles, plastic, rayleigh, dampers, friction, .. } = *ledger;
        for energy in [stored, loads, motions, obstacles, plastic, rayleigh, dampers, friction, ledger.numerical()] {
            let _ = write!(text, ",{energy:.9e}");
        }
    }
    text.push('\n');
    save_bytes(path, text.as_bytes())
}
