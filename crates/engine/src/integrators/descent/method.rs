//! A sweep of vertex block descent: every node once, colour after colour.

use fem_model::IterationSettings;

use super::chebyshev::Chebyshev;
use super::groups::{corners, group};
use super::links::Links;
use super::nodes::NodeBatches;
use super::patches::Group;
use super::search::{Change, HALVINGS};
use super::solve::{Inertia, Steps, StepsOf, inverse_block};
use super::sums::Sums;
use crate::integrators::relaxation::{BATCHES_FOR_THREADS, CHUNK, PlaneContacts, Relaxation, StepOf, color_nodes};
use crate::model::system::System;
use fem_elements::number::Number;
use fem_elements::threads::over_parts_of_two;
use fem_solvers::Real;

/// A body whose nodes descend one after the other.
pub struct Descent<T: Real> {
    /// Displacements that inertia and dead loads alone would give, m.
    inertial: Vec<[T; 3]>,
    nodes: NodeBatches<T>,
    groups: Vec<Box<dyn Group<T>>>,
    links: Links<T>,
    acceleration: Option<Chebyshev<T>>,
    /// Of the batches of one colour.
    sums: Vec<Sums<T::Lanes>>,
    steps: Vec<Steps<T::Lanes>>,
    /// Batches whose energy is evaluated, and their steps.
    doubtful: (Vec<usize>, Vec<Change<T>>),
}

impl<T: Real> Descent<T> {
    /// The nodes of a body.
    pub fn new(settings: &IterationSettings, system: &System<T>) -> Self {
        let springs: Vec<_> = system.forces.all().flat_map(|(force, _)| force.springs()).copied().collect();
        let corners = corners(system);
        let ends = springs.iter().map(|spring| &spring.nodes[..]);
        let cliques: Vec<&[u32]> = corners.iter().map(|corners| &corners[..]).chain(ends).collect();
        let mut elements_of = vec![0; system.nodes()];
        corners.iter().flatten().for_each(|&node| elements_of[node as usize] += 1);
        let nodes = NodeBatches::new(system.nodes(), color_nodes(system.nodes(), &cliques), &elements_of);
        let groups = (0..system.elements.materials()).map(|material| group(system, material, &nodes)).collect();
        let most = nodes.largest_color();
        let nowhere = Steps { step: [T::Lanes::zero(); 3], is_doubtful: false };
        let radius = settings.acceleration.filter(|radius| *radius > 0.0);
        Self {
            inertial: vec![[T::default(); 3]; system.nodes()],
            groups,
            links: Links::new(springs, &nodes),
            acceleration: radius.map(|radius| Chebyshev::new(radius, system.nodes())),
            sums: vec![Sums::zero(); most],
            steps: vec![nowhere; most],
            doubtful: (Vec::with_capacity(most), Vec::with_capacity(most)),
            nodes,
        }
    }

    fn accelerate(&mut self, system: &System<T>, contacts: Option<&PlaneContacts>, u: &mut [[T; 3]]) {
        let Some(acceleration) = &mut self.acceleration else { return };
        let has_barriers = !system.elements.allow_inversion();
        // Contact changes the sweep: Chen et al. 2024, section 3.8.
        let stays = |node: usize| contacts.is_some_and(|contacts| contacts.touches(node));
        let is_feasible = |u: &[[T; 3]]| !has_barriers || system.elements.min_det_F_of_barriers(u).0 > T::default();
        acceleration.accelerate(u, stays, is_feasible);
    }

