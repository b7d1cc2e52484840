//! The second derivative of the incremental potential: assembled here, or as the parts of which a solver assembles it.

use super::incremental_potential::{IncrementalPotential, StepEnd, Workspace};
use crate::forces::{HessianKind, Potential};
use crate::model::damping::DampingRates;
use fem_elements::sparse::Block;
use fem_elements::vector::clear;
use fem_solvers::{Assembly, Real};

impl<T: Real> IncrementalPotential<'_, T> {
    /// ∂²E/∂w², N/m.
    pub fn hessian(&self, w: &[[T; 3]], kind: HessianKind, values: &mut [Block<T, 3>], workspace: &mut Workspace<T>) {
        let system = self.system;
        workspace.set_u(self.increment.start, w);
        clear(values.as_flattened_mut());
        for (factor, u) in self.stiffness(&workspace.u) {
            system.add_stiffness_of_elements(factor, u, kind, values);
        }
        self.add_hessians_of_forces(w, kind, values, workspace);
        if let Some(mass) = self.factor_of_mass() {
            system.profile.mass.time(|| system.mass.add_to(mass, &system.pattern, values));
        }
        system.dirichlet.eliminate(&system.pattern, values);
    }

    /// Passes the parts of ∂²E/∂w² to `work`, which assembles them on the device of the solver. `values` is scratch space.
    pub fn with_sum<R>(
        &self,
        w: &[[T; 3]],
        values: &mut [Block<T, 3>],
        workspace: &mut Workspace<T>,
        work: impl FnOnce(&Assembly<T>) -> R,
    ) -> R {
        let system = self.system;
        workspace.set_u(self.increment.start, w);
        let others = self.blocks_of_forces(w, values, workspace);
        workspace.difference.fill([T::one(); 3]);
        system.dirichlet.clear_constrained(&mut workspace.difference);
        let stiffness: Vec<_> = self.stiffness(&workspace.u).collect();
        let sum = Assembly {
            stiffness: &stiffness,
            mass: self.factor_of_mass().unwrap_or_default(),
            others: &others,
            free: &workspace.difference,
        };
        system.profile.stiffness.time(|| work(&sum))
    }

    /// The blocks that are not zero in the Hessians and damping matrices of all forces, with their numbers. `values` is scratch space.
    fn blocks_of_forces(
        &self,
        w: &[[T; 3]],
        values: &mut [Block<T, 3>],
        workspace: &mut Workspace<T>,
    ) -> Vec<(usize, Block<T, 3>)> {
        let Self { system, .. } = self;
        let pattern = &system.pattern;
        let has_damped_elements = self.damped().is_some_and(|(rates, _)| rates.stiffness != T::zero());
        let of_forces = system.forces.nodes_of_hessians();
        let nodes = of_forces.filter(|_| !has_damped_elements || system.damps_by_stiffness());
        let nodes = nodes.unwrap_or_else(|| (0..pattern.rows() as u32).collect());
        if nodes.is_empty() {
            return Vec::new();
        }
        let rows = nodes.into_iter().filter(|&node| (node as usize) < pattern.rows());
        let blocks: Vec<usize> = rows.flat_map(|row| pattern.row(row as usize)).collect();
        blocks.iter().for_each(|&block| values[block] = Block::default());
        self.add_hessians_of_forces(w, HessianKind::Exact, values, workspace);
        system.dirichlet.eliminate(pattern, values);
        let is_nonzero = |block: &Block<T, 3>| block.as_flattened().iter().any(|entry| *entry != T::zero());
        blocks.into_iter().map(|block| (block, values[block])).filter(|(_, values)| is_nonzero(values)).collect()
    }

    /// Factors of the stiffness of the elements in the Hessian at u, and the displacements at which it is taken.
    fn stiffness<'b>(&'b self, u: &'b [[T; 3]]) -> impl Iterator<Item = (T, &'b [[T; 3]])> {
        let is_damping = |rates: &DampingRates<T>| rates.stiffness != T::zero() && self.system.damps_by_stiffness();
        let damped = self.damped().filter(|(rates, _)| is_damping(rates));
        std::iter::once((T::one(), u)).chain(damped.map(|(rates, u)| (rates.stiffness, u)))
    }

    /// The rates of damping, and the displacements at which it takes its matrices.
    fn damped(&self) -> Option<(DampingRates<T>, &[[T; 3]])> {
        let inertia = self.increment.inertia.as_ref()?;
        Some((inertia.damping?, inertia.stiffness_at.unwrap_or(self.increment.start)))
    }

    fn factor_of_mass(&self) -> Option<T> {
        let inertia = self.increment.inertia.as_ref()?;
        Some(inertia.over_dt2 + inertia.damping.map_or(T::default(), |rates| rates.mass))
    }

    /// Adds the Hessians of all forces but the elements' own, and the damping matrices that are no multiples of those.
    fn add_hessians_of_forces(
        &self,
        w: &[[T; 3]],
        kind: HessianKind,
        values: &mut [Block<T, 3>],
        workspace: &mut Workspace<T>,
    ) {
        let system = self.system;
        system.add_internal_hessian(T::one(), &workspace.u, kind, values);
        if let Some((rates, u)) = self.damped() {
            system.add_damping_matrix(rates, u, kind, values);
        }
        match self.end_with_obstacles() {
            None => system.add_external_hessian(&workspace.u, self.increment.end, kind, values),
            Some(StepEnd { moment, ratio, weight }) => {
                workspace.set_end(self.increment.start, ratio, w);
                let (stage, end) = ((&workspace.u[..], self.increment.end), (&workspace.end[..], moment));
                let is_load = |force: &dyn Potential<T>| !force.is_internal() && !force.is_obstacle();
                system.add_hessians_of(is_load, T::one(), stage, kind, values);
                system.add_hessians_of(|force| force.is_obstacle(), T::of(weight * ratio), end, kind, values);
            }
        }
    }
}
