//! Pictures from PNG and JPEG files.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use image::codecs::jpeg::JpegDecoder;
use image::codecs::png::PngDecoder;
use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, Limits};
use thiserror::Error;

use super::Picture;

/// Largest number of pixels.
const MOST_PIXELS: u64 = 1 << 26;
/// Largest number of pixels per byte of a file: deflate packs 1032 bytes into one, each of eight pixels.
const PNG_PIXELS: u64 = 8 * 1032;
/// The same for JPEG, where each block of 8 × 8 pixels has a bit at least.
const JPEG_PIXELS: u64 = 8 * 64;
/// Bytes that a colour profile and a row of a PNG file may take beside four times the file.
const BESIDE: u64 = 1 << 20;

/// Reason why a file is no picture of a region.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{}: {problem}", file.display())]
pub struct PictureError {
    /// The file.
    pub file: PathBuf,
    /// The problem, and the remedy.
    pub problem: String,
}

/// Reads a PNG or JPEG file, recognised by its content. If a pixel is transparent, the region is the opaque part; otherwise the dark
/// part: the threshold of Otsu, A Threshold Selection Method from Gray-Level Histograms (1979), parts the pixels, and the coverage is
/// linear in the luminance from the median of the light ones to that of the dark ones.
///
/// # Errors
/// A file that cannot be read or is no such picture, one of more than 2²⁶ pixels or of more than its bytes can stand for, and a picture of one
/// colour.
pub fn read_picture(file: &Path) -> Result<Picture, PictureError> {
    let picture = read(file)?;
    if let Some(alpha) = transparency(&picture) {
        return Ok(with_coverage(&picture, alpha));
    }
    let luminance = picture.to_luma8().into_raw();
    let coverage = darkness(&luminance).ok_or_else(|| PictureError {
        file: file.to_owned(),
        problem: "all pixels have one colour, so there is no region; give it a transparent or a light background"
            .to_owned(),
    })?;
    Ok(with_coverage(&picture, coverage))
}

/// The colours of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    /// Number of columns.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Red, green, blue and opacity of each pixel, sRGB, row by row from the upper left.
    pub rgba: Vec<u8>,
}

/// Reads the colours of a PNG or JPEG file.
///
/// # Errors
/// A file that cannot be read or is no such picture, one of more than 2²⁶ pixels or of more than its bytes can stand for.
pub fn read_pixels(file: &Path) -> Result<Pixels, PictureError> {
    let picture = read(file)?;
    Ok(Pixels { width: picture.width(), height: picture.height(), rgba: picture.to_rgba8().into_raw() })
}

fn read(file: &Path) -> Result<DynamicImage, PictureError> {
    let problem = |problem: String| PictureError { file: file.to_owned(), problem };
    let opened = File::open(file).map_err(|error| {
        problem(match error.kind() {
            std::io::ErrorKind::NotFound => "there is no such file; check the path".to_owned(),
            _ => format!("cannot be read ({error}); check that it is a file and that you may read it"),
        })
    })?;
    let length = opened.metadata().map_or(0, |data| data.len());
    decode(BufReader::new(opened), length).map_err(problem)
}

fn with_coverage(picture: &DynamicImage, coverage: Vec<u8>) -> Picture {
    Picture { width: picture.width() as usize, height: picture.height() as usize, coverage }
}

