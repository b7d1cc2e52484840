//! A step of vertex block descent: prediction, sweeps over all nodes, velocities.

use fem_scene::IterationSettings;
use fem_scene::simulation::{Counters, History};
use rayon::prelude::*;

use super::chebyshev::Chebyshev;
use super::coloring::color_nodes;
use super::groups::{Group, corners};
use super::links::Links;
use super::nodes::{BATCHES_FOR_THREADS, CHUNK, NodeBatches};
use super::search::{Change, HALVINGS};
use super::solve::{Inertia, Steps, StepsOf, inverse_block};
use super::sums::Sums;
use crate::forces::contact::planes::Planes;
use crate::integrators::projection::{ContactStep, Particles, PlaneContacts, largest_difference};
use crate::model::state::State;
use crate::model::system::System;
use crate::number::{Number, Real};

/// A body whose nodes descend one after the other.
pub struct Descent<T: Real> {
    count: usize,
    tolerance: Option<f64>,
    particles: Particles<T>,
    /// Displacements that inertia and dead loads alone would give, m.
    inertial: Vec<[T; 3]>,
    nodes: NodeBatches<T>,
    groups: Vec<Group<T>>,
    links: Links<T>,
    contacts: Option<PlaneContacts>,
    acceleration: Option<Chebyshev<T>>,
    /// Of the batches of one colour.
    sums: Vec<Sums<T::Lanes>>,
    steps: Vec<Steps<T::Lanes>>,
    /// Batches of which the energy is asked, and their steps.
    doubtful: (Vec<usize>, Vec<Change<T>>),
    /// Displacements before a sweep, m; empty where no tolerance is asked for.
    before: Vec<[T; 3]>,
    /// Whether the masses are those of the Dirichlet conditions that apply now.
    has_masses: bool,
}

/// A sweep in a step that starts and ends at these times, s.
#[derive(Clone, Copy)]
struct SweepOf<'a, T: Real> {
    system: &'a System<T>,
    over_dt2: f64,
    times: [f64; 2],
    /// Distance from planes at which nodes rest, m.
    skin: f64,
}

impl<T: Real> Descent<T> {
    /// The nodes of a body. A step takes `settings.count` sweeps, or fewer where the relative change of the velocity falls below the
    /// tolerance.
    pub fn new(settings: &IterationSettings, system: &System<T>, planes: Option<&Planes>) -> Self {
        let springs: Vec<_> = system.forces.all().flat_map(|(force, _)| force.springs()).copied().collect();
        let corners = corners(system);
        let ends = springs.iter().map(|spring| &spring.nodes[..]);
        let cliques: Vec<&[u32]> = corners.iter().map(|corners| &corners[..]).chain(ends).collect();
        let mut elements_of = vec![0; system.nodes()];
        corners.iter().flatten().for_each(|&node| elements_of[node as usize] += 1);
        let nodes = NodeBatches::new(system.nodes(), color_nodes(system.nodes(), &cliques), &elements_of);
        let groups = (0..system.elements.materials()).map(|material| Group::new(system, material, &nodes)).collect();
        let (most, zero) = (nodes.largest_color(), vec![[T::default(); 3]; system.nodes()]);
        let nowhere = Steps { step: [T::Lanes::zero(); 3], is_doubtful: false };
        let radius = settings.acceleration.filter(|radius| *radius > 0.0);
        Self {
            count: settings.count,
            tolerance: settings.tolerance,
            particles: Particles::new(system),
            inertial: zero.clone(),
            groups,
            links: Links::new(springs, &nodes),
            contacts: planes.map(|planes| PlaneContacts::new(planes.clone(), system.length)),
            acceleration: radius.map(|radius| Chebyshev::new(radius, system.nodes())),
            sums: vec![Sums::zero(); most],
            steps: vec![nowhere; most],
            doubtful: (Vec::with_capacity(most), Vec::with_capacity(most)),
            before: if settings.tolerance.is_some() { zero } else { Vec::new() },
            has_masses: false,
            nodes,
        }
    }

