//! Encoding of calls and answers: frames of bytes, each value as plain little-endian numbers.
//!
//! A frame is a length (u32), a kind (u8) and that many bytes. Every frame is checked: a submission may write anything.

use std::io::{self, Read, Write};

use nalgebra::{DVector, Matrix4, SMatrix, Scalar, Vector4};
use nalgebra_sparse::CsrMatrix;

/// Length of the longest frame that is read, bytes.
pub const LONGEST_FRAME: usize = 1 << 26;

/// Length of the longest text of a panic, bytes.
pub const LONGEST_MESSAGE: usize = 2048;

/// The start of a text, at most so many bytes of it.
pub fn start(text: &str, most: usize) -> &str {
    let end = (0..=most.min(text.len())).rev().find(|&end| text.is_char_boundary(end));
    &text[..end.unwrap_or(0)]
}

/// Kinds of frames beside the calls, whose kind is the number of their function.
pub mod kind {
    /// The next call is to be made this often (u64) in a row; its last answer counts. Its closures are the child's own.
    pub const REPEAT: u8 = 30;
    /// A whole simulation.
    pub const SIMULATE: u8 = 31;
    /// The child is ready.
    pub const READY: u8 = 40;
    /// The function's result.
    pub const RETURNED: u8 = 41;
    /// The function panicked: message and place, as text.
    pub const PANICKED: u8 = 42;
    /// The function calls a closure; its number is added to this kind.
    pub const CLOSURE: u8 = 50;
    /// The parent's answer to a closure.
    pub const ANSWER: u8 = 43;
}

/// Writes one frame.
///
/// # Errors
/// The reason if the other side is gone.
pub fn send(to: &mut impl Write, kind: u8, body: &[u8]) -> io::Result<()> {
    let length = u32::try_from(body.len()).map_err(|_| io::ErrorKind::InvalidInput)?;
    let mut frame = Vec::with_capacity(body.len() + 5);
    frame.extend(length.to_le_bytes());
    frame.push(kind);
    frame.extend(body);
    to.write_all(&frame)
}

