//! The kernels of an iteration, with their arrays and constants.

use wgpu::Buffer;

use super::{Arrays, CoarseGrid};
use crate::matrix::Slices;
use crate::program::{Kernel, Program};
use crate::{Device, DeviceError, Number};

/// Degree of the polynomial, and the part of the spectrum that it leaves to the coarse grid.
const DEGREE: usize = 4;
const PART: f64 = 1.0 / 20.0;

/// Largest eigenvalue of D⁻¹A: the number of nodes of an element, if the matrices of the elements are positive semi-definite.
const LARGEST: f64 = 4.0;

/// The shader of all kernels.
pub(super) fn program<T: Number>(device: &Device) -> Result<Program<'_>, DeviceError> {
    Program::new::<T>(device, include_str!("kernels.wgsl"))
}

/// The kernel that inverts the diagonal blocks, whose first numbers are given.
pub(super) fn invert(
    program: &Program,
    device: &Device,
    arrays: &Arrays,
    (rows, groups): (usize, usize),
    diagonal: &Buffer,
) -> Result<Kernel, DeviceError> {
    let sizes = device.uniform(&[rows as u32, 0, groups as u32, 0])?;
    let Arrays { values, inverses, is_indefinite, .. } = arrays;
    let bound = [(0, &sizes), (3, values), (23, diagonal), (24, inverses), (25, is_indefinite)];
    program.kernel("invert", &[], &bound, groups)
}

/// The kernels of an iteration in their order.
pub(super) fn of_iteration<T: Number>(
    program: &Program,
    device: &Device,
    slices: &Slices,
    arrays: &Arrays,
    coarse: Option<&CoarseGrid>,
    (rows, groups): (usize, usize),
) -> Result<Vec<Kernel>, DeviceError> {
    let corners = coarse.map_or(0, |coarse| coarse.corners);
    let sizes = device.uniform(&[rows as u32, corners as u32, groups as u32, 0])?;
    let starts = device.array_of("the slices", &slices.starts)?;
    let columns = device.array_of("the columns", &slices.columns)?;
    let [z, next, change] =
        ["the polynomial", "the next polynomial", "its change"].map(|what| device.array::<T>(what, 3 * rows));
    let (z, next, change) = (z?, next?, change?);
    let sums = device.array::<T>("sums", 2 * groups)?;
    let coarse_change = device.array::<T>("the coarse correction", 3 * corners)?;
    let (corners_of, weights) = (corners_of(coarse), weights_of::<T>(coarse));
    let (corners_of, weights) = (device.array_of("corners", &corners_of)?, device.array_of("weights", &weights)?);
    let Arrays { values, inverses, x, r, p, q, numbers, counts, is_indefinite, free, coarse_inverse } = arrays;
    let [first, higher @ ..] = coefficients();
    let mut list = vec![program.kernel(
        "advance",
        &[("of_residual", first[1])],
        &[(0, &sizes), (4, inverses), (5, x), (6, r), (7, p), (8, q), (9, &z), (11, &change), (13, numbers)],
        groups,
    )?];
    let (mut from, mut to) = (&z, &next);
    for [of_change, of_residual] in higher {
        list.push(program.kernel(
            "raise_degree",
            &[("of_change", of_change), ("of_residual", of_residual)],
            &[
                (0, &sizes),
                (1, &starts),
                (2, &columns),
                (3, values),
                (4, inverses),
                (6, r),
                (9, from),
                (10, to),
                (11, &change),
            ],
            groups,
        )?);
        std::mem::swap(&mut from, &mut to);
    }
    if let Some(coarse) = coarse {
        let (members, shares) = members::<T>(coarse);
        let (members, shares) = (device.array_of("members", &members)?, device.array_of("shares", &shares)?);
        let residual = device.array::<T>("the coarse residual", 3 * corners)?;
        let restricted = [(6, r), (15, &members), (16, &shares), (17, free), (18, &residual)];
        list.push(program.kernel("collect", &[], &restricted, corners)?);
        let solved = [(0, &sizes), (13, numbers), (18, &residual), (19, coarse_inverse), (20, &coarse_change)];
        list.push(program.kernel("solve_coarse", &[], &solved, corners)?);
    }
    let prolonged = [
        (0, &sizes),
        (6, r),
        (8, q),
        (9, from),
        (12, &sums),
        (17, free),
        (20, &coarse_change),
        (21, &corners_of),
        (22, &weights),
    ];
    let summed = [(0, &sizes), (12, &sums), (13, numbers), (14, counts)];
    let multiplied = [(0, &sizes), (1, &starts), (2, &columns), (3, values), (7, p), (8, q), (12, &sums)];
    list.push(program.kernel("prolong", &[], &prolonged, groups)?);
    let directed = [&summed[..], &[(25, is_indefinite)]].concat();
    list.push(program.kernel("find_direction", &[], &directed, 1)?);
    list.push(program.kernel("turn", &[], &[(0, &sizes), (7, p), (8, q), (13, numbers)], groups)?);
    list.push(program.kernel("multiply", &[], &multiplied, groups)?);
    list.push(program.kernel("find_length", &[], &summed, 1)?);
    Ok(list)
}

/// Factors of the change and of the scaled residual that raise the degree of the polynomial by one: Saad 2003, algorithm 12.1.
fn coefficients() -> [[f64; 2]; DEGREE] {
    let (least, largest) = (PART * LARGEST, LARGEST);
    let (center, radius) = (0.5 * (largest + least), 0.5 * (largest - least));
    let mut rho = radius / center;
    std::array::from_fn(|degree| {
        if degree == 0 {
            return [0.0, 1.0 / center];
        }
        let before = rho;
        rho = 1.0 / (2.0 * center / radius - before);
        [rho * before, 2.0 * rho / radius]
    })
}

/// Nodes around each corner, behind the first of each corner, with their shares at the same places.
fn members<T: Number>(coarse: &CoarseGrid) -> (Vec<u32>, Vec<T>) {
    let mut around = vec![Vec::new(); coarse.corners];
    for (node, (corners, weights)) in coarse.corners_of.iter().zip(&coarse.weights).enumerate() {
        for (&corner, &weight) in corners.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
            around[corner as usize].push((node as u32, weight));
        }
    }
    let mut first = coarse.corners as u32 + 1;
    let mut members = Vec::new();
    for of_corner in &around {
        members.push(first);
        first += of_corner.len() as u32;
    }
    members.push(first);
    let mut shares = vec![T::zeroed(); members.len()];
    for (node, weight) in around.into_iter().flatten() {
        members.push(node);
        shares.push(T::of(f64::from(weight)));
    }
    (members, shares)
}

fn corners_of(coarse: Option<&CoarseGrid>) -> Vec<u32> {
    coarse.map_or(Vec::new(), |coarse| coarse.corners_of.as_flattened().to_vec())
}

fn weights_of<T: Number>(coarse: Option<&CoarseGrid>) -> Vec<T> {
    let weights = coarse.map_or(&[][..], |coarse| coarse.weights.as_flattened());
    weights.iter().map(|weight| T::of(f64::from(*weight))).collect()
}