    /// Advances displacements and velocities by one step of `dt` seconds.
    pub fn step(&mut self, system: &System<T>, state: &mut State<T>, dt: f64, counters: &mut Counters) {
        if !self.has_masses {
            self.particles.set_masses(system);
            self.nodes.set_masses(&self.particles.inverse_masses);
            self.has_masses = true;
        }
        let dt2 = self.particles.predict(system, state, dt);
        let times = [state.time, state.time + dt];
        self.inertial.copy_from_slice(&state.u);
        self.links.begin_step(&system.forces.anchors, times[1]);
        if let Some(contacts) = &mut self.contacts {
            contacts.begin_step(dt2);
        }
        if let Some(acceleration) = &mut self.acceleration {
            acceleration.restart(&state.u);
        }
        for _ in 0..self.count {
            counters.solver_iterations += 1;
            if self.tolerance.is_some() {
                self.before.copy_from_slice(&state.u);
            }
            let skin = self.contacts.as_ref().map_or(0.0, |contacts| contacts.skin(&state.u));
            self.sweep(SweepOf { system, over_dt2: 1.0 / dt2, times, skin }, &mut state.u);
            self.accelerate(system, &mut state.u);
            if self.tolerance.is_some_and(|tolerance| self.has_settled(&state.u, tolerance)) {
                break;
            }
        }
        let Self { particles, contacts, .. } = self;
        if let Some(contacts) = contacts {
            contacts.end_step(contact_step(particles, times), &mut state.u);
        }
        particles.finish(state, dt);
    }

    fn accelerate(&mut self, system: &System<T>, u: &mut [[T; 3]]) {
        let Self { acceleration: Some(acceleration), contacts, .. } = self else { return };
        let has_barriers = !system.elements.allow_inversion();
        // Contact makes the sweep another one: Chen et al. 2024, section 3.8.
        let stays = |node: usize| contacts.as_ref().is_some_and(|contacts| contacts.touches(node));
        let is_feasible = |u: &[[T; 3]]| !has_barriers || system.elements.min_det_F_of_barriers(u).0 > T::default();
        acceleration.accelerate(u, stays, is_feasible);
    }

    /// Moves every node once, colour after colour.
    fn sweep(&mut self, of: SweepOf<T>, u: &mut [[T; 3]]) {
        for color in 0..self.nodes.colors.len() {
            of.system.profile.forces.time(|| self.find_steps(of, color, u));
            self.settle_contacts(of, color, u);
            self.shorten_steps(of, color, u);
            for (batch, steps) in self.nodes.colors[color].clone().zip(&self.steps) {
                for (lane, &node) in self.nodes.of_batch(batch).iter().enumerate() {
                    for i in 0..3 {
                        u[node as usize][i] += steps.step[i].lane(lane);
                    }
                }
            }
        }
    }

    /// Newton's step of each node of a colour.
    fn find_steps(&mut self, of: SweepOf<T>, color: usize, u: &[[T; 3]]) {
        let Self { nodes, groups, links, sums, steps, inertial, .. } = self;
        let range = &nodes.colors[color];
        let (sums, steps) = (&mut sums[..range.len()], &mut steps[..range.len()]);
        sums.fill(Sums::zero());
        for group in groups {
            group.add_sums(of.system, nodes, range, u, sums);
        }
        links.add_sums(nodes, color, u, sums);
        let lanes = &nodes.lanes[range.start * T::WIDTH..range.end * T::WIDTH];
        let inertia = Inertia { masses: &nodes.masses[range.clone()], over_dt2: of.over_dt2, inertial };
        if sums.len() < BATCHES_FOR_THREADS {
            solve(inertia, lanes, u, sums, steps);
        } else {
            let sums = sums.par_chunks_mut(CHUNK).zip(steps.par_chunks_mut(CHUNK));
            let of_chunks = lanes.par_chunks(CHUNK * T::WIDTH).zip(inertia.masses.par_chunks(CHUNK));
            sums.zip(of_chunks).for_each(|((sums, steps), (lanes, masses))| {
                solve(Inertia { masses, ..inertia }, lanes, u, sums, steps);
            });
        }
    }

    /// Lets the steps of a colour end outside the planes.
    fn settle_contacts(&mut self, of: SweepOf<T>, color: usize, u: &[[T; 3]]) {
        let Self { nodes, contacts: Some(contacts), particles, sums, steps, .. } = self else { return };
        let contact = contact_step(particles, of.times);
        let range = nodes.colors[color].clone();
        for ((batch, steps), sums) in range.zip(steps).zip(sums) {
            for (lane, &node) in nodes.of_batch(batch).iter().enumerate() {
                let node = node as usize;
                let free = [0, 1, 2].map(|i| u[node][i] + steps.step[i].lane(lane));
                if contacts.is_free(node, contact, of.skin, &free) {
                    continue;
                }
                let inverse = inverse_block::<T>(sums, &nodes.masses[batch], lane);
                let place = contacts.settle(node, &inverse, contact, of.skin, free);
                for i in 0..3 {
                    steps.step[i].set_lane(lane, place[i] - u[node][i]);
                }
            }
        }
    }

