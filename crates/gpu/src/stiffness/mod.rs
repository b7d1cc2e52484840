//! The matrix of a body of linear tetrahedra, assembled on the device where it is solved with: tangent stiffness, mass, and what the
//! processor sends.
//!
//! A kernel computes the matrices of the elements, and another sums the blocks of the matrix, each in a fixed order.

use std::marker::PhantomData;

use wgpu::Buffer;

use crate::elements::{Law, Tetrahedra, lists, source};
use crate::matrix::{BlockPattern, SLICE};
use crate::program::{Kernel, Program};
use crate::{ConjugateGradients, DeviceError, Number};

/// Numbers of the ten blocks of an element.
const OF_ELEMENT: usize = 90;

/// Words of `numbers` in the shader.
const NUMBERS: usize = 3;

/// The assembly of matrices for a [`ConjugateGradients`].
pub struct Stiffness<T: Number> {
    find_matrices: Kernel,
    assemble: Kernel,
    u: Buffer,
    free: Buffer,
    numbers: Buffer,
    bytes: usize,
    number: PhantomData<T>,
}

/// A matrix Σ f K(u) + m M + others, times a scale.
pub struct Matrix<'a> {
    /// Factors f of the stiffness, and the displacements of all nodes at which it is taken, m.
    pub stiffness: &'a [(f64, Vec<[f64; 3]>)],
    /// The factor m of the mass, 1/s².
    pub mass: f64,
    /// The other blocks with their numbers in the pattern, N/m. Each number is there once.
    pub others: &'a [(usize, [[f64; 3]; 3])],
    /// 1 for each free direction of a node, 0 for a constrained one, in which the diagonal entry alone remains.
    pub free: &'a [[f64; 3]],
    /// The factor of the whole, m/N.
    pub scale: f64,
}

impl<T: Number> Stiffness<T> {
    /// Builds arrays and kernels. The rows of the pattern are the first nodes, `moduli` the parameters of the law for each element (Pa), and
    /// `masses` the mass of each block of the pattern, kg.
    pub fn new(
        solver: &ConjugateGradients<T>,
        pattern: &BlockPattern,
        nodes: usize,
        tetrahedra: &Tetrahedra,
        law: Law,
        moduli: &[[f64; 2]],
        masses: &[f64],
    ) -> Result<Self, DeviceError> {
        let (device, values) = (solver.device(), solver.values());
        let (elements, slices) = (tetrahedra.corners.len(), &solver.slices);
        let slots = slices.columns.len();
        let numbers = |values: Vec<f64>| -> Vec<T> { values.into_iter().map(T::of).collect() };
        let (starts, terms) = terms(pattern, tetrahedra, slices.places.iter().map(|&place| slot(place)), slots);
        let mut of_slots = vec![0.0; slots];
        slices.places.iter().zip(masses).for_each(|(&place, mass)| of_slots[slot(place)] = *mass);
        let of_layers = slices.starts.windows(2).enumerate();
        let layers: Vec<u32> =
            of_layers.flat_map(|(slice, ends)| (ends[0]..ends[1]).map(move |_| slice as u32)).collect();
        let moduli = lists(2, elements, |k, e| moduli[e][k]);

        let sizes = device.uniform(&[nodes as u32, elements as u32, 1, slots as u32])?;
        let corners = device.array_of("the corners of the elements", &tetrahedra.corner_lists())?;
        let shapes = device.array_of("the shapes of the elements", &numbers(tetrahedra.shape_lists()))?;
        let moduli = device.array_of("the moduli of the elements", &numbers(moduli))?;
        let matrices = device.array::<T>("the matrices of the elements", OF_ELEMENT * elements)?;
        let starts = device.array_of("the blocks", &starts)?;
        let terms = device.array_of("the terms of the blocks", &terms)?;
        let masses = device.array_of("the masses", &numbers(of_slots))?;
        let layers = device.array_of("the layers", &layers)?;
        let columns = device.array_of("the columns", &slices.columns)?;
        let u = device.array::<T>("the displacements", 3 * nodes)?;
        let free = device.array::<T>("the free directions", 3 * nodes)?;
        let factors = device.array::<T>("numbers", NUMBERS)?;

        let program = Program::new::<T>(device, &source(law, include_str!("stiffness.wgsl")))?;
        let of_elements =
            [(0, &sizes), (1, &corners), (2, &shapes), (3, &moduli), (4, &u), (5, &matrices), (6, &factors)];
        let of_blocks = [
            (0, &sizes),
            (5, &matrices),
            (6, &factors),
            (7, &starts),
            (8, &terms),
            (9, &masses),
            (10, &layers),
            (11, &columns),
            (12, &free),
            (13, values),
        ];
        let arrays = [&corners, &shapes, &moduli, &matrices, &starts, &terms, &masses, &layers, &columns, &u, &free];
        Ok(Self {
            find_matrices: program.kernel_of("find_matrices", &[], &of_elements, elements)?,
            assemble: program.kernel_of("assemble", &[], &of_blocks, slots)?,
            bytes: arrays.iter().map(|array| array.size() as usize).sum(),
            u,
            free,
            numbers: factors,
            number: PhantomData,
        })
    }

