//! Newton's method with pressures as unknowns beside the displacements: a saddle point of the Lagrangian, lowest in the displacements and highest in
//! the pressures.
//!
//! A direction (d, q) solves A d + Bᵀ q = −∂L/∂u, B d − C q = −(∫ N θ − C p). The pressures take all of q. The augmented Lagrangian at the new
//! ones, L + ρ/2 |∫ N θ − C p|², decreases along d: its slope is −dᵀ A d − ρ |B d|².

use fem_model::Projection;
use fem_model::simulation::{Breakdown, Cause, Counters, History};

use super::incremental_potential::IncrementalPotential;
use super::{Convergence, Iterate, Newton};
use crate::forces::{CornerPressures, Energy, HessianKind};
use crate::model::system::System;
use fem_elements::history::{put, put_flag, take, take_flag};
use fem_elements::sparse::{Block, Pattern};
use fem_elements::vector::{dot, max_norm, norm};
use fem_solvers::{Ldlt, Real};

/// Largest volume that may be left at a corner, relative to its own: rounding error of the displacements times a few.
const LEFT: f64 = 1e-12;

/// Relative residual of the linear equations.
const RESIDUAL: f64 = 1e-7;

/// The matrix of displacements and pressures, and its factor.
pub(super) struct SaddlePoint {
    factor: Ldlt,
    /// Row of the first coordinate of each node that is not fully constrained, and of each pressure: a pressure follows its node, whose neighbours
    /// it shares.
    rows: Vec<u32>,
    of_pressures: Vec<u32>,
    /// Derivatives of the volumes of corners by coordinates of nodes, and their corners and nodes.
    coupling: Vec<f64>,
    coupled: Vec<(u32, u32)>,
    /// 1 where a coordinate is free, 0 where it is constrained.
    free: Vec<[f64; 3]>,
    /// Unit of the pressures, Pa/m.
    scale: f64,
    solution: Vec<f64>,
    /// The values of the matrix that the factor belongs to; empty without a factor.
    factored: Vec<f64>,
}

impl SaddlePoint {
    /// Analyses the matrix of a body.
    pub(super) fn new<T: Real>(system: &System<T>, mixed: &CornerPressures) -> Self {
        let pattern = &system.pattern;
        let coupled: Vec<(u32, u32)> = mixed.couplings().map(|(corner, node)| (corner, node as u32)).collect();
        let (rows, of_pressures) = rows(pattern.rows() as u32, mixed.nodes(), &coupled);
        let of_displacements = lower_entries(pattern, &rows).map(|(_, _, _, place)| place);
        let stored = coupled.iter().filter(|(_, node)| (*node as usize) < rows.len());
        let of_coupling = stored
            .flat_map(|&(corner, node)| [0, 1, 2].map(|i| [of_pressures[corner as usize], rows[node as usize] + i]));
        let of_compliance = mixed.compliance().map(|(place, _)| place.map(|corner| of_pressures[corner as usize]));
        let places: Vec<[u32; 2]> = of_displacements.chain(of_coupling).chain(of_compliance).collect();
        let size = 3 * pattern.rows() + mixed.count();
        Self {
            factor: Ldlt::new(size, &places),
            coupling: vec![0.0; 3 * coupled.len()],
            rows,
            of_pressures,
            coupled,
            free: Vec::new(),
            scale: mixed.scale(),
            solution: vec![0.0; size],
            factored: Vec::new(),
        }
    }

    /// Evaluates the coupling of displacements and pressures at u.
    fn couple<T: Real>(&mut self, system: &System<T>, mixed: &CornerPressures, u: &[[T; 3]]) {
        let mut free = vec![[T::one(); 3]; system.nodes()];
        system.dirichlet.clear_constrained(&mut free);
        self.free = free.into_iter().map(|of| of.map(T::as_f64)).collect();
        let mut coupling = self.coupling.chunks_exact_mut(3);
        mixed.coupling(u, |of| coupling.next().into_iter().for_each(|place| place.copy_from_slice(of.as_slice())));
    }

    /// Sets the matrix.
    fn set<T: Real>(&mut self, pattern: &Pattern, A: &[Block<T, 3>], mixed: &CornerPressures) {
        let Self { factor, coupling, coupled, free, scale, rows, .. } = self;
        let of_displacements = lower_entries(pattern, rows).map(|(block, i, j, _)| A[block][i][j].as_f64());
        let stored =
            coupled.iter().zip(coupling.chunks_exact(3)).filter(|((_, node), _)| (*node as usize) < rows.len());
        let of_coupling =
            stored.flat_map(|((_, node), of)| [0, 1, 2].map(|i| *scale * free[*node as usize][i] * of[i]));
        let of_pressures = mixed.compliance().map(|(_, entry)| -*scale * *scale * entry);
        factor.set(of_displacements.chain(of_coupling).chain(of_pressures));
    }

