//! Pictures and recordings as PNG files.

use std::fs;
use std::path::{Path, PathBuf};

use fem_mesh::Problem;
use image::codecs::png::PngEncoder;
use image::{ImageError, RgbImage};
use thiserror::Error;

/// Recorded frames per second of simulated time.
pub const FRAMES_PER_SECOND: f64 = 30.0;

/// A rendered picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    image: RgbImage,
}

impl Picture {
    pub(crate) fn new(image: RgbImage) -> Self {
        Picture { image }
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.image.width()
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.image.height()
    }

    /// Red, green and blue of every pixel, row by row from the upper left.
    pub fn bytes(&self) -> &[u8] {
        self.image.as_raw()
    }

    /// Writes a PNG file, whatever the extension of the path. No file is left if writing fails.
    pub fn save(&self, path: &Path) -> Result<(), NotWritten> {
        let not_written = |cause: String| NotWritten { path: path.to_owned(), cause };
        let mut png = Vec::new();
        // Named, so that the writers of ten other formats are not compiled.
        self.image.write_with_encoder(PngEncoder::new(&mut png)).map_err(|error| not_written(cause(error)))?;
        fem_mesh::write::save_bytes(path, &png).map_err(|error| match *error.problem {
            Problem::Unwritable { reason } => not_written(reason),
            other => not_written(other.to_string()),
        })
    }
}

fn cause(error: ImageError) -> String {
    match error {
        ImageError::IoError(io) => io.to_string(),
        other => other.to_string(),
    }
}

/// A picture could not be written.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("cannot write the picture {}: {cause}", path.display())]
pub struct NotWritten {
    /// The file or folder.
    pub path: PathBuf,
    /// The operating system's message.
    pub cause: String,
}

/// Checks before a run that a picture can be written after it: its folder exists and is writable.
pub fn check_writable(path: &Path) -> Result<(), NotWritten> {
    let refuse = |cause: String| Err(NotWritten { path: path.to_owned(), cause });
    if path.is_dir() {
        return refuse("it is a folder".into());
    }
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match fs::metadata(folder) {
        Err(error) => refuse(format!("its folder cannot be used: {error}")),
        Ok(data) if !data.is_dir() => refuse(format!("{} is not a folder", folder.display())),
        Ok(data) if data.permissions().readonly() => refuse("its folder is write-protected".into()),
        Ok(_) => Ok(()),
    }
}

/// Writes numbered frames, `frame_00001.png` and so on, into a folder.
#[derive(Clone, Debug)]
pub struct Recorder {
    folder: PathBuf,
    frames: usize,
}

impl Recorder {
    /// Records into `folder`, which is created if it is missing. Existing frames are overwritten.
    pub fn new(folder: &Path) -> Result<Self, NotWritten> {
        let refuse = |error: std::io::Error| NotWritten { path: folder.to_owned(), cause: error.to_string() };
        fs::create_dir_all(folder).map_err(refuse)?;
        Ok(Recorder { folder: folder.to_owned(), frames: 0 })
    }

    /// Returns true if the next frame is due at `time`, in seconds since the start; there are [`FRAMES_PER_SECOND`].
    pub fn due(&self, time: f64) -> bool {
        time * FRAMES_PER_SECOND >= self.frames as f64 - 1e-6
    }

    /// Writes the next frame.
    pub fn frame(&mut self, picture: &Picture) -> Result<(), NotWritten> {
        self.frames += 1;
        picture.save(&self.folder.join(format!("frame_{:05}.png", self.frames)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Picture {
        Picture::new(RgbImage::from_pixel(4, 3, image::Rgb([1, 2, 3])))
    }

    fn empty_folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("fem-viewer-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        folder
    }

    #[test]
    fn a_photograph_is_written_as_it_is() {
        let folder = empty_folder("save");
        fs::create_dir_all(&folder).unwrap();
        picture().save(&folder.join("a.png")).unwrap();
        assert_eq!(image::open(folder.join("a.png")).unwrap().to_rgb8().as_raw(), picture().bytes());
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn an_unwritable_path_is_named_in_the_error() {
        let path = empty_folder("missing").join("a.png");
        let late = picture().save(&path).unwrap_err().to_string();
        let early = check_writable(&path).unwrap_err().to_string();
        assert!(late.contains("a.png") && early.contains("a.png"), "{late} / {early}");
        assert!(check_writable(&std::env::temp_dir()).is_err());
        assert!(check_writable(Path::new("a.png")).is_ok());
    }

    #[test]
    fn frames_are_numbered_from_one_and_due_thirty_times_a_second() {
        let folder = empty_folder("frames");
        let mut recorder = Recorder::new(&folder).unwrap();
        for step in 0..=20 {
            if recorder.due(f64::from(step) * 0.01) {
                recorder.frame(&picture()).unwrap();
            }
        }
        let frames = fs::read_dir(&folder).unwrap().count();
        assert_eq!(frames, 7, "0, 0.04, 0.07, 0.10, 0.14, 0.17 and 0.20 s");
        assert!(folder.join("frame_00001.png").exists() && folder.join("frame_00007.png").exists());
        fs::remove_dir_all(folder).unwrap();
    }
}
