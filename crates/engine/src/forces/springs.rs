//! Springs between nodes, each with a damper beside it: those of `[[springs]]`, and the edges of a mass-spring body
//! ([`mass_spring`](super::mass_spring)).

use fem_model::Body;

use super::potential::add_block;
pub use super::spring::Spring;
use super::{AddBlock, Damped, Energy, HessianKind, Moment, Potential};
use fem_elements::number::is_positive;
use fem_elements::sparse::{Block, Pattern};
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// Key in the statistics.
pub const NAME: &str = "springs";

/// Springs of one table of the scene.
pub struct Springs<T> {
    source: Source,
    springs: Vec<Spring<T>>,
    has_dampers: bool,
    /// Places of the blocks (a, a), (b, b), (a, b) and (b, a) of each spring in the matrix, [`NOT_STORED`] where it has none; empty
    /// without a matrix.
    places: Vec<[u32; 4]>,
}

/// The table that springs come from.
pub struct Source {
    /// Key in the statistics.
    pub name: &'static str,
    /// The scene's table, for messages.
    pub table: &'static str,
    /// One line for `--explain`.
    pub description: String,
}

const NOT_STORED: u32 = u32::MAX;

/// The springs of `[[springs]]`; `None` if the body has none.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    if body.springs.is_empty() {
        return None;
    }
    let description = format!("[[springs]]: {} of them", body.springs.len());
    let source = Source { name: NAME, table: "springs", description };
    Some(Box::new(Springs::new(source, body, &body.springs, numbering)))
}

impl<T: Real> Springs<T> {
    /// Springs between nodes of a body's mesh.
    pub fn new(source: Source, body: &Body, springs: &[fem_model::Spring], numbering: &Numbering) -> Self {
        let mut springs: Vec<_> = springs.iter().map(|spring| Spring::new(body, spring, numbering)).collect();
        // Neighbours in memory are neighbours in the body.
        springs.sort_by_key(|spring| spring.nodes);
        let has_dampers = springs.iter().any(|spring| spring.damping != T::zero());
        Self { source, springs, has_dampers, places: Vec::new() }
    }

    /// Adds `factor` times a block of each spring, H at (a, a) and (b, b) and −H beside the diagonal, to a matrix.
    fn add_blocks(&self, factor: T, values: &mut [Block<T, 3>], block: impl Fn(&Spring<T>) -> Block<T, 3>) {
        assert_eq!(self.places.len(), self.springs.len(), "the pattern is set before matrices are assembled");
        for (spring, places) in self.springs.iter().zip(&self.places) {
            let H = block(spring);
            for (&place, sign) in places.iter().zip([factor, factor, -factor, -factor]) {
                if place != NOT_STORED {
                    add_block(sign, &H, &mut values[place as usize]);
                }
            }
        }
    }
}

impl<T: Real> Potential<T> for Springs<T> {
    fn name(&self) -> &'static str {
        self.source.name
    }

    fn description(&self) -> String {
        self.source.description.clone()
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.springs[..]) + size_of_val(&self.places[..])
    }

    fn springs(&self) -> &[Spring<T>] {
        &self.springs
    }

    fn nodes_of_hessian(&self) -> Option<Vec<u32>> {
        Some(self.springs.iter().flat_map(|spring| spring.nodes).collect())
    }

    fn set_pattern(&mut self, pattern: &Pattern) {
        let place = |row: u32, column: u32| match pattern.find(row as usize, column as usize) {
            Some(block) => u32::try_from(block).expect("a matrix has fewer than 2³² blocks"),
            None => NOT_STORED,
        };
        let places = self.springs.iter().map(|spring| {
            let [a, b] = spring.nodes;
            [place(a, a), place(b, b), place(a, b), place(b, a)]
        });
        self.places = places.collect();
    }

    fn energy(&self, u: &[[T; 3]], _: Moment) -> Energy {
        self.springs.iter().map(|spring| spring.energy(u)).sum()
    }

    fn add_gradient(&self, u: &[[T; 3]], _: Moment, gradient: &mut [[T; 3]]) {
        self.springs.iter().for_each(|spring| spring.add_gradient(u, gradient));
    }

    fn hessian(&self, u: &[[T; 3]], _: Moment, kind: HessianKind, add: &mut AddBlock<T>) {
        for spring in &self.springs {
            let ([a, b], H) = (spring.ends(), spring.hessian(u, kind));
            let opposite = H.map(|row| row.map(|entry| -entry));
            for (row, column, block) in [(a, a, H), (b, b, H), (a, b, opposite), (b, a, opposite)] {
                add(row, column, block);
            }
        }
    }

    fn add_hessian(
        &self,
        factor: T,
        u: &[[T; 3]],
        _: Moment,
        kind: HessianKind,
        _: &Pattern,
        values: &mut [Block<T, 3>],
    ) {
        self.add_blocks(factor, values, |spring| spring.hessian(u, kind));
    }

    fn add_hessian_times(&self, factor: T, u: &[[T; 3]], _: Moment, d: &[[T; 3]], product: &mut [[T; 3]]) {
        self.springs.iter().for_each(|spring| spring.add_hessian_times(factor, u, d, product));
    }

    fn damped(&self) -> Option<&dyn Damped<T>> {
        self.has_dampers.then_some(self)
    }

    /// The two forces of a spring are equal and opposite.
    fn resultant(&self, _: Moment) -> Option<[f64; 3]> {
        Some([0.0; 3])
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let table = self.source.table;
        if !self.springs.iter().all(|spring| is_positive(spring.stiffness)) {
            return Some((table, "a stiffness"));
        }
        // A damping that underflows to zero is no damping.
        let fits = self.springs.iter().all(|spring| spring.damping.as_f64().is_finite());
        (!fits).then_some((table, "a damping"))
    }
}

impl<T: Real> Damped<T> for Springs<T> {
    fn add_damping_times(&self, factor: T, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]) {
        self.springs.iter().for_each(|spring| spring.add_damping_times(factor, u, v, product));
    }

    fn add_damping_matrix(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]) {
        self.add_blocks(factor, values, |spring| spring.damping_matrix(u));
    }
}
