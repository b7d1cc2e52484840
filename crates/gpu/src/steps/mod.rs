//! Many bodies of one mesh on a device, which step together: environments that differ in stiffness, density and weight.
//!
//! A step is a list of kernels, and many steps are sent at once. The device is read only when a state, or the failures, are requested.

mod arrays;
mod body;
mod descent;
mod explicit;

use std::sync::Arc;

use wgpu::Buffer;

use crate::elements::Law;
use crate::program::Kernel;
use crate::{Device, DeviceError, Number};
use arrays::Arrays;

pub use body::{Body, Environment, Method, Scheme};

/// Largest number of evaluations of elements in one submission: about a tenth of a second on a slow card, less than a watchdog's limit.
const MOST_WORK: usize = 1 << 24;

/// Largest number of kernels in one submission.
const MOST_KERNELS: usize = 4096;

/// Failure of an environment: its step and its cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// The step after which it was found, from 1.
    pub step: usize,
    /// Inverted element, or number that is not finite.
    pub cause: Cause,
}

/// Cause of a failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The place or velocity of this node is not finite; it is the first such node.
    NotFinite {
        /// The node.
        node: usize,
    },
    /// This element has no volume, or a negative one, where the law has no stress for it; it is the first such element.
    Inverted {
        /// The element.
        element: usize,
    },
}

/// Kernels of a run, in their order.
pub(crate) struct Kernels {
    /// Before the first step.
    pub(crate) start: Vec<Kernel>,
    /// The beginning of a step, or all of it.
    pub(crate) step: Vec<Kernel>,
    /// A sweep of the step, and the number of sweeps.
    pub(crate) sweep: Vec<Kernel>,
    pub(crate) sweeps: usize,
    /// The end of the step.
    pub(crate) finish: Vec<Kernel>,
    /// After the last step that was asked for.
    pub(crate) end: Vec<Kernel>,
    /// Evaluations of an element by one invocation, about.
    pub(crate) weight: usize,
}

impl Kernels {
    /// The kernels of some steps, which are the first or not.
    fn of_steps(&self, steps: usize, are_first: bool) -> impl Iterator<Item = &Kernel> {
        let start = self.start.iter().filter(move |_| are_first);
        let sweeps = || (0..self.sweeps).flat_map(|_| &self.sweep);
        let steps = (0..steps).flat_map(move |_| self.step.iter().chain(sweeps()).chain(&self.finish));
        start.chain(steps).chain(&self.end)
    }
}

/// Bodies on a device, in one number type.
pub struct Bodies<N: Number> {
    device: Arc<Device>,
    arrays: Arrays,
    kernels: Kernels,
    read_state: Kernel,
    set_state: Kernel,
    find_forces: Kernel,
    read_forces: Kernel,
    landing: Buffer,
    troubles: Buffer,
    nodes: usize,
    environments: usize,
    has_started: bool,
    reads: usize,
    number: std::marker::PhantomData<N>,
}

impl<N: Number> Bodies<N> {
    /// Builds arrays and kernels on a device, and sets the bodies into their initial state: undeformed.
    pub fn new(
        device: &Arc<Device>,
        body: &Body,
        law: Law,
        method: &Method,
        environments: &[Environment],
    ) -> Result<Self, DeviceError> {
        let (nodes, count) = (body.nodes(), environments.len());
        let arrays = Arrays::new::<N>(device, body, method, environments)?;
        let kernels = match &method.scheme {
            Scheme::VertexBlockDescent { sweeps, colors } => {
                descent::kernels::<N>(device, &arrays, law, (*sweeps, colors))?
            }
            _ => explicit::kernels::<N>(device, &arrays, law, method)?,
        };
        let [read_state, set_state, find_forces, read_forces] = arrays.of_states::<N>(device, law)?;
        let mut bodies = Self {
            landing: device.landing((6 * nodes * size_of::<N>()) as u64)?,
            troubles: device.landing((3 * count * size_of::<u32>()) as u64)?,
            device: Arc::clone(device),
            arrays,
            kernels,
            read_state,
            set_state,
            find_forces,
            read_forces,
            nodes,
            environments: count,
            has_started: false,
            reads: 0,
            number: std::marker::PhantomData,
        };
        if !body.velocities.is_empty() {
            let rest = vec![[0.0; 3]; nodes];
            (0..count).try_for_each(|environment| bodies.set_state(environment, &rest, &body.velocities))?;
        }
        Ok(bodies)
    }

