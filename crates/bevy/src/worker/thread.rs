//! The loop of a worker thread.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError};
use std::time::Duration;

use super::body::{Body, Order};
use super::message::{Command, News};
use crate::link::BodyId;

/// Time between two looks at a body that is being built.
const BUILDING_INTERVAL: Duration = Duration::from_millis(2);

/// Priority of threads that simulate, from 0 to 99: a niceness of 5, where others have 0.
#[cfg(target_os = "linux")]
const PRIORITY: u8 = 36;

/// A thread with the bodies that it owns.
pub struct Thread {
    commands: Receiver<Command>,
    news: Sender<(BodyId, News)>,
    bodies: BTreeMap<BodyId, Body>,
}

impl Thread {
    /// A thread without bodies.
    pub fn new(commands: Receiver<Command>, news: Sender<(BodyId, News)>) -> Self {
        Self { commands, news, bodies: BTreeMap::new() }
    }

    /// Works until the main thread has dropped its end of the channel.
    pub fn run(mut self) {
        give_way();
        while self.take_commands() {
            self.work();
        }
    }

    /// Executes all commands that have arrived, and waits for a command if no work is left. Returns false at the end of the channel.
    fn take_commands(&mut self) -> bool {
        if !self.has_work() {
            let is_building = self.bodies.values().any(Body::is_building);
            let command = match is_building {
                true => self.commands.recv_timeout(BUILDING_INTERVAL),
                false => self.commands.recv().map_err(|_| RecvTimeoutError::Disconnected),
            };
            match command {
                Ok(command) => self.execute(command),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return false,
            }
        }
        loop {
            match self.commands.try_recv() {
                Ok(command) => self.execute(command),
                Err(TryRecvError::Empty) => return true,
                Err(TryRecvError::Disconnected) => return false,
            }
        }
    }

    fn has_work(&self) -> bool {
        let is_building = self.bodies.values().any(Body::is_building);
        self.bodies.values().any(|body| body.has_work() && !(is_building && body.is_waiting()))
    }

    fn execute(&mut self, command: Command) {
        match command {
            Command::Add(id, blueprint) => drop(self.bodies.insert(id, Body::new(blueprint))),
            Command::Advance(id, steps) => self.order(id, Order::Advance(steps)),
            Command::Pull(id, pull) => self.order(id, Order::Pull(pull)),
            Command::Remove(id) => drop(self.bodies.remove(&id)),
            Command::Discard(frame) => drop(frame),
        }
    }

    fn order(&mut self, id: BodyId, order: Order) {
        if let Some(body) = self.bodies.get_mut(&id) {
            body.order(order);
        }
    }

    /// One step of every body that has one to do. One body at a time is built.
    fn work(&mut self) {
        let mut is_building = self.bodies.values().any(Body::is_building);
        for (&id, body) in &mut self.bodies {
            let news = match body.is_waiting() {
                true if is_building => None,
                true => {
                    is_building = true;
                    body.start()
                }
                false => body.work(),
            };
            if let Some(news) = news {
                // If this fails, the main thread has ended, and the channel of commands is closed.
                let _ = self.news.send((id, news));
            }
        }
    }
}

/// Lets threads that draw go first where there are fewer processors than threads: on Linux a thread of the policy "batch" interrupts no other when
/// it is woken, and this one gets less time besides. rayon's threads inherit both. Without the right to do so, all stay equal.
fn give_way() {
    #[cfg(target_os = "linux")] // elsewhere this would concern the whole process, or need rights
    {
        use thread_priority::{NormalThreadSchedulePolicy, ThreadPriority, ThreadSchedulePolicy, unix};
        let policy = ThreadSchedulePolicy::Normal(NormalThreadSchedulePolicy::Batch);
        let priority = PRIORITY.try_into().map_or(ThreadPriority::Min, ThreadPriority::Crossplatform);
        let _ = unix::set_thread_priority_and_policy(unix::thread_native_id(), priority, policy);
    }
}
