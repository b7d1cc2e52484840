//! Pictures of a run without a window.

use fem_scene::simulation::Simulation;
use nalgebra::Vector3;

use super::cli::RunArguments;
use super::end::End;

#[cfg(feature = "viewer")]
pub use with_viewer::Camera;

#[cfg(feature = "viewer")]
mod with_viewer {
    use std::path::PathBuf;

    use fem_viewer::{Photographer, Recorder, Shown};

    use super::*;

    const SIZE: (u32, u32) = (1280, 800);

    /// Takes the pictures that the options ask for; does nothing where none are, or where nothing can draw them.
    pub struct Camera {
        photographer: Option<Photographer>,
        screenshot: Option<PathBuf>,
        record: Option<PathBuf>,
        recorder: Option<Recorder>,
    }

    impl Camera {
        /// Says in one line why there will be no pictures, if there can be none.
        ///
        /// `up` is the direction that is up in them.
        pub fn for_run(arguments: &RunArguments, up: &Vector3<f64>) -> Self {
            let wanted = arguments.screenshot.is_some() || arguments.record.is_some();
            let mut photographer = wanted
                .then(|| Photographer::new(SIZE.0, SIZE.1))
                .and_then(|photographer| photographer.inspect_err(|reason| eprintln!("no pictures: {reason}")).ok());
            if let Some(photographer) = &mut photographer {
                photographer.set_up(up);
            }
            let (screenshot, record) = (arguments.screenshot.clone(), arguments.record.clone());
            Self { photographer, screenshot, record, recorder: None }
        }

        /// The next frame of the recording, where one is due.
        pub fn record(&mut self, simulation: &dyn Simulation) -> Result<(), End> {
            let (Some(photographer), Some(folder)) = (&mut self.photographer, &self.record) else { return Ok(()) };
            if self.recorder.is_none() {
                self.recorder = Some(Recorder::new(folder).map_err(End::unusable)?);
            }
            match &mut self.recorder {
                Some(recorder) if recorder.due(simulation.time()) => {
                    let photograph = photographer.shoot(simulation, Shown::Skinned).map_err(End::unusable)?;
                    recorder.frame(&photograph).map_err(End::unusable)
                }
                _ => Ok(()),
            }
        }

        /// The picture at the end.
        pub fn shoot(&mut self, simulation: &dyn Simulation) -> Result<(), End> {
            let (Some(photographer), Some(path)) = (&mut self.photographer, &self.screenshot) else { return Ok(()) };
            let photograph = photographer.shoot(simulation, Shown::Skinned).map_err(End::unusable)?;
            photograph.save(path).map_err(End::unusable)
        }
    }
}

/// Without the viewer there is nothing to draw with.
#[cfg(not(feature = "viewer"))]
pub struct Camera;

#[cfg(not(feature = "viewer"))]
impl Camera {
    /// Says in one line that there will be no pictures, if any are wanted.
    pub fn for_run(arguments: &RunArguments, _: &Vector3<f64>) -> Self {
        if arguments.screenshot.is_some() || arguments.record.is_some() {
            eprintln!("no pictures: built without the feature `viewer`");
        }
        Self
    }

    pub fn record(&mut self, _: &dyn Simulation) -> Result<(), End> {
        Ok(())
    }

    pub fn shoot(&mut self, _: &dyn Simulation) -> Result<(), End> {
        Ok(())
    }
}