/// Reads one frame: its kind and its body.
///
/// # Errors
/// The reason if the other side is gone or announces a frame longer than [`LONGEST_FRAME`].
pub fn receive(from: &mut impl Read) -> io::Result<(u8, Vec<u8>)> {
    let mut head = [0; 5];
    from.read_exact(&mut head)?;
    let length = u32::from_le_bytes([head[0], head[1], head[2], head[3]]) as usize;
    if length > LONGEST_FRAME {
        return Err(io::Error::new(io::ErrorKind::InvalidData, format!("a frame of {length} bytes")));
    }
    // Read in pieces: memory is never allocated for a length that a frame only claims.
    let mut body = Vec::new();
    from.take(length as u64).read_to_end(&mut body)?;
    if body.len() < length {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    Ok((head[4], body))
}

/// A value that can be encoded.
pub trait Wire: Sized {
    /// Appends the value.
    fn put(&self, out: &mut Vec<u8>);
    /// Takes the value from the front; `None` if it is missing or not valid.
    fn get(input: &mut &[u8]) -> Option<Self>;
}

/// Reads a whole body as one value; `None` if bytes are missing or left over.
pub fn read<T: Wire>(mut body: &[u8]) -> Option<T> {
    let value = T::get(&mut body)?;
    body.is_empty().then_some(value)
}

/// The bytes of one value.
pub fn bytes<T: Wire>(value: &T) -> Vec<u8> {
    let mut out = Vec::new();
    value.put(&mut out);
    out
}

impl Wire for () {
    fn put(&self, _: &mut Vec<u8>) {}
    fn get(_: &mut &[u8]) -> Option<Self> {
        Some(())
    }
}

impl Wire for u64 {
    fn put(&self, out: &mut Vec<u8>) {
        out.extend(self.to_le_bytes());
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        input.split_off(..8).map(|bytes| u64::from_le_bytes(bytes.try_into().expect("eight bytes")))
    }
}

impl Wire for f64 {
    fn put(&self, out: &mut Vec<u8>) {
        self.to_bits().put(out);
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        u64::get(input).map(f64::from_bits)
    }
}

impl Wire for f32 {
    fn put(&self, out: &mut Vec<u8>) {
        out.extend(self.to_le_bytes());
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        input.split_off(..4).map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four bytes")))
    }
}

impl Wire for usize {
    fn put(&self, out: &mut Vec<u8>) {
        (*self as u64).put(out);
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        u64::get(input)?.try_into().ok()
    }
}

impl<T: Wire> Wire for Vec<T> {
    fn put(&self, out: &mut Vec<u8>) {
        put_all(self, out);
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        let length = usize::get(input)?;
        (0..length).map(|_| T::get(input)).collect()
    }
}

fn put_all<T: Wire>(values: &[T], out: &mut Vec<u8>) {
    values.len().put(out);
    for value in values {
        value.put(out);
    }
}

impl<T: Wire + Copy + Default, const N: usize> Wire for [T; N] {
    fn put(&self, out: &mut Vec<u8>) {
        self.iter().for_each(|value| value.put(out));
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        let mut values = [T::default(); N];
        for value in &mut values {
            *value = T::get(input)?;
        }
        Some(values)
    }
}

impl Wire for String {
    fn put(&self, out: &mut Vec<u8>) {
        self.len().put(out);
        out.extend(self.bytes());
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        let length = usize::get(input)?;
        input.split_off(..length).map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }
}

impl<T: Wire + Scalar + Copy + Default, const R: usize, const C: usize> Wire for SMatrix<T, R, C> {
    fn put(&self, out: &mut Vec<u8>) {
        self.iter().for_each(|entry| entry.put(out));
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        let mut matrix = Self::from_element(T::default());
        for entry in matrix.iter_mut() {
            *entry = T::get(input)?;
        }
        Some(matrix)
    }
}

impl Wire for DVector<f64> {
    fn put(&self, out: &mut Vec<u8>) {
        put_all(self.as_slice(), out);
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        Vec::get(input).map(DVector::from_vec)
    }
}

impl Wire for CsrMatrix<f64> {
    fn put(&self, out: &mut Vec<u8>) {
        self.nrows().put(out);
        self.ncols().put(out);
        put_all(self.row_offsets(), out);
        put_all(self.col_indices(), out);
        put_all(self.values(), out);
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        let (rows, columns) = (usize::get(input)?, usize::get(input)?);
        let (offsets, indices, values) = (Vec::get(input)?, Vec::get(input)?, Vec::get(input)?);
        // One offset more than rows: with the largest number of rows the library's own check overflows.
        let is_whole = rows.checked_add(1) == Some(offsets.len());
        is_whole.then(|| CsrMatrix::try_from_csr_data(rows, columns, offsets, indices, values).ok())?
    }
}

impl<A: Wire, B: Wire> Wire for (A, B) {
    fn put(&self, out: &mut Vec<u8>) {
        self.0.put(out);
        self.1.put(out);
    }
    fn get(input: &mut &[u8]) -> Option<Self> {
        Some((A::get(input)?, B::get(input)?))
    }
}

/// An argument as functions take it, and the value that it is decoded to.
pub trait Argument<'a> {
    /// The value that the argument borrows or is.
    type Stored: Wire;
    /// The argument made from the value.
    fn lend(stored: &'a Self::Stored) -> Self;
    /// Appends the value.
    fn append(&self, out: &mut Vec<u8>);
}

macro_rules! by_value {
    ($($type:ty),*) => {$(
        impl<'a> Argument<'a> for $type {
            type Stored = $type;
            fn lend(stored: &'a $type) -> Self {
                *stored
            }
            fn append(&self, out: &mut Vec<u8>) {
                Wire::put(self, out);
            }
        }
    )*};
}
by_value!(f64, usize);

macro_rules! by_reference {
    ($($type:ty),*) => {$(
        impl<'a> Argument<'a> for &'a $type {
            type Stored = $type;
            fn lend(stored: &'a $type) -> Self {
                stored
            }
            fn append(&self, out: &mut Vec<u8>) {
                Wire::put(*self, out);
            }
        }
    )*};
}
by_reference!([usize; 4], SMatrix<f64, 3, 1>, SMatrix<f64, 3, 3>, Vector4<f32>, Matrix4<f32>, DVector<f64>);

impl<'a, T: Wire> Argument<'a> for &'a [T] {
    type Stored = Vec<T>;
    fn lend(stored: &'a Vec<T>) -> Self {
        stored
    }
    fn append(&self, out: &mut Vec<u8>) {
        put_all(self, out);
    }
}
