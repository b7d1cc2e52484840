//! The kernels of explicit methods.

use wgpu::Buffer;

use super::arrays::{Arrays, DT, HALF_DT, SIXTH_DT, THIRD_DT, ZERO, source};
use super::{Kernels, Method, Scheme};
use crate::elements::Law;
use crate::program::{Kernel, Program};
use crate::{Device, DeviceError, Number};

/// Weight of a stage, and the time from the start of the step to the next stage, as places in the shader's numbers.
type Stage = (u32, u32);

const MIDPOINT: [Stage; 2] = [(ZERO, HALF_DT), (DT, ZERO)];
const CLASSICAL: [Stage; 4] = [(SIXTH_DT, HALF_DT), (THIRD_DT, HALF_DT), (THIRD_DT, DT), (SIXTH_DT, ZERO)];

/// The kernels of a method.
pub(super) fn kernels<N: Number>(
    device: &Device,
    arrays: &Arrays,
    law: Law,
    method: &Method,
) -> Result<Kernels, DeviceError> {
    let program = &Program::new::<N>(device, &source(law, include_str!("shaders/explicit.wgsl")))?;
    let stages: &[Stage] = match method.scheme {
        Scheme::ExplicitEuler => return of_one_stage(program, arrays, law, "explicit_euler"),
        Scheme::SemiImplicitEuler => return of_one_stage(program, arrays, law, "semi_implicit_euler"),
        Scheme::Verlet => return verlet(program, arrays, &arrays.state::<N>(device, "the accelerations")?),
        Scheme::Rk2 => &MIDPOINT,
        Scheme::Rk4 => &CLASSICAL,
        Scheme::VertexBlockDescent { .. } => unreachable!("descent has kernels of its own"),
    };
    let [stage_u, stage_v, start_u, start_v] =
        ["a stage's displacements", "its velocities", "a start", "its velocities"]
            .map(|what| arrays.state::<N>(device, what));
    let of_stages = [&stage_u?, &stage_v?, &start_u?, &start_v?];
    let mut step = vec![arrays.find_forces(program, &arrays.u, true)?, arrays.keep_trouble(program, true)?];
    for (number, &stage) in stages.iter().enumerate() {
        if number > 0 {
            step.push(arrays.find_forces(program, of_stages[0], false)?);
        }
        step.push(of_stage(program, arrays, number == 0, stage, of_stages)?);
    }
    Ok(of_steps(step, arrays.after_last(program, law)?))
}

fn of_one_stage(program: &Program, arrays: &Arrays, law: Law, entry: &str) -> Result<Kernels, DeviceError> {
    let update = program.kernel_of(entry, &[], &with_forces(arrays, true), arrays.all_nodes())?;
    let step = vec![arrays.find_forces(program, &arrays.u, true)?, arrays.keep_trouble(program, true)?, update];
    Ok(of_steps(step, arrays.after_last(program, law)?))
}

fn verlet(program: &Program, arrays: &Arrays, a: &Buffer) -> Result<Kernels, DeviceError> {
    let Arrays { sizes, u, v, numbers, records, .. } = arrays;
    let find_forces = |looks| arrays.find_forces(program, u, looks);
    let of_start = with_forces(arrays, false).into_iter().filter(|(binding, _)| *binding != 4).chain([(13, a)]);
    let start = program.kernel_of("verlet_start", &[], &of_start.collect::<Vec<_>>(), arrays.all_nodes())?;
    let drifted = [(0, sizes), (4, u), (5, v), (10, numbers), (12, records), (13, a)];
    let drift = program.kernel_of("verlet_drift", &[], &drifted, arrays.all_nodes())?;
    let kicked = [with_forces(arrays, true), vec![(13, a)]].concat();
    let kick = program.kernel_of("verlet_kick", &[], &kicked, arrays.all_nodes())?;
    let step = vec![arrays.keep_trouble(program, true)?, drift, find_forces(true)?, kick];
    let start = vec![find_forces(true)?, start];
    Ok(Kernels { start, ..of_steps(step, vec![arrays.keep_trouble(program, false)?]) })
}

/// Steps without sweeps.
fn of_steps(step: Vec<Kernel>, end: Vec<Kernel>) -> Kernels {
    Kernels { start: Vec::new(), step, sweep: Vec::new(), sweeps: 0, finish: Vec::new(), end, weight: 1 }
}

/// A stage of a method of several.
fn of_stage(
    program: &Program,
    arrays: &Arrays,
    is_first: bool,
    (weight, after): Stage,
    of_stages: [&Buffer; 4],
) -> Result<Kernel, DeviceError> {
    let entry = if is_first { "first_stage" } else { "next_stage" };
    let constants = [("weight", f64::from(weight)), ("after", f64::from(after))];
    let of_stages = (14..).zip(of_stages);
    let bound: Vec<_> = with_forces(arrays, !is_first).into_iter().chain(of_stages).collect();
    program.kernel_of(entry, &constants, &bound, arrays.all_nodes())
}

/// Arrays of an entry point that computes accelerations. With `checks` it also checks the new state.
fn with_forces(arrays: &Arrays, checks: bool) -> Vec<(u32, &Buffer)> {
    let Arrays { sizes, factors, u, v, forces, starts, around, nodal, numbers, found, records, .. } = arrays;
    let of_forces = [(0, sizes), (3, factors), (4, u), (5, v), (6, forces), (7, starts), (8, around), (9, nodal)];
    let found = checks.then_some((11, found));
    of_forces.into_iter().chain([(10, numbers), (12, records)]).chain(found).collect()
}
