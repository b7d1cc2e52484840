//! Files that are broken in many ways, the same in every run, and the limits that a reader keeps to on each of them.

use std::fs::File;
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Longest run of bytes that one mutation touches.
const LONGEST: usize = 256;

/// A reader's memory is at most this multiple of the file, and [`SMALL`] more.
const MULTIPLE: u64 = 4;

/// Memory that a reader may take for any file, bytes: tables, messages, and the decoder of a compressed file.
const SMALL: u64 = 192 << 10;

/// All bytes that a reader allocates, freed ones too, are at most this multiple of the file, and [`WORK`] more: a bound on its work.
const TURNOVER: u64 = 400;

/// Bytes that a reader may allocate for any file: each packed array has a decoder of its own.
const WORK: u64 = 4 << 20;

/// A reader that takes longer than this is taken to hang.
const HANGS: Duration = Duration::from_secs(120);

const TEXTS: [&str; 14] = [
    "99999999999999999999",
    "1000000000000000000",
    "-1",
    "-9223372036854775808",
    "9223372036854775807",
    "18446744073709551615",
    "4294967296",
    "2147483647",
    "1e308",
    "-1e-320",
    "nan",
    "inf",
    "0",
    "",
];

const NUMBERS: [u64; 8] =
    [0, 1, u64::MAX, i64::MAX as u64, 1 << 63, 0x8000_0000_8000_0000, 0x7fff_ffff_7fff_ffff, 0x7ff8_0000_0000_0000];

/// The same numbers in every run: SplitMix64 by Steele, Lea and Flood (2014).
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    /// A run of a file: its start and its end.
    fn run(&mut self, length: usize) -> (usize, usize) {
        let start = self.below(length + 1);
        let most = if self.below(8) == 0 { LONGEST } else { 8 };
        (start, length.min(start + 1 + self.below(most)))
    }
}

/// Breaks a file in place and returns the number of bytes that changed, came or went. `others` are files whose parts may be put in.
fn mutate(random: &mut Random, bytes: &mut Vec<u8>, others: &[Vec<u8>]) -> usize {
    let (start, end) = random.run(bytes.len());
    let run = bytes[start..end].to_vec();
    match random.below(9) {
        0 => {
            bytes[start..end].iter_mut().take(8).for_each(|byte| *byte ^= 1 << random.below(8));
            run.len().min(8)
        }
        1 => {
            bytes[start..end].iter_mut().for_each(|byte| *byte = random.next() as u8);
            run.len()
        }
        2 => bytes.drain(start..end).len(),
        3 => {
            let at = random.below(bytes.len() + 1);
            bytes.splice(at..at, run.iter().copied());
            run.len()
        }
        4 => {
            let other = &others[random.below(others.len())];
            let (from, to) = random.run(other.len());
            bytes.splice(start..start, other[from..to].iter().copied());
            to - from
        }
        5 => number_in_text(random, bytes, start),
        6 => number_in_binary(random, &mut bytes[start..]),
        7 => line(random, bytes, start),
        _ if random.below(8) == 0 => {
            bytes.truncate(start);
            LONGEST
        }
        _ => number_in_text(random, bytes, start),
    }
}

/// Replaces the digits that follow by an extreme number.
fn number_in_text(random: &mut Random, bytes: &mut Vec<u8>, from: usize) -> usize {
    let is_digit = |byte: &u8| byte.is_ascii_digit();
    let Some(start) = bytes[from..].iter().position(is_digit).map(|i| from + i) else { return 1 };
    let end = bytes[start..].iter().position(|byte| !is_digit(byte)).map_or(bytes.len(), |i| start + i);
    let text = TEXTS[random.below(TEXTS.len())];
    bytes.splice(start..end, text.bytes());
    text.len().max(end - start)
}

/// Replaces four or eight bytes by an extreme number in either order.
fn number_in_binary(random: &mut Random, bytes: &mut [u8]) -> usize {
    let number = NUMBERS[random.below(NUMBERS.len())];
    let number = if random.below(2) == 0 { number.to_le_bytes() } else { number.to_be_bytes() };
    let count = bytes.len().min(4 + 4 * random.below(2));
    bytes[..count].copy_from_slice(&number[8 - count..]);
    count
}

