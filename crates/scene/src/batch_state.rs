//! The state file of a batch.

use std::io::{self, Write};
use std::path::Path;

use crate::state::write_list;
use fem_mesh::MeshError;
use fem_mesh::write::save;
use fem_model::EnvironmentValues;

/// The end of one environment.
pub struct EnvironmentEnd {
    /// The quantities that vary.
    pub values: EnvironmentValues,
    /// `q` and `qdot` of all nodes, m and m/s, or why there are none.
    pub state: Result<[Vec<f64>; 2], String>,
}

/// Writes `{"time", "environments"}`, where each environment has its varied quantities, and `q` and `qdot` with 17 significant digits; one
/// that has failed has `failure` in place of these. `end` is called for each environment in order.
pub fn write_batch(
    path: &Path,
    time: f64,
    environments: usize,
    mut end: impl FnMut(usize) -> EnvironmentEnd,
) -> Result<(), MeshError> {
    save(path, &mut |out| {
        write!(out, "{{\n\"time\": {time:.16e},\n\"environments\": [")?;
        for number in 0..environments {
            write!(out, "{}\n{{", if number == 0 { "" } else { "," })?;
            write_end(out, &end(number))?;
            write!(out, "}}")?;
        }
        out.write_all(b"\n]\n}\n")
    })
}

fn write_end(out: &mut dyn Write, EnvironmentEnd { values, state }: &EnvironmentEnd) -> io::Result<()> {
    for (key, value) in values.varied() {
        write!(out, "\"{key}\": {value:.16e}, ")?;
    }
    match state {
        Ok([q, qdot]) => {
            write!(out, "\"q\": [")?;
            write_list(out, q)?;
            write!(out, "], \"qdot\": [")?;
            write_list(out, qdot)?;
            write!(out, "]")
        }
        Err(failure) => {
            write!(out, "\"failure\": ")?;
            serde_json::to_writer(out, failure).map_err(io::Error::other)
        }
    }
}
