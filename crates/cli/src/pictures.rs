//! Screenshot and recording of a run without a window.

use fem_model::simulation::Simulation;
use nalgebra::Vector3;

use crate::cli::RunArguments;
use crate::end::End;

#[cfg(feature = "viewer")]
pub use with_viewer::Pictures;

#[cfg(feature = "viewer")]
mod with_viewer {
    use std::path::PathBuf;

    use fem_viewer::{DisplayedSurface, OffscreenRenderer, Recorder};

    use super::*;

    const SIZE: (u32, u32) = (1280, 800);

    /// Renders the pictures that the options ask for. Without a graphics adapter it renders none.
    pub struct Pictures {
        renderer: Option<OffscreenRenderer>,
        screenshot: Option<PathBuf>,
        record: Option<PathBuf>,
        recorder: Option<Recorder>,
        /// Time of the first state, s.
        start: f64,
    }

    impl Pictures {
        /// Prints one line if pictures are asked for and cannot be rendered; `up` is their upward direction.
        pub fn new(arguments: &RunArguments, up: &Vector3<f64>) -> Self {
            let wanted = arguments.screenshot.is_some() || arguments.record.is_some();
            let mut renderer = wanted
                .then(|| OffscreenRenderer::new(SIZE.0, SIZE.1))
                .and_then(|renderer| renderer.inspect_err(|reason| eprintln!("no pictures: {reason}")).ok());
            if let Some(renderer) = &mut renderer {
                renderer.set_up(up);
                renderer.set_color(arguments.color);
            }
            let (screenshot, record) = (arguments.screenshot.clone(), arguments.record.clone());
            Self { renderer, screenshot, record, recorder: None, start: 0.0 }
        }

        /// Writes the next frame of the recording, if one is due.
        pub fn record(&mut self, simulation: &dyn Simulation) -> Result<(), End> {
            let (Some(renderer), Some(folder)) = (&mut self.renderer, &self.record) else { return Ok(()) };
            if self.recorder.is_none() {
                self.recorder = Some(Recorder::new(folder).map_err(End::unusable)?);
                self.start = simulation.time();
            }
            match &mut self.recorder {
                Some(recorder) if recorder.due(simulation.time() - self.start) => {
                    let picture = renderer.render(simulation, DisplayedSurface::Skinned).map_err(End::unusable)?;
                    recorder.frame(&picture).map_err(End::unusable)
                }
                _ => Ok(()),
            }
        }

        /// Writes the screenshot.
        pub fn screenshot(&mut self, simulation: &dyn Simulation) -> Result<(), End> {
            let (Some(renderer), Some(path)) = (&mut self.renderer, &self.screenshot) else { return Ok(()) };
            let picture = renderer.render(simulation, DisplayedSurface::Skinned).map_err(End::unusable)?;
            picture.save(path).map_err(End::unusable)
        }
    }
}

/// Without the viewer no pictures are rendered.
#[cfg(not(feature = "viewer"))]
pub struct Pictures;

#[cfg(not(feature = "viewer"))]
impl Pictures {
    /// Prints one line if pictures are asked for.
    pub fn new(arguments: &RunArguments, _: &Vector3<f64>) -> Self {
        if arguments.screenshot.is_some() || arguments.record.is_some() {
            eprintln!("no pictures: built without the feature `viewer`");
        }
        Self
    }

    pub fn record(&mut self, _: &dyn Simulation) -> Result<(), End> {
        Ok(())
    }

    pub fn screenshot(&mut self, _: &dyn Simulation) -> Result<(), End> {
        Ok(())
    }
}
