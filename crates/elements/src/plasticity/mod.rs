//! Plastic flow, one model per file: the law that its internal variables make of an elastic one, and their change in a step.
//!
//! Internal variables stay as they are while a step is computed, and change once, when it is accepted. The law of `j2` returns
//! every trial state to the yield surface, so that an implicit step minimizes an energy and its stress is that of the end.

mod additive;
mod j2;
mod laws;

pub use additive::Additive;
pub use j2::J2;
pub use laws::{PlasticLaw, PlasticLaws, Purpose};

use fem_model::Plasticity as Model;
use fem_model::simulation::History;

use crate::history::{put, take};
use crate::number::Float;
use crate::tensor::{Tensor, map};
use crate::vector::triple;

/// Internal variables of an element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Internal<T> {
    /// Additive: the plastic strain εᵖ of the undeformed body. J2: Fᵖ⁻¹ − 1.
    pub plastic: Tensor<T>,
    /// Additive: |εᵖ|. J2: accumulated equivalent plastic strain α.
    pub strain: T,
}

/// The plastic flow of all elements of a body.
pub struct Plasticity<T> {
    model: Model,
    is_in_plane: bool,
    /// Of each element of the mesh.
    variables: Vec<Internal<T>>,
    /// Energy dissipated so far, J.
    dissipated: f64,
}

/// Internal variables after a step, and the energy per volume that their change has dissipated, J/m³.
pub type Flow = (Internal<f64>, f64);

impl<T: Float> Plasticity<T> {
    /// No flow yet, of a body that is flat or not.
    pub fn new(model: Model, elements: usize, is_in_plane: bool) -> Self {
        Self { model, is_in_plane, variables: vec![Internal::default(); elements], dissipated: 0.0 }
    }

    /// The model with its parameters.
    pub fn model(&self) -> Model {
        self.model
    }

    /// Returns true if the body is flat.
    pub fn is_in_plane(&self) -> bool {
        self.is_in_plane
    }

    /// Internal variables of each element of the mesh.
    pub fn variables(&self) -> &[Internal<T>] {
        &self.variables
    }

    /// Energy dissipated so far, J.
    pub fn dissipated(&self) -> f64 {
        self.dissipated
    }

    /// Returns to the start.
    pub fn clear(&mut self) {
        self.variables.fill(Internal::default());
        self.dissipated = 0.0;
    }

    /// Lets an element flow in an accepted step of `dt` seconds, which ends with the displacement gradient G. Its shear and bulk
    /// modulus are in Pa, its volume in m³.
    pub fn flow(&mut self, element: usize, [shear, bulk]: [f64; 2], volume: f64, G: &Tensor<f64>, dt: f64) {
        let before = self.variables[element];
        let plastic = map(&before.plastic, T::as_f64);
        let (after, dissipated) = match self.model {
            Model::Additive { yield_strain, creep, maximum } => {
                let law =
                    Additive { mu: shear, lambda: bulk - 2.0 / 3.0 * shear, plastic, is_in_plane: self.is_in_plane };
                law.flow(G, yield_strain, -(-creep * dt).exp_m1(), maximum)
            }
            Model::J2 { yield_stress, hardening } => {
                J2 { mu: shear, bulk, yield_stress, hardening, plastic, strain: before.strain.as_f64() }.flow(G)
            }
        };
        self.variables[element] = Internal { plastic: map(&after.plastic, T::of), strain: T::of(after.strain) };
        self.dissipated += volume * dissipated;
    }

    /// Adds its variables to a history.
    pub fn save(&self, history: &mut History) {
        let numbers =
            |of: &Internal<T>| of.plastic.as_flattened().iter().copied().chain([of.strain]).collect::<Vec<T>>();
        put(history, "plasticity.variables", &self.variables.iter().flat_map(numbers).collect::<Vec<T>>());
        put(history, "plasticity.dissipated", &[self.dissipated]);
    }

    /// Takes over what [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        let mut numbers = vec![T::default(); 10 * self.variables.len()];
        take(history, "plasticity.variables", &mut numbers)?;
        for (variables, numbers) in self.variables.iter_mut().zip(numbers.chunks_exact(10)) {
            variables.plastic = triple(|i| triple(|j| numbers[3 * i + j]));
            variables.strain = numbers[9];
        }
        let mut dissipated = [0.0];
        take(history, "plasticity.dissipated", &mut dissipated)?;
        self.dissipated = dissipated[0];
        Ok(())
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.variables[..])
    }
}

/// One line for `--explain`.
pub fn description(model: &Model) -> String {
    match model {
        Model::Additive { yield_strain, creep, maximum } => {
            let bound = if maximum.is_finite() { format!(" up to {maximum}") } else { String::new() };
            format!(
                "[plasticity]: additive, flows beyond a strain of {yield_strain} at {creep}/s{bound}, once in every step"
            )
        }
        Model::J2 { yield_stress, hardening } => {
            format!("[plasticity]: j2, yields at {yield_stress:.4e} Pa, hardens by {hardening:.4e} Pa")
        }
    }
}