    /// Factors the matrix. An error, if the displacements at which the volumes of all corners stay have no minimum.
    fn factor(&mut self) -> Result<(), Breakdown> {
        self.factored.clear();
        let positive = self.factor.factor()?;
        self.factored.extend_from_slice(self.factor.values());
        if positive == 3 * self.rows.len() { Ok(()) } else { Err(Breakdown::NotPositiveDefinite) }
    }

    /// Allocated bytes.
    pub(super) fn bytes(&self) -> usize {
        self.factor.bytes()
            + size_of_val(&self.coupling[..])
            + size_of_val(&self.coupled[..])
            + size_of_val(&self.rows[..])
            + size_of_val(&self.of_pressures[..])
            + size_of_val(&self.solution[..])
    }

    /// Adds the matrix of the kept factor to a history.
    pub(super) fn save(&self, history: &mut History) {
        put_flag(history, "newton.is_saddle_point_kept", !self.factored.is_empty());
        if !self.factored.is_empty() {
            put(history, "newton.saddle_point", &self.factor.to_columns(&self.factored));
        }
    }

    /// Restores the factor of the matrix that [`save`](Self::save) has added.
    pub(super) fn restore(&mut self, history: &History) -> Result<(), String> {
        self.factored.clear();
        if take_flag(history, "newton.is_saddle_point_kept")? {
            let mut values = vec![0.0; self.factor.values().len()];
            take(history, "newton.saddle_point", &mut values)?;
            self.factor.set_columns(&values);
            self.factor().map_err(|breakdown| breakdown.to_string())?;
        }
        Ok(())
    }

    /// Solves for d and q with the right-hand sides of the displacements, N, and of the pressures, m³. Returns the relative residual.
    fn solve<T: Real>(&mut self, right: &[[T; 3]], of_pressures: &[f64], d: &mut [[T; 3]], q: &mut Vec<f64>) -> f64 {
        let Self { factor, rows, of_pressures: of_corners, scale, solution: x, .. } = self;
        for (&row, right) in rows.iter().zip(right) {
            (0..3).for_each(|i| x[row as usize + i] = right[i].as_f64());
        }
        of_corners.iter().zip(of_pressures).for_each(|(&row, right)| x[row as usize] = *scale * right);
        let residual = factor.solve(x, RESIDUAL);
        d.fill([T::default(); 3]);
        for (&row, d) in rows.iter().zip(d) {
            (0..3).for_each(|i| d[i] = T::of(x[row as usize + i]));
        }
        q.clear();
        q.extend(of_corners.iter().map(|&row| *scale * x[row as usize]));
        residual
    }

    /// B d for prescribed displacements d, m³.
    fn volumes_of<T: Real>(&self, d: &[[T; 3]], count: usize) -> Vec<f64> {
        let mut volumes = vec![0.0; count];
        for ((corner, node), of) in self.coupled.iter().zip(self.coupling.chunks_exact(3)) {
            let d = d[*node as usize];
            volumes[*corner as usize] += (0..3).map(|i| of[i] * d[i].as_f64()).sum::<f64>();
        }
        volumes
    }
}

/// Rows of the first coordinates of nodes and of pressures, given the node of each pressure, and pairs of pressures and nodes. The pressure of a fully
/// constrained node follows the last of its neighbours.
fn rows(free: u32, nodes: &[u32], coupled: &[(u32, u32)]) -> (Vec<u32>, Vec<u32>) {
    let mut after: Vec<Option<u32>> = nodes.iter().map(|&node| (node < free).then_some(node)).collect();
    let is_constrained: Vec<bool> = after.iter().map(Option::is_none).collect();
    for &(corner, node) in coupled.iter().filter(|(corner, node)| is_constrained[*corner as usize] && *node < free) {
        let last = &mut after[corner as usize];
        *last = (*last).max(Some(node));
    }
    let mut order: Vec<(u32, usize)> =
        after.into_iter().enumerate().map(|(pressure, after)| (after.unwrap_or_default(), pressure)).collect();
    order.sort_unstable();
    let (mut rows, mut of_pressures) = (Vec::new(), vec![0; nodes.len()]);
    let (mut next, mut left) = (0, order.into_iter().peekable());
    for node in 0..free.max(1) {
        if node < free {
            rows.push(next);
            next += 3;
        }
        while let Some((_, pressure)) = left.next_if(|(after, _)| *after <= node) {
            of_pressures[pressure] = next;
            next += 1;
        }
    }
    (rows, of_pressures)
}