/// Repeats or removes a line.
fn line(random: &mut Random, bytes: &mut Vec<u8>, from: usize) -> usize {
    let Some(start) = bytes[from..].iter().position(|&byte| byte == b'\n').map(|i| from + i + 1) else { return 1 };
    let end = bytes[start..].iter().position(|&byte| byte == b'\n').map_or(bytes.len(), |i| start + i + 1);
    if random.below(2) == 0 {
        return bytes.drain(start..end).len();
    }
    let line = bytes[start..end].to_vec();
    bytes.splice(start..start, line.iter().copied());
    line.len()
}

/// Mutated bytes for each reader: a million in the long tests, which `.ci/long` runs, and in the usual ones its first tenth.
pub fn bytes_to_mutate() -> usize {
    let is_long = std::env::var("FEM_TEST_EFFORT").is_ok_and(|effort| effort == "long");
    if is_long { 1_000_000 } else { 100_000 }
}

/// Writes a file's content over the one before. A file system may wait for its disk when a file is emptied and written again, and takes long
/// to remove and to create one.
pub fn write_over(path: &Path, bytes: &[u8]) {
    let mut file = File::options().write(true).create(true).truncate(false).open(path).unwrap();
    file.write_all(bytes).unwrap();
    file.set_len(bytes.len() as u64).unwrap();
}

/// Calls `read` with mutations of the files until enough bytes have been mutated, and asserts that it does not panic, hang, or take
/// memory beyond the file's. `size` tells the bytes that a file stands for, more than its own if it is compressed.
///
/// `prepare` makes the mutated file ready, such as on a disk, and `go_on` uses what was read; neither takes part in the measurement.
pub fn fuzz<P, R>(
    name: &str,
    files: &[Vec<u8>],
    size: impl Fn(&[u8]) -> usize,
    prepare: impl Fn(&[u8]) -> P,
    read: impl Fn(&P) -> R,
    go_on: impl Fn(R),
) {
    let (goal, seed) =
        (bytes_to_mutate(), name.bytes().fold(0, |seed: u64, byte| seed.wrapping_mul(257) + u64::from(byte)));
    let watch = Watch::start(name);
    let (mut mutated, mut case, mut largest) = (0, 0, 0.0_f64);
    while mutated < goal {
        let mut random = Random(seed.wrapping_add(case));
        watch.case.store(case, Ordering::Relaxed);
        let mut bytes = files[random.below(files.len())].clone();
        for _ in 0..=random.below(4) {
            mutated += mutate(&mut random, &mut bytes, files);
        }
        let prepared = prepare(&bytes);
        let mut found = None;
        let used = allocation_counter::measure(|| {
            found = catch_unwind(AssertUnwindSafe(|| read(&prepared))).ok();
        });
        let is_usable = found.is_some_and(|found| catch_unwind(AssertUnwindSafe(|| go_on(found))).is_ok());
        let length = size(&bytes).max(bytes.len()) as u64;
        let text = || format!("{name}, case {case}: {:?}", String::from_utf8_lossy(&bytes));
        assert!(is_usable, "a panic in {}", text());
        let (most, work) = (MULTIPLE * length + SMALL, TURNOVER * length + WORK);
        assert!(used.bytes_max <= most, "{} bytes of memory for {length} in {}", used.bytes_max, text());
        assert!(used.bytes_total <= work, "{} bytes allocated for {length} in {}", used.bytes_total, text());
        largest = largest.max(used.bytes_max.saturating_sub(SMALL) as f64 / length as f64);
        case += 1;
    }
    println!("{name}: {mutated} mutated bytes in {case} files, memory at most {largest:.2} times the file");
}

/// Ends the process with a message if a case takes too long: a thread that hangs cannot be stopped otherwise.
struct Watch {
    case: Arc<AtomicU64>,
    is_over: Arc<AtomicBool>,
}

impl Watch {
    fn start(name: &str) -> Self {
        let (case, is_over) = (Arc::new(AtomicU64::new(0)), Arc::new(AtomicBool::new(false)));
        let (watched, over, name) = (case.clone(), is_over.clone(), name.to_owned());
        std::thread::spawn(move || {
            let mut seen = (u64::MAX, Instant::now());
            while !over.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(200));
                let case = watched.load(Ordering::Relaxed);
                if seen.0 != case {
                    seen = (case, Instant::now());
                } else if seen.1.elapsed() > HANGS {
                    eprintln!("{name}, case {case} hangs");
                    std::process::exit(101);
                }
            }
        });
        Self { case, is_over }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
    }
}
