//! The kernels of vertex block descent.

use super::Kernels;
use super::arrays::{Arrays, source};
use crate::elements::Law;
use crate::program::Program;
use crate::{Device, DeviceError, Number};

/// Elements around a node, about.
const AROUND: usize = 24;

/// The kernels of a number of sweeps over the nodes, colour by colour.
pub(super) fn kernels<N: Number>(
    device: &Device,
    arrays: &Arrays,
    law: Law,
    (sweeps, colors): (usize, &[Vec<u32>]),
) -> Result<Kernels, DeviceError> {
    let program = &Program::new::<N>(device, &source(law, include_str!("shaders/descent.wgsl")))?;
    let inertial = arrays.state::<N>(device, "the places of inertia")?;
    let start = arrays.state::<N>(device, "a start")?;
    let order = device.array_of("the order of the nodes", &colors.concat())?;
    let Arrays { sizes, corners, shapes, factors, u, v, starts, around, nodal, numbers, found, records, .. } = arrays;
    let state = [(0, sizes), (4, u), (5, v), (10, numbers), (12, records), (14, &start)];
    let predicted = [&state[..], &[(3, factors), (9, nodal), (13, &inertial)]].concat();
    let predict = program.kernel_of("predict", &[], &predicted, arrays.all_nodes())?;
    let finished = [&state[..], &[(11, found)]].concat();
    let finish = program.kernel_of("finish", &[], &finished, arrays.all_nodes())?;
    let of_mesh = [(0, sizes), (1, corners), (2, shapes), (3, factors), (4, u), (7, starts), (8, around)];
    let swept = [&of_mesh[..], &[(9, nodal), (10, numbers), (12, records), (13, &inertial), (15, &order)]].concat();
    let mut first = 0;
    let mut of_colors = Vec::new();
    for color in colors {
        of_colors.push((device.uniform(&[first, color.len() as u32, 0, 0])?, color.len()));
        first += color.len() as u32;
    }
    let of_color = of_colors.iter().map(|(color, nodes)| {
        let bound = swept.iter().copied().chain([(16, color)]).collect();
        (bound, nodes * arrays.environments)
    });
    let sweep = program.kernels_of("sweep", of_color)?;
    let look = (!law.allows_inversion()).then(|| arrays.look(program)).transpose()?;
    Ok(Kernels {
        start: Vec::new(),
        step: look.into_iter().chain([arrays.keep_trouble(program, true)?, predict]).collect(),
        sweep,
        sweeps,
        finish: vec![finish],
        end: arrays.after_last(program, law)?,
        weight: AROUND,
    })
}