/// The matrix of an iteration, and its factor.
#[derive(Clone, Copy, PartialEq)]
enum Matrix {
    /// The exact one, with the factor of an earlier one.
    Kept,
    /// The exact one.
    Exact,
    /// The one projected element by element.
    Projected,
}

/// The entries of the lower half of a block matrix whose blocks begin at these rows: block, row and column in it, and their place.
fn lower_entries(pattern: &Pattern, rows: &[u32]) -> impl Iterator<Item = (usize, usize, usize, [u32; 2])> {
    let blocks = (0..pattern.rows()).flat_map(|row| pattern.row(row).map(move |block| (row, block)));
    blocks.flat_map(move |(row, block)| {
        let (row, column) = (rows[row], rows[pattern.columns[block] as usize]);
        let entries = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
        let entries = entries.map(move |(i, j)| (block, i, j, [row + i as u32, column + j as u32]));
        entries.filter(|(.., [row, column])| row >= column)
    })
}

/// Sets the pressures at which energies are evaluated, and returns to those that displacements cause at the end.
struct Iteration<'a>(&'a CornerPressures);

impl Drop for Iteration<'_> {
    fn drop(&mut self) {
        self.0.set_iteration(None);
    }
}

impl<T: Real> Newton<T> {
    /// Moves w to the saddle point, from w itself.
    pub(super) fn find_saddle_point(
        &mut self,
        potential: &IncrementalPotential<T>,
        mixed: &CornerPressures,
        energy: Energy,
        w: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        self.forget();
        // Those of a guess, which changes the volume, would be far off.
        let mut pressures = mixed.pressures_of(potential.increment.start);
        let iteration = Iteration(mixed);
        let norm = norm(&self.gradient);
        let mut at =
            Iterate { energy, size: f64::INFINITY, left_out: 0.0, rate: None, norms: (norm, norm), forcing: 0.0 };
        let tolerance = self.limits.tolerance * potential.system.length;
        let scale = potential.system.forces.smallest_scale();
        let mut before = f64::INFINITY;
        for _ in 0..self.limits.max_iterations {
            if at.norms.0 == 0.0 {
                return Ok(Convergence::Converged);
            }
            counters.newton_iterations += 1;
            let moved = self.iterate_with_pressures(potential, mixed, &mut pressures, (w, &mut at), counters)?;
            self.workspace.set_u(potential.increment.start, w);
            let left = mixed.relative(&mixed.left(&self.workspace.u, &pressures));
            let is_settled = at.remaining_update(scale) <= tolerance && (left <= LEFT || left >= 0.5 * before);
            if !moved || is_settled {
                drop(iteration);
                // The terms of the last evaluation are those of the solution.
                potential.energy_and_gradient(w, &mut self.gradient, &mut self.workspace);
                return Ok(Convergence::Converged);
            }
            before = left;
        }
        Ok(Convergence::NotConverged)
    }

    /// One iteration. Returns false where rounding error allows no further decrease.
    fn iterate_with_pressures(
        &mut self,
        potential: &IncrementalPotential<T>,
        mixed: &CornerPressures,
        pressures: &mut Vec<f64>,
        (w, at): (&mut [[T; 3]], &mut Iterate),
        counters: &mut Counters,
    ) -> Result<bool, Cause> {
        let mut q = Vec::new();
        for matrix in [Matrix::Kept, Matrix::Exact, Matrix::Projected] {
            mixed.set_iteration(Some(pressures.clone()));
            if !self.prepare_with_pressures(potential, mixed, w, matrix, counters)? {
                continue;
            }
            let is_solved = self.solve_with_pressures(potential, mixed, pressures, w, &mut q, counters);
            let moved: Vec<f64> = pressures.iter().zip(&q).map(|(p, q)| p + q).collect();
            mixed.set_iteration(Some(moved.clone()));
            counters.energy_evaluations += 1;
            counters.force_assemblies += 1;
            at.energy = potential.energy_and_gradient(w, &mut self.gradient, &mut self.workspace);
            let derivative = if is_solved { dot(&self.gradient, &self.direction) } else { f64::NAN };
            if derivative < 0.0
                && let Some(length) = self.line_search(potential, w, at, derivative, counters)
            {
                self.accept(w, at, length);
                *pressures = moved;
                return Ok(true);
            }
        }
        self.check_stationary(potential, at)
    }