    /// Newton's step of each node of a colour.
    fn find_steps(&mut self, step: StepOf<T>, color: usize, u: &[[T; 3]]) {
        let Self { nodes, groups, links, sums, steps, inertial, .. } = self;
        let range = &nodes.colors[color];
        let (sums, steps) = (&mut sums[..range.len()], &mut steps[..range.len()]);
        sums.fill(Sums::zero());
        for group in groups {
            group.add_sums(step.system, nodes, range, u, sums);
        }
        links.add_sums(nodes, color, u, sums);
        let lanes = &nodes.lanes[range.start * T::WIDTH..range.end * T::WIDTH];
        let inertia = Inertia { masses: &nodes.masses[range.clone()], over_dt2: 1.0 / step.dt2, inertial };
        let solve_for = |first: usize, sums: &mut [Sums<T::Lanes>], steps: &mut [Steps<T::Lanes>]| {
            let batches = first..first + sums.len();
            let lanes = &lanes[batches.start * T::WIDTH..batches.end * T::WIDTH];
            solve(Inertia { masses: &inertia.masses[batches], ..inertia }, lanes, u, sums, steps);
        };
        if sums.len() < BATCHES_FOR_THREADS {
            solve_for(0, sums, steps);
        } else {
            over_parts_of_two((sums, steps), CHUNK, &solve_for);
        }
    }

    /// Ends the steps of a colour outside the planes. Nodes rest at the distance `skin` from a plane, m.
    fn settle_contacts(
        &mut self,
        step: StepOf<T>,
        color: usize,
        (contacts, skin): (&mut PlaneContacts, f64),
        u: &[[T; 3]],
    ) {
        let Self { nodes, sums, steps, .. } = self;
        let contact = step.of_contacts();
        let range = nodes.colors[color].clone();
        for ((batch, steps), sums) in range.zip(steps).zip(sums) {
            for (lane, &node) in nodes.of_batch(batch).iter().enumerate() {
                let node = node as usize;
                let free = [0, 1, 2].map(|i| u[node][i] + steps.step[i].lane(lane));
                if contacts.is_free(node, contact, skin, &free) {
                    continue;
                }
                let inverse = inverse_block::<T>(sums, &nodes.masses[batch], lane);
                let place = contacts.settle(node, &inverse, contact, skin, free);
                for i in 0..3 {
                    steps.step[i].set_lane(lane, place[i] - u[node][i]);
                }
            }
        }
    }

    /// Line search: shortens the steps of a colour that would increase the energy around their nodes, in lanes that need it.
    fn shorten_steps(&mut self, step: StepOf<T>, color: usize, contacts: Option<&PlaneContacts>, u: &mut [[T; 3]]) {
        let Self { nodes, groups, links, steps, doubtful: (batches, changes), inertial, .. } = self;
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
        let inertia = Inertia { masses: &nodes.masses, over_dt2: 1.0 / step.dt2, inertial };
        for halving in 0..=HALVINGS {
            for group in &mut *groups {
                group.add_changes(step.system, nodes, batches, u, changes);
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
}

impl<T: Real> Relaxation<T> for Descent<T> {
    fn has_material(&self) -> bool {
        true
    }

    fn set_masses(&mut self, inverse_masses: &[[T; 3]]) {
        self.nodes.set_masses(inverse_masses);
    }

    fn begin_step(&mut self, step: StepOf<T>, u: &[[T; 3]]) {
        self.inertial.copy_from_slice(u);
        self.links.begin_step(&step.system.forces.drag, step.times[1]);
        if let Some(acceleration) = &mut self.acceleration {
            acceleration.restart(u);
        }
    }

    fn sweep(&mut self, step: StepOf<T>, mut contacts: Option<&mut PlaneContacts>, u: &mut [[T; 3]]) {
        let skin = contacts.as_ref().map_or(0.0, |contacts| contacts.skin(u));
        for color in 0..self.nodes.colors.len() {
            step.system.profile.forces.time(|| self.find_steps(step, color, u));
            if let Some(contacts) = &mut contacts {
                self.settle_contacts(step, color, (contacts, skin), u);
            }
            self.shorten_steps(step, color, contacts.as_deref(), u);
            for (batch, steps) in self.nodes.colors[color].clone().zip(&self.steps) {
                for (lane, &node) in self.nodes.of_batch(batch).iter().enumerate() {
                    for i in 0..3 {
                        u[node as usize][i] += steps.step[i].lane(lane);
                    }
                }
            }
        }
        self.accelerate(step.system, contacts.as_deref(), u);
    }
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
        T::Single::vectorize(StepsOf::<T::Single> { inertia, lanes, u, sums, steps });
    }
}
