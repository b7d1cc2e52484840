//! A body on its worker thread.

use std::any::Any;
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Instant;

use fem_model::simulation::{Failure, Simulation};

use super::message::{News, Ready};
use crate::blueprint::Blueprint;
use crate::frame::Frame;
use crate::surface::Topology;
use crate::{SoftBodyError, SoftBodyPull};

/// A body, and the orders that it has not carried out yet, in the order of their arrival.
pub struct Body {
    stage: Stage,
    orders: VecDeque<Order>,
}

enum Stage {
    /// It is not built yet.
    Waiting(Box<Blueprint>),
    /// A thread of its own builds it, so that other bodies go on.
    Building(JoinHandle<Result<Built, SoftBodyError>>),
    Running(Built),
    /// It was refused or has failed.
    Stopped,
}

struct Built {
    simulation: Box<dyn Simulation>,
    topology: Arc<Topology>,
}

/// An order to a body.
pub enum Order {
    /// Do steps up to this total number.
    Advance(usize),
    /// Pull, or let go.
    Pull(Option<SoftBodyPull>),
}

impl Body {
    /// A body that is not built yet.
    pub fn new(blueprint: Box<Blueprint>) -> Self {
        Self { stage: Stage::Waiting(blueprint), orders: VecDeque::new() }
    }

    /// Adds an order after those that it has.
    pub fn order(&mut self, order: Order) {
        match (self.orders.back_mut(), order) {
            (Some(Order::Advance(last)), Order::Advance(steps)) => *last = steps.max(*last),
            (_, order) => self.orders.push_back(order),
        }
    }

    /// Returns true if a thread is building the simulation.
    pub fn is_building(&self) -> bool {
        matches!(self.stage, Stage::Building(_))
    }

    /// Returns true if the worker can make progress on this body now.
    pub fn has_work(&self) -> bool {
        match &self.stage {
            Stage::Waiting(_) => true,
            Stage::Building(thread) => thread.is_finished(),
            Stage::Running(_) => !self.orders.is_empty(),
            Stage::Stopped => false,
        }
    }

    /// Starts to build it, if it waits for that.
    pub fn start(&mut self) -> Option<News> {
        let Stage::Waiting(blueprint) = std::mem::replace(&mut self.stage, Stage::Stopped) else {
            unreachable!("only a body that waits is started");
        };
        let build = move || -> Result<Built, SoftBodyError> {
            let simulation = blueprint.build()?;
            let topology = Arc::new(Topology::new(&simulation.shape()));
            Ok(Built { simulation, topology })
        };
        match std::thread::Builder::new().name("soft body builder".to_owned()).spawn(build) {
            Ok(thread) => self.stage = Stage::Building(thread),
            Err(error) => return Some(News::Failed(SoftBodyError::NoThread(error.to_string()))),
        }
        None
    }

    /// Returns true if the body is still to be built.
    pub fn is_waiting(&self) -> bool {
        matches!(self.stage, Stage::Waiting(_))
    }

    /// Carries out its orders up to the end of the next step, and returns the news of it.
    pub fn work(&mut self) -> Option<News> {
        match std::mem::replace(&mut self.stage, Stage::Stopped) {
            Stage::Building(thread) if thread.is_finished() => {
                let outcome = thread.join().unwrap_or_else(|panic| Err(panicked(&*panic)));
                Some(self.take_over(outcome))
            }
            Stage::Running(mut built) => {
                // A simulation that has panicked is dropped, so that no one sees it half changed.
                let outcome = catch_unwind(AssertUnwindSafe(|| run_to_next_step(&mut built, &mut self.orders)));
                let news = outcome.unwrap_or_else(|panic| Some(News::Failed(panicked(&*panic))));
                let has_stopped = matches!(&news, Some(News::Failed(error)) if !error.is_harmless());
                if !has_stopped {
                    self.stage = Stage::Running(built);
                }
                news
            }
            stage => {
                self.stage = stage;
                None
            }
        }
    }

    fn take_over(&mut self, outcome: Result<Built, SoftBodyError>) -> News {
        match outcome {
            Ok(built) => {
                let (simulation, topology) = (&*built.simulation, Arc::clone(&built.topology));
                let frame = Frame::of(simulation, &topology);
                let mesh = topology.mesh(&frame.surface);
                let ready = Ready { dt: simulation.dt(), shape: simulation.shape(), topology, mesh, frame };
                self.stage = Stage::Running(built);
                News::Ready(Box::new(ready))
            }
            Err(error) => News::Failed(error),
        }
    }
}

fn run_to_next_step(built: &mut Built, orders: &mut VecDeque<Order>) -> Option<News> {
    while let Some(order) = orders.front() {
        match order {
            Order::Advance(steps) if built.simulation.steps() < *steps => {
                return Some(step(built).unwrap_or_else(|failure| News::Failed(failure.into())));
            }
            Order::Advance(_) => {}
            Order::Pull(wanted) => {
                let outcome = pull(&mut *built.simulation, wanted.as_ref());
                if let Err(error) = outcome {
                    orders.pop_front();
                    return Some(News::Failed(error));
                }
            }
        }
        orders.pop_front();
    }
    None
}

fn step(built: &mut Built) -> Result<News, Failure> {
    let start = Instant::now();
    built.simulation.step()?;
    let duration = start.elapsed();
    Ok(News::Step(Frame::of(&*built.simulation, &built.topology), duration))
}

fn pull(simulation: &mut dyn Simulation, wanted: Option<&SoftBodyPull>) -> Result<(), SoftBodyError> {
    let Some(wanted) = wanted else {
        simulation.pull(None);
        return Ok(());
    };
    let pull = wanted.checked(simulation.shape().mesh.vertices().len())?;
    let is_set = |value: f64| simulation.parameters().iter().any(|known| known.key == "drag" && known.value == value);
    if !is_set(wanted.stiffness) {
        let named = |text| SoftBodyError::Pull(format!("SoftBodyPull.stiffness: {text}"));
        simulation.set_parameter("drag", wanted.stiffness).map_err(named)?;
    }
    simulation.pull(Some(pull));
    Ok(())
}

fn panicked(panic: &(dyn Any + Send)) -> SoftBodyError {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    SoftBodyError::Panicked(text.unwrap_or_else(|| "no message".to_owned()))
}