    /// Writes the direction, and that of the pressures into `q`. Returns whether the equations are solved.
    fn solve_with_pressures(
        &mut self,
        potential: &IncrementalPotential<T>,
        mixed: &CornerPressures,
        pressures: &[f64],
        w: &[[T; 3]],
        q: &mut Vec<f64>,
        counters: &mut Counters,
    ) -> bool {
        counters.force_assemblies += 1;
        potential.energy_and_gradient(w, &mut self.gradient, &mut self.workspace);
        let left = mixed.left(&self.workspace.u, pressures);
        // The gradient is that of the Lagrangian at pressures p + ρ (∫ N θ − C p).
        let ahead: Vec<f64> = left.iter().zip(mixed.penalty()).map(|(left, penalty)| penalty * left).collect();
        let right: Vec<f64> = left.iter().zip(mixed.compliance_times(&ahead)).map(|(left, of)| of - left).collect();
        for (right, g) in self.right.iter_mut().zip(&self.gradient) {
            *right = g.map(|g| -g);
        }
        let Self { solver, saddle_point, right: of_displacements, direction, .. } = self;
        let Some(saddle_point) = saddle_point else { return false };
        let residual = solver.timers().1.time(|| saddle_point.solve(of_displacements, &right, direction, q));
        q.iter_mut().zip(ahead).for_each(|(q, ahead)| *q += ahead);
        residual <= RESIDUAL
    }

    /// Assembles the Hessian at w with the coupling, and factors it if the factor is not a kept one; the projected one with a growing shift of its
    /// diagonal until that succeeds. Returns false where the matrix cannot be factored, is not wanted, or there is no kept factor.
    fn prepare_with_pressures(
        &mut self,
        potential: &IncrementalPotential<T>,
        mixed: &CornerPressures,
        w: &[[T; 3]],
        matrix: Matrix,
        counters: &mut Counters,
    ) -> Result<bool, Cause> {
        let Some(saddle_point) = &mut self.saddle_point else { return Ok(false) };
        let (system, is_projected) = (potential.system, matrix == Matrix::Projected);
        let left_out = if is_projected { Projection::Never } else { Projection::Always };
        if self.limits.projection == left_out || matrix == Matrix::Kept && saddle_point.factored.is_empty() {
            return Ok(false);
        }
        let kind = if is_projected { HessianKind::Projected } else { HessianKind::Exact };
        potential.hessian(w, kind, &mut self.values, &mut self.workspace);
        counters.stiffness_assemblies += 1;
        if is_projected {
            counters.projections += system.elements.count();
        }
        saddle_point.couple(system, mixed, &self.workspace.u);
        saddle_point.set(&system.pattern, &self.values, mixed);
        if matrix == Matrix::Kept {
            return Ok(true);
        }
        let diagonal: Vec<usize> = system.pattern.diagonal().collect();
        let entries = diagonal.iter().flat_map(|&block| (0..3).map(move |i| (block, i)));
        let largest = entries.map(|(block, i)| self.values[block][i][i].as_f64().abs()).fold(0.0, f64::max);
        let mut shift = 1e-8 * largest;
        loop {
            counters.factorizations += 1;
            match self.solver.timers().0.time(|| saddle_point.factor()) {
                Ok(()) => return Ok(true),
                Err(breakdown) if breakdown.is_of_machine() => return Err(Cause::Solver(breakdown)),
                Err(_) if !is_projected => return Ok(false),
                // NaN fails the comparison.
                Err(_) if !(shift <= 1e4 * largest) => {
                    return Err(Cause::Stuck { unbalanced: max_norm(&self.gradient) });
                }
                Err(_) => {}
            }
            for &block in &diagonal {
                (0..3).for_each(|i| self.values[block][i][i] += T::of(shift));
            }
            saddle_point.set(&system.pattern, &self.values, mixed);
            shift *= 10.0;
        }
    }

    /// The same as [`predict`](Self::predict) with pressures: the increment of a linear body with the prescribed displacements.
    pub(super) fn predict_with_pressures(
        &mut self,
        potential: &IncrementalPotential<T>,
        mixed: &CornerPressures,
        prescribed: &[[T; 3]],
        w: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let is_prepared = self.prepare_with_pressures(potential, mixed, w, Matrix::Exact, counters)?
            || self.prepare_with_pressures(potential, mixed, w, Matrix::Projected, counters)?;
        potential.linearized_gradient(prescribed, &mut self.gradient, &mut self.workspace);
        for (right, g) in self.right.iter_mut().zip(&self.gradient) {
            *right = g.map(|g| -g);
        }
        let Self { saddle_point, right, .. } = self;
        let Some(saddle_point) = saddle_point.as_mut().filter(|_| is_prepared) else {
            return Err(Cause::Solver(Breakdown::NotPositiveDefinite));
        };
        // At the start the displacements belong to the pressures.
        let volumes: Vec<f64> =
            saddle_point.volumes_of(prescribed, mixed.count()).iter().map(|volume| -volume).collect();
        if saddle_point.solve(right, &volumes, w, &mut Vec::new()) > RESIDUAL {
            return Err(Cause::Solver(Breakdown::Singular));
        }
        potential.system.dirichlet.copy_constrained(prescribed, w);
        Ok(())
    }
}
