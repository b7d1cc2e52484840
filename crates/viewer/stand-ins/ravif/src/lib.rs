//! Stands for [ravif](https://docs.rs/ravif), a writer of AVIF files with a whole video encoder, rav1e. `image` calls it in its
//! `codecs/avif/encoder.rs` if a picture is saved as `.avif`; nothing here does. Encoding returns an error.

use std::fmt;

pub use rgb::{RGB8, RGBA8};

/// AVIF is not written here.
#[derive(Debug)]
pub struct Error;

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("this program is built without a writer of AVIF files")
    }
}

impl std::error::Error for Error {}

/// Pixels with their width and height.
pub struct Img<P>(P);

impl<P> Img<P> {
    pub fn new(pixels: P, _width: usize, _height: usize) -> Self {
        Img(pixels)
    }

    pub fn buf(&self) -> &P {
        &self.0
    }
}

pub enum BitDepth {
    Eight,
}

pub enum ColorModel {
    YCbCr,
    RGB,
}

pub struct EncodedImage {
    pub avif_file: Vec<u8>,
}

/// The encoder. Its settings have no effect.
#[derive(Default)]
pub struct Encoder<'a>(std::marker::PhantomData<&'a ()>);

/// Settings of one value.
macro_rules! settings {
    ($($name:ident: $value:ty,)*) => {
        $(pub fn $name(self, _: $value) -> Self {
            self
        })*
    };
}

impl<'a> Encoder<'a> {
    pub fn new() -> Self {
        Self::default()
    }

    settings! {
        with_quality: f32,
        with_alpha_quality: f32,
        with_speed: u8,
        with_bit_depth: BitDepth,
        with_internal_color_model: ColorModel,
        with_num_threads: Option<usize>,
        with_exif: Vec<u8>,
    }

    pub fn encode_rgb(&self, _picture: Img<&[RGB8]>) -> Result<EncodedImage, Error> {
        Err(Error)
    }

    pub fn encode_rgba(&self, _picture: Img<&[RGBA8]>) -> Result<EncodedImage, Error> {
        Err(Error)
    }
}