    /// Assembles a matrix for its solver.
    pub fn assemble(&self, solver: &mut ConjugateGradients<T>, matrix: &Matrix) -> Result<(), DeviceError> {
        let others =
            matrix.others.iter().map(|(number, block)| (*number, block.map(|row| row.map(|x| matrix.scale * x))));
        solver.set_blocks(others)?;
        let device = solver.device();
        device.write(&self.free, &vectors::<T>(matrix.free));
        for (number, (factor, u)) in matrix.stiffness.iter().enumerate() {
            let numbers = [factor * matrix.scale, matrix.mass * matrix.scale, number.min(1) as f64];
            device.write(&self.numbers, &numbers.map(T::of));
            device.write(&self.u, &vectors::<T>(u));
            let mut commands = device.commands();
            self.find_matrices.run(&mut commands.begin_compute_pass(&wgpu::ComputePassDescriptor::default()));
            device.submit(commands)?;
        }
        let mut commands = device.commands();
        self.assemble.run(&mut commands.begin_compute_pass(&wgpu::ComputePassDescriptor::default()));
        solver.invert_diagonal(&mut commands);
        device.submit(commands)?;
        Ok(())
    }

    /// Memory on the device, bytes.
    pub fn bytes(&self) -> usize {
        self.bytes
    }
}

/// Vectors in three lists.
fn vectors<T: Number>(of: &[[f64; 3]]) -> Vec<T> {
    lists(3, of.len(), |i, node| T::of(of[node][i]))
}

/// The number of a block in the slices, from its first number.
fn slot(place: u32) -> usize {
    place as usize / (9 * SLICE) * SLICE + place as usize % SLICE
}

/// The blocks of elements that add to each block of the matrix as 16 · element + 4 · corner of the row + corner of the column, and the
/// first of each block in the slices.
fn terms(
    pattern: &BlockPattern,
    tetrahedra: &Tetrahedra,
    slots_of: impl Iterator<Item = usize>,
    slots: usize,
) -> (Vec<u32>, Vec<u32>) {
    let slots_of: Vec<usize> = slots_of.collect();
    let mut of_slots = vec![Vec::new(); slots];
    for (element, corners) in tetrahedra.corners.iter().enumerate() {
        for (a, &row) in corners.iter().enumerate().filter(|(_, row)| (**row as usize) < pattern.rows()) {
            for (b, column) in corners.iter().enumerate().filter(|(_, column)| (**column as usize) < pattern.rows()) {
                let block = pattern.row(row as usize).find(|&block| pattern.columns[block] == *column);
                let block = block.expect("the pattern joins the nodes of an element");
                of_slots[slots_of[block]].push((16 * element + 4 * a + b) as u32);
            }
        }
    }
    let ends = of_slots.iter().scan(0, |end, of_slot| {
        *end += of_slot.len() as u32;
        Some(*end)
    });
    (std::iter::once(0).chain(ends).collect(), of_slots.concat())
}