    /// Shortens the steps of a colour with which the energy around their nodes would rise, where Newton's method is in doubt.
    fn shorten_steps(&mut self, of: SweepOf<T>, color: usize, u: &mut [[T; 3]]) {
        let Self { nodes, groups, links, steps, doubtful: (batches, changes), inertial, contacts, .. } = self;
        let range = nodes.colors[color].clone();
        batches.clear();
        changes.clear();
        for (batch, steps) in range.clone().zip(&*steps).filter(|(_, steps)| steps.is_doubtful) {
            batches.push(batch);
            changes.push(Change::of(steps.step));
        }
        if batches.is_empty() {
            return;
        }
        let inertia = Inertia { masses: &nodes.masses, over_dt2: of.over_dt2, inertial };
        for halving in 0..=HALVINGS {
            for group in &mut *groups {
                group.add_changes(of.system, nodes, batches, u, changes);
            }
            links.add_changes(nodes, color, batches, u, changes);
            let mut has_changed = false;
            for (&batch, change) in batches.iter().zip(&mut *changes) {
                change.add_inertia(inertia, batch, nodes.of_batch(batch), u);
                if let Some(contacts) = contacts {
                    change.add_work(nodes.of_batch(batch), |node| contacts.force_on(node));
                }
                has_changed |= change.shorten(halving == HALVINGS);
            }
            if !has_changed {
                break;
            }
        }
        for (&batch, change) in batches.iter().zip(&*changes) {
            steps[batch - range.start].step = change.step;
        }
    }

    fn has_settled(&self, u: &[[T; 3]], tolerance: f64) -> bool {
        largest_difference(u, &self.before) <= tolerance * self.particles.largest_increment(u)
    }

    /// The conditions that apply, or a parameter, have changed.
    pub fn forget(&mut self) {
        self.has_masses = false;
        if let Some(contacts) = &mut self.contacts {
            contacts.begin_step(1.0);
        }
    }

    /// Contacts with planes, where the scene has some.
    pub fn contacts(&self) -> Option<&PlaneContacts> {
        self.contacts.as_ref()
    }

    /// Adds what reports take from the last step.
    pub fn save(&self, history: &mut History) {
        if let Some(contacts) = &self.contacts {
            contacts.save(history);
        }
    }

    /// Takes over what [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        self.contacts.as_mut().map_or(Ok(()), |contacts| contacts.restore(history))
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        let of_nodes = 12 * size_of::<T>() * self.inertial.len() + size_of_val(&self.before[..]) + self.nodes.bytes();
        let of_color = size_of_val(&self.sums[..]) + size_of_val(&self.steps[..]);
        let of_contacts = self.contacts.as_ref().map_or(0, |contacts| contacts.bytes());
        let of_acceleration = self.acceleration.as_ref().map_or(0, |acceleration| acceleration.bytes());
        let of_groups: usize = self.groups.iter().map(|group| group.bytes()).sum();
        of_groups + of_nodes + of_color + of_contacts + of_acceleration + self.links.bytes()
    }
}

fn contact_step<T: Real>(particles: &Particles<T>, times: [f64; 2]) -> ContactStep<'_, T> {
    ContactStep { start: &particles.start, inverse_masses: &particles.inverse_masses, times }
}

/// Finds the steps of some batches of one colour, in the widest lanes of this processor.
fn solve<T: Real>(
    inertia: Inertia<T>,
    lanes: &[u32],
    u: &[[T; 3]],
    sums: &mut [Sums<T::Lanes>],
    steps: &mut [Steps<T::Lanes>],
) {
    if T::has_fast() {
        T::Fast::vectorize(StepsOf::<T::Fast> { inertia, lanes, u, sums, steps });
    } else {
        T::Lanes::vectorize(StepsOf::<T::Lanes> { inertia, lanes, u, sums, steps });
    }
}
