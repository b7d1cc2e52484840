//! Mutated pictures, and such as claim more pixels than they have.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use fem_mesh::generate::picture::{FromPicture, Picture, PictureError, mesh_picture, read_picture};
use flate2::Crc;
use image::{DynamicImage, GrayImage, ImageDecoder, ImageFormat, ImageReader, RgbImage, RgbaImage};
use tempfile::tempdir;

use super::mutation::{fuzz, write_over};

/// Largest number of bytes of pixels for a byte of a file: deflate packs 1032 bytes into one, and those of one bit become four bytes
/// for a pixel.
const UNPACKED: u64 = 1032 * 8 * 4;

/// Returns true if a pixel lies inside of a ring.
fn ring(x: u32, y: u32) -> bool {
    let squared = (x as i32 - 20).pow(2) + (y as i32 - 15).pow(2);
    (20..170).contains(&squared)
}

fn png(picture: &DynamicImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// Files of other kinds, from another program.
fn others(ending: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("pictures");
    let mut files: Vec<_> = folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|found| found == ending));
    files.sort();
    files.into_iter().map(|path| fs::read(path).unwrap()).collect()
}

fn pngs() -> Vec<Vec<u8>> {
    let shade = |x, y| if ring(x, y) { 20 } else { 230 };
    let grey = GrayImage::from_fn(40, 30, |x, y| [shade(x, y)].into());
    let colours = RgbImage::from_fn(40, 30, |x, y| [shade(x, y), 3, 200].into());
    let glass = RgbaImage::from_fn(40, 30, |x, y| [9, 8, 7, 255 * u8::from(ring(x, y))].into());
    let all: [DynamicImage; 3] = [grey.into(), colours.into(), glass.into()];
    let deep = [DynamicImage::from(all[2].to_rgba16()), DynamicImage::from(all[2].to_luma_alpha16())];
    all.iter().chain(&deep).map(png).chain(others("png")).collect()
}

/// Sets the check sums of all chunks, without which a decoder would look at no mutation of them.
fn with_check_sums(png: &[u8]) -> Vec<u8> {
    let mut bytes = png.to_vec();
    let mut at = 8;
    while let Some(head) = bytes.get(at..at + 8) {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let end = at + 8 + length;
        let Some(chunk) = bytes.get(at + 4..end) else { break };
        let mut sum = Crc::new();
        sum.update(chunk);
        let sum = sum.sum().to_be_bytes();
        let Some(place) = bytes.get_mut(end..end + 4) else { break };
        place.copy_from_slice(&sum);
        at = end + 4;
    }
    bytes
}

/// Bytes of the pixels that a file claims to have, as far as it can have them.
fn unpacked(bytes: &[u8]) -> usize {
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().unwrap();
    let claimed = reader.into_decoder().map_or(0, |decoder| decoder.total_bytes());
    bytes.len() + claimed.min(UNPACKED * bytes.len() as u64) as usize
}

fn go_on(found: Result<Picture, PictureError>) {
    match found {
        Ok(picture) => {
            assert_eq!(picture.coverage.len(), picture.width * picture.height);
            let edge = picture.width.max(picture.height) as f64 / 5.0;
            let options = FromPicture { edge, height: picture.height as f64, improve: 1 };
            if picture.coverage.len() <= 5000
                && let Ok(found) = mesh_picture(&picture, options)
            {
                assert!(found.mesh.vertices.iter().flatten().all(|x| x.is_finite()));
            }
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.len() < 1000 && message.lines().count() == 1, "{message}");
        }
    }
}

#[test]
fn mutated_pictures_are_read_or_refused() {
    let folder = tempdir().unwrap();
    let fuzz_pictures = |name: &str, files: &[Vec<u8>], mend: &dyn Fn(&[u8]) -> Vec<u8>| {
        let path = folder.path().join(name);
        let size = |bytes: &[u8]| unpacked(&mend(bytes));
        let prepare = |bytes: &[u8]| write_over(&path, &mend(bytes));
        fuzz(name, files, size, prepare, |()| read_picture(&path), go_on);
    };
    fuzz_pictures("m.png", &pngs(), &with_check_sums);
    fuzz_pictures("m.jpg", &others("jpg"), &<[u8]>::to_vec);
}

#[test]
fn a_picture_of_more_pixels_than_its_bytes_can_hold_is_refused_before_memory_is_taken() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m");
    let grey = GrayImage::from_fn(40, 30, |x, y| [if ring(x, y) { 20 } else { 230 }].into());
    let mut claims = png(&grey.into());
    claims[16..24].copy_from_slice(&[0, 0, 32, 0, 0, 0, 31, 0]);
    let jpg = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("pictures/grey.jpg")).unwrap();
    let mut claims_too = jpg.clone();
    // The frame header: its marker, length and depth, and then height and width.
    let frame = claims_too.windows(2).position(|pair| pair == [0xff, 0xc0]).unwrap();
    claims_too[frame + 5..frame + 9].copy_from_slice(&[31, 0, 32, 0]);
    for bytes in [with_check_sums(&claims), claims_too] {
        fs::write(&path, &bytes).unwrap();
        let mut message = String::new();
        let used = allocation_counter::measure(|| message = read_picture(&path).unwrap_err().to_string()).bytes_max;
        assert!(
            message.contains("claims to have 8192 × 7936 pixels") && message.contains("save it again"),
            "{message}"
        );
        assert!(used < 4 * bytes.len() as u64 + (192 << 10), "{used} bytes of memory for {}", bytes.len());
    }
    fs::write(&path, jpg).unwrap();
    assert!(read_picture(&path).is_ok());
}

#[test]
fn a_blank_page_that_deflate_packs_best_is_no_forgery() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("m.png");
    let mut page = GrayImage::from_pixel(3000, 3000, [255].into());
    page.put_pixel(1500, 1500, [0].into());
    fs::write(&path, png(&page.into())).unwrap();
    assert_eq!(read_picture(&path).unwrap().width, 3000);
}
