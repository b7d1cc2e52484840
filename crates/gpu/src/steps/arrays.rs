//! The arrays of bodies on a device.

use wgpu::Buffer;

use super::{Body, Environment, Method};
use crate::elements::{self, Law, lists};
use crate::program::{Kernel, Program};
use crate::{Device, DeviceError, Number};

/// Shader functions that the kernels of all methods call: tensors, the law, the forces.
pub(super) fn source(law: Law, rest: &str) -> String {
    elements::source(law, &[include_str!("shaders/bodies.wgsl"), rest].join("\n"))
}

/// Places in `numbers` of the shader.
pub(super) const ZERO: u32 = 2;
pub(super) const HALF_DT: u32 = 3;
pub(super) const SIXTH_DT: u32 = 4;
pub(super) const THIRD_DT: u32 = 5;
pub(super) const DT: u32 = 0;

/// The arrays of the mesh, of the environments and of their states, see `bodies.wgsl`.
pub(super) struct Arrays {
    pub nodes: usize,
    pub elements: usize,
    pub environments: usize,
    pub sizes: Buffer,
    pub corners: Buffer,
    pub shapes: Buffer,
    pub factors: Buffer,
    pub u: Buffer,
    pub v: Buffer,
    pub forces: Buffer,
    pub starts: Buffer,
    pub around: Buffer,
    pub nodal: Buffer,
    pub numbers: Buffer,
    pub found: Buffer,
    pub records: Buffer,
    /// The state of one environment, and its number.
    pub one: Buffer,
    pub chosen: Buffer,
}

impl Arrays {
    pub(super) fn new<N: Number>(
        device: &Device,
        body: &Body,
        method: &Method,
        environments: &[Environment],
    ) -> Result<Self, DeviceError> {
        let (nodes, elements, count) = (body.nodes(), body.tetrahedra.corners.len(), environments.len());
        let numbers = |values: Vec<f64>| -> Vec<N> { values.into_iter().map(N::of).collect() };
        let (starts, around) = elements_around(body);
        let dt = method.dt;
        let damped = 1.0 / (1.0 + method.alpha * dt);
        let epsilon = if N::IS_DOUBLE { f64::EPSILON } else { f64::from(f32::EPSILON) };
        let of_descent = [dt * damped, dt * dt * damped, 1.0 / dt, 1.0 / (dt * dt * damped), epsilon];
        let of_method = [vec![dt, method.alpha, 0.0, 0.5 * dt, dt / 6.0, dt / 3.0], of_descent.to_vec()].concat();
        let records: Vec<u32> = (0..3 * count).map(|word| if word < 2 * count { 0 } else { u32::MAX }).collect();
        Ok(Self {
            sizes: device.uniform(&[nodes as u32, elements as u32, count as u32, 0])?,
            corners: device.array_of("the corners of the elements", &body.tetrahedra.corner_lists())?,
            shapes: device.array_of("the shapes of the elements", &numbers(body.tetrahedra.shape_lists()))?,
            factors: device.array_of("the parameters of the environments", &numbers(factors(environments)))?,
            u: device.array::<N>("the displacements", 3 * nodes * count)?,
            v: device.array::<N>("the velocities", 3 * nodes * count)?,
            forces: device.array::<N>("the forces of the elements", 9 * elements * count)?,
            starts: device.array_of("the nodes", &starts)?,
            around: device.array_of("the elements around the nodes", &around)?,
            nodal: device.array_of("masses and loads", &numbers(nodal(body)))?,
            numbers: device.array_of("numbers", &numbers(of_method))?,
            found: device.array_of("troubles", &vec![u32::MAX; count])?,
            records: device.array_of("records", &records)?,
            one: device.array::<N>("a state", 6 * nodes)?,
            chosen: device.uniform(&[0; 4])?,
            nodes,
            elements,
            environments: count,
        })
    }

    /// Elements of all environments.
    pub(super) fn all_elements(&self) -> usize {
        self.elements * self.environments
    }

    /// Nodes of all environments.
    pub(super) fn all_nodes(&self) -> usize {
        self.nodes * self.environments
    }