/// Decodes a file of this length. Memory for pixels is taken only if the file can have so many. The decoders are named, so that those of
/// `image` for other formats are not compiled.
fn decode(mut reader: BufReader<File>, length: u64) -> Result<DynamicImage, String> {
    let unreadable =
        |error: std::io::Error| format!("cannot be read ({error}); check that it is a file and that you may read it");
    let format = image::guess_format(reader.fill_buf().map_err(unreadable)?);
    let mut limits = Limits::default();
    limits.max_alloc = Some(length.saturating_mul(4).saturating_add(BESIDE));
    let (mut decoder, most_of_a_byte): (Box<dyn ImageDecoder>, u64) = match format {
        Ok(ImageFormat::Png) => {
            (Box::new(PngDecoder::with_limits(reader, limits.clone()).map_err(damaged)?), PNG_PIXELS)
        }
        Ok(ImageFormat::Jpeg) => (Box::new(JpegDecoder::new(reader).map_err(damaged)?), JPEG_PIXELS),
        _ => return Err("is neither a PNG nor a JPEG file; convert it to one of them".to_owned()),
    };
    decoder.set_limits(limits).map_err(damaged)?;
    let (width, height) = decoder.dimensions();
    let pixels = u64::from(width) * u64::from(height);
    if pixels > MOST_PIXELS {
        return Err(format!(
            "has {width} × {height} = {pixels} pixels, and {MOST_PIXELS} is the most; make it smaller"
        ));
    }
    if pixels > length.saturating_mul(most_of_a_byte) {
        return Err(format!(
            "claims to have {width} × {height} pixels, more than its {length} bytes can hold; it is damaged or cut off: save it again"
        ));
    }
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let mut picture = DynamicImage::from_decoder(decoder).map_err(damaged)?;
    picture.apply_orientation(orientation);
    Ok(picture)
}

fn damaged(error: ImageError) -> String {
    // Some of the decoder's messages have several lines.
    let reason = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    format!("is damaged or of a kind that is not supported ({reason}); save it again as PNG")
}

/// Opacity of the pixels; `None` if all are opaque.
fn transparency(picture: &DynamicImage) -> Option<Vec<u8>> {
    let narrow = |alpha: u16| ((u32::from(alpha) + 128) / 257) as u8;
    match picture {
        DynamicImage::ImageRgba8(all) => unless_opaque(all.pixels().map(|pixel| pixel.0[3])),
        DynamicImage::ImageLumaA8(all) => unless_opaque(all.pixels().map(|pixel| pixel.0[1])),
        DynamicImage::ImageRgba16(all) => unless_opaque(all.pixels().map(|pixel| narrow(pixel.0[3]))),
        DynamicImage::ImageLumaA16(all) => unless_opaque(all.pixels().map(|pixel| narrow(pixel.0[1]))),
        _ => None,
    }
}

fn unless_opaque(alpha: impl Iterator<Item = u8> + Clone) -> Option<Vec<u8>> {
    alpha.clone().any(|alpha| alpha < u8::MAX).then(|| alpha.collect())
}

/// Coverage by the dark region; `None` if all pixels have one luminance.
fn darkness(luminance: &[u8]) -> Option<Vec<u8>> {
    let mut histogram = [0_u64; 256];
    luminance.iter().for_each(|&value| histogram[usize::from(value)] += 1);
    let threshold = otsu(&histogram)?;
    let dark = median(&histogram[..=threshold], 0);
    let light = median(&histogram[threshold + 1..], threshold + 1);
    let coverage = |value: usize| {
        let share = (light - value as f64) / (light - dark);
        (255.0 * share.clamp(0.0, 1.0)).round() as u8
    };
    let table: Vec<u8> = (0..256).map(coverage).collect();
    Some(luminance.iter().map(|&value| table[usize::from(value)]).collect())
}

/// The value up to which pixels are dark, so that the variance between the two classes is largest.
fn otsu(histogram: &[u64; 256]) -> Option<usize> {
    let count: f64 = histogram.iter().sum::<u64>() as f64;
    let sum: f64 = histogram.iter().enumerate().map(|(value, n)| value as f64 * *n as f64).sum();
    let (mut below, mut sum_below) = (0.0, 0.0);
    let mut best: Option<(f64, usize)> = None;
    for (value, &n) in histogram.iter().enumerate() {
        below += n as f64;
        sum_below += value as f64 * n as f64;
        let above = count - below;
        if below > 0.0 && above > 0.0 {
            let difference = sum_below / below - (sum - sum_below) / above;
            let variance = below * above * difference * difference;
            if best.is_none_or(|(most, _)| variance > most) {
                best = Some((variance, value));
            }
        }
    }
    best.map(|(_, value)| value)
}

/// The median of the values of a histogram that begins at `first`.
fn median(histogram: &[u64], first: usize) -> f64 {
    let half = histogram.iter().sum::<u64>().div_ceil(2);
    let mut below = 0;
    let place = histogram.iter().position(|&n| {
        below += n;
        below >= half
    });
    (first + place.unwrap_or(0)) as f64
}
