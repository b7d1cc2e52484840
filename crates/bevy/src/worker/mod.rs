//! Threads that simulate, as the main thread sees them: commands go there, news come back, and neither side waits for the other.

mod body;
pub mod message;
mod thread;

use std::collections::HashMap;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, PoisonError};

use bevy::ecs::entity::Entity;
use bevy::ecs::resource::Resource;

use crate::SoftBodyError;
use crate::blueprint::Blueprint;
use crate::link::{BodyId, Link};
use message::{Command, News};
use thread::Thread;

/// The worker threads. They end when this is dropped.
#[derive(Resource)]
pub struct Workers {
    threads: Vec<Worker>,
    /// The reason why a thread was not started.
    refusal: String,
    /// Not shared; the lock makes it a resource, and is never waited for.
    news: Mutex<Receiver<(BodyId, News)>>,
    entities: HashMap<BodyId, Entity>,
    next: BodyId,
}

struct Worker {
    commands: Sender<Command>,
    bodies: usize,
}

impl Workers {
    /// Starts this number of threads, at least one.
    pub fn start(threads: usize) -> Self {
        let (sender, news) = channel();
        let mut workers = Self {
            threads: Vec::new(),
            refusal: String::new(),
            news: Mutex::new(news),
            entities: HashMap::new(),
            next: 0,
        };
        for number in 0..threads.max(1) {
            let (commands, received) = channel();
            let thread = Thread::new(received, sender.clone());
            let started = std::thread::Builder::new().name(format!("soft bodies {number}")).spawn(|| thread.run());
            match started {
                Ok(_) => workers.threads.push(Worker { commands, bodies: 0 }),
                Err(error) => workers.refusal = error.to_string(),
            }
        }
        workers
    }

    /// Has a body built for an entity, on the thread with the fewest bodies.
    pub fn add(&mut self, entity: Entity, blueprint: Blueprint) -> Result<Link, SoftBodyError> {
        let emptiest = (0..self.threads.len()).min_by_key(|&thread| self.threads[thread].bodies);
        let thread = emptiest.ok_or_else(|| SoftBodyError::NoThread(self.refusal.clone()))?;
        let link = Link { id: self.next, thread };
        self.next += 1;
        self.entities.insert(link.id, entity);
        self.threads[thread].bodies += 1;
        self.send(link, Command::Add(link.id, Box::new(blueprint)));
        Ok(link)
    }

    /// Has a body forgotten.
    pub fn remove(&mut self, link: Link) {
        if self.entities.remove(&link.id).is_some() {
            self.threads[link.thread].bodies -= 1;
            self.send(link, Command::Remove(link.id));
        }
    }

    /// Sends a command to the thread of a body.
    pub fn send(&self, link: Link, command: Command) {
        // A thread ends with its channel only.
        let _ = self.threads[link.thread].commands.send(command);
    }

    /// The next news of a body that has not been removed; `None` if there are none now.
    pub fn next_news(&mut self) -> Option<(Entity, News)> {
        let news = self.news.get_mut().unwrap_or_else(PoisonError::into_inner);
        loop {
            let (id, news) = news.try_recv().ok()?;
            if let Some(&entity) = self.entities.get(&id) {
                return Some((entity, news));
            }
        }
    }
}
