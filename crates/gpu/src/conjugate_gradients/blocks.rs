//! The blocks of the matrix: sent, set one by one, read, and the inverses of the diagonal ones.

use super::ConjugateGradients;
use crate::matrix::SLICE;
use crate::{DeviceError, Number};

/// Number of blocks up to which they are sent one by one, and not within the whole matrix.
const FEW: usize = 64;

impl<T: Number> ConjugateGradients<T> {
    /// Sends a matrix: its blocks in the order of the pattern.
    pub fn set_matrix(&mut self, block: impl Fn(usize) -> [[f64; 3]; 3]) -> Result<(), DeviceError> {
        for (number, &place) in self.slices.places.iter().enumerate() {
            put(&mut self.values, place as usize, &block(number));
        }
        self.device.write(&self.arrays.values, &self.values);
        let mut commands = self.device.commands();
        self.invert_diagonal(&mut commands);
        self.device.submit(commands)?;
        Ok(())
    }

    /// Sets some blocks of a matrix, with their numbers in the pattern, and clears the others. The diagonal is not inverted yet.
    pub(crate) fn set_blocks(
        &mut self,
        blocks: impl ExactSizeIterator<Item = (usize, [[f64; 3]; 3])>,
    ) -> Result<(), DeviceError> {
        let Self { device, arrays, slices, values, .. } = self;
        if blocks.len() > FEW {
            values.fill(T::zeroed());
            blocks.for_each(|(number, block)| put(values, slices.places[number] as usize, &block));
            device.write(&arrays.values, values);
            return Ok(());
        }
        let mut commands = device.commands();
        commands.clear_buffer(&arrays.values, 0, None);
        device.submit(commands)?;
        for (number, block) in blocks {
            for (k, entry) in block.as_flattened().iter().enumerate() {
                let place = slices.places[number] as usize + k * SLICE;
                device.write_at(&arrays.values, place, &[T::of(*entry)]);
            }
        }
        Ok(())
    }

    /// Adds commands that find the inverses of the diagonal blocks of the matrix that is there then.
    pub(crate) fn invert_diagonal(&self, commands: &mut wgpu::CommandEncoder) {
        commands.clear_buffer(&self.arrays.is_indefinite, 0, None);
        self.invert.run(&mut commands.begin_compute_pass(&wgpu::ComputePassDescriptor::default()));
    }

    /// The blocks of the matrix in the order of the pattern.
    pub fn matrix(&self) -> Result<Vec<[[f64; 3]; 3]>, DeviceError> {
        let bytes = self.arrays.values.size();
        let landing = self.device.landing(bytes)?;
        let mut commands = self.device.commands();
        commands.copy_buffer_to_buffer(&self.arrays.values, 0, &landing, 0, bytes);
        self.device.submit(commands)?;
        let numbers: Vec<T> = self.device.read(&landing, self.slices.numbers())?;
        let entry = |place: u32, k: usize| numbers[place as usize + k * SLICE].as_f64();
        let block = |&place: &u32| [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(place, 3 * i + j)));
        Ok(self.slices.places.iter().map(block).collect())
    }
}

/// Writes a block into slices, from the place of its first number on.
fn put<T: Number>(numbers: &mut [T], place: usize, block: &[[f64; 3]; 3]) {
    for (k, entry) in block.as_flattened().iter().enumerate() {
        numbers[place + k * SLICE] = T::of(*entry);
    }
}