    /// A state's array beside `u` and `v`.
    pub(super) fn state<N: Number>(&self, device: &Device, what: &'static str) -> Result<Buffer, DeviceError> {
        device.array::<N>(what, 3 * self.all_nodes())
    }

    /// Forces of the elements at displacements. Those at the end of a step look for inverted elements.
    pub(super) fn find_forces(&self, program: &Program, u: &Buffer, looks: bool) -> Result<Kernel, DeviceError> {
        let Self { sizes, corners, shapes, factors, forces, found, .. } = self;
        let bound = [(0, sizes), (1, corners), (2, shapes), (3, factors), (4, u), (6, forces), (11, found)];
        program.kernel_of("find_forces", &[("looks", f64::from(u8::from(looks)))], &bound, self.all_elements())
    }

    /// The search for inverted elements after the last step.
    pub(super) fn look(&self, program: &Program) -> Result<Kernel, DeviceError> {
        let Self { sizes, corners, shapes, u, found, .. } = self;
        program.kernel_of(
            "look",
            &[],
            &[(0, sizes), (1, corners), (2, shapes), (4, u), (11, found)],
            self.all_elements(),
        )
    }

    /// Keeps the first trouble of each environment, before a step or after the last.
    pub(super) fn keep_trouble(&self, program: &Program, begins: bool) -> Result<Kernel, DeviceError> {
        let bound = [(0, &self.sizes), (11, &self.found), (12, &self.records)];
        program.kernel_of("keep_trouble", &[("begins", f64::from(u8::from(begins)))], &bound, self.environments)
    }

    /// The look at the state after the last step.
    pub(super) fn after_last(&self, program: &Program, law: Law) -> Result<Vec<Kernel>, DeviceError> {
        let look = (!law.allows_inversion()).then(|| self.look(program)).transpose()?;
        Ok(look.into_iter().chain([self.keep_trouble(program, false)?]).collect())
    }

    /// Kernels that read the state of one environment, set it, find the forces of all, and read those of one.
    pub(super) fn of_states<N: Number>(&self, device: &Device, law: Law) -> Result<[Kernel; 4], DeviceError> {
        let program = Program::new::<N>(device, &source(law, include_str!("shaders/states.wgsl")))?;
        let Self { sizes, u, v, forces, starts, around, one, chosen, .. } = self;
        let state = [(0, sizes), (4, u), (5, v), (13, one), (14, chosen)];
        let of_forces = [(0, sizes), (6, forces), (7, starts), (8, around), (13, one), (14, chosen)];
        Ok([
            program.kernel_of("read_state", &[], &state, self.nodes)?,
            program.kernel_of("set_state", &[], &state, self.nodes)?,
            self.find_forces(&program, u, false)?,
            program.kernel_of("read_forces", &[], &of_forces, self.nodes)?,
        ])
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> usize {
        let Self { corners, shapes, factors, u, v, forces, starts, around, nodal, records, one, .. } = self;
        let all = [corners, shapes, factors, u, v, forces, starts, around, nodal, records, one];
        all.iter().map(|array| array.size() as usize).sum()
    }
}

fn nodal(body: &Body) -> Vec<f64> {
    let of = [&body.inverse_masses, &body.weights, &body.loads];
    lists(9, body.nodes(), |k, node| of[k / 3][node][k % 3])
}

fn factors(environments: &[Environment]) -> Vec<f64> {
    lists(4, environments.len(), |k, e| {
        let Environment { moduli: [first, second], weight, density } = environments[e];
        [first, second, weight, 1.0 / density][k]
    })
}

/// The elements around each node as 4 · element + corner, and the first of each node.
fn elements_around(body: &Body) -> (Vec<u32>, Vec<u32>) {
    let mut around = vec![Vec::new(); body.nodes()];
    for (element, corners) in body.tetrahedra.corners.iter().enumerate() {
        for (corner, &node) in corners.iter().enumerate() {
            around[node as usize].push((4 * element + corner) as u32);
        }
    }
    let ends = around.iter().scan(0, |end, of_node| {
        *end += of_node.len() as u32;
        Some(*end)
    });
    (std::iter::once(0).chain(ends).collect(), around.concat())
}