    /// Takes steps, and returns when they have ended.
    pub fn advance(&mut self, steps: usize) -> Result<(), DeviceError> {
        if steps == 0 {
            return Ok(());
        }
        let (mut together, mut work, mut before) = (Vec::new(), 0, None);
        for kernel in self.kernels.of_steps(steps, !self.has_started) {
            together.push(kernel);
            work += kernel.invocations();
            if work * self.kernels.weight >= MOST_WORK || together.len() >= MOST_KERNELS {
                self.send(&mut together, &mut before)?;
                work = 0;
            }
        }
        self.send(&mut together, &mut before)?;
        self.has_started = true;
        before.map_or(Ok(()), |index| self.device.wait(index))
    }

    /// Sends kernels while those before them run: the device is never idle, and its queue never long.
    fn send(&self, together: &mut Vec<&Kernel>, before: &mut Option<wgpu::SubmissionIndex>) -> Result<(), DeviceError> {
        let sent = self.run(together)?;
        together.clear();
        before.replace(sent).map_or(Ok(()), |index| self.device.wait(index))
    }

    /// Displacements (m) and velocities (m/s) of the nodes of an environment now. They are invalid for an environment that has failed.
    pub fn state(&mut self, environment: usize) -> Result<[Vec<[N; 3]>; 2], DeviceError> {
        self.device.write(&self.arrays.chosen, &[environment as u32, 0, 0, 0]);
        let numbers = self.read_one(&[&self.read_state])?;
        self.reads += 1;
        Ok([self.vectors(&numbers, 0), self.vectors(&numbers, 1)])
    }

    /// Sets the displacements (m) and velocities (m/s) of an environment, before the first step.
    pub fn set_state(&mut self, environment: usize, u: &[[f64; 3]], v: &[[f64; 3]]) -> Result<(), DeviceError> {
        let lists = [u, v].into_iter().flat_map(|of| (0..3).flat_map(move |i| of.iter().map(move |x| N::of(x[i]))));
        let lists: Vec<N> = lists.collect();
        self.device.write(&self.arrays.one, &lists);
        self.device.write(&self.arrays.chosen, &[environment as u32, 0, 0, 0]);
        self.has_started = false;
        let sent = self.run(&[&self.set_state])?;
        self.device.wait(sent)
    }

    /// Elastic forces on the nodes of an environment now, N.
    pub fn elastic_forces(&mut self, environment: usize) -> Result<Vec<[N; 3]>, DeviceError> {
        self.device.write(&self.arrays.chosen, &[environment as u32, 0, 0, 0]);
        let numbers = self.read_one(&[&self.find_forces, &self.read_forces])?;
        self.has_started = false;
        Ok(self.vectors(&numbers, 0))
    }

    /// The first trouble of each environment; `None` for one whose state is finite and has no inverted element.
    pub fn troubles(&mut self) -> Result<Vec<Option<Trouble>>, DeviceError> {
        let mut commands = self.device.commands();
        commands.copy_buffer_to_buffer(&self.arrays.records, 0, &self.troubles, 0, self.troubles.size());
        self.device.submit(commands)?;
        let words: Vec<u32> = self.device.read(&self.troubles, 3 * self.environments)?;
        self.reads += 1;
        let of = |environment: usize| {
            let (step, found) = (words[self.environments + environment], words[2 * self.environments + environment]);
            body::cause(found).map(|cause| Trouble { step: step as usize, cause })
        };
        Ok((0..self.environments).map(of).collect())
    }

    /// Number of reads from the device so far.
    pub fn reads(&self) -> usize {
        self.reads
    }

    /// Number of environments.
    pub fn environments(&self) -> usize {
        self.environments
    }

    /// Memory on the device, bytes.
    pub fn bytes(&self) -> usize {
        self.arrays.bytes()
    }

    /// Runs kernels that fill the array of one environment, and reads it.
    fn read_one(&self, kernels: &[&Kernel]) -> Result<Vec<N>, DeviceError> {
        self.run(kernels)?;
        let mut commands = self.device.commands();
        commands.copy_buffer_to_buffer(&self.arrays.one, 0, &self.landing, 0, self.landing.size());
        self.device.submit(commands)?;
        self.device.read(&self.landing, 6 * self.nodes)
    }

    fn run(&self, kernels: &[&Kernel]) -> Result<wgpu::SubmissionIndex, DeviceError> {
        let mut commands = self.device.commands();
        {
            let mut pass = commands.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            kernels.iter().for_each(|kernel| kernel.run(&mut pass));
        }
        self.device.submit(commands)
    }

    /// The vectors of the nodes from the first or second three lists.
    fn vectors(&self, numbers: &[N], part: usize) -> Vec<[N; 3]> {
        (0..self.nodes).map(|node| [0, 1, 2].map(|i| numbers[(3 * part + i) * self.nodes + node])).collect()
    }
}
