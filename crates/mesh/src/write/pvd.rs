//! ParaView's list of files and their times. Source: ParaView documentation, «ParaView data (PVD) file format».

use std::path::Path;

use super::{escape, save};
use crate::MeshError;

/// Writes the times (s) and names of files in the same folder, such as those of [`write_vtu`](super::write_vtu).
pub fn write_pvd(path: &Path, files: &[(f64, String)]) -> Result<(), MeshError> {
    save(path, &mut |out| {
        writeln!(out, r#"<?xml version="1.0"?>"#)?;
        writeln!(out, "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>")?;
        for (time, file) in files {
            writeln!(out, r#"<DataSet timestep="{time:?}" part="0" file="{}"/>"#, escape(file))?;
        }
        writeln!(out, "</Collection>\n</VTKFile>")
    })
}
