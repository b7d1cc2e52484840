//! The methods that are compared, with the parameters that are swept and tuned.

use fem_model::Integrator;

use super::case::{LAW, SPRINGS};

/// A method.
#[derive(Clone, Copy, Debug)]
pub struct Contender {
    /// The name in tables.
    pub name: &'static str,
    /// The model of the material.
    pub model: &'static str,
    /// The method of its steps.
    pub integrator: Integrator,
    /// Kind of its iterations.
    pub sweep: Sweep,
    /// A key of `[iterations]`, and the values from which the best is taken for each case.
    pub tuned: Option<(&'static str, &'static [f64])>,
    /// Further keys of `[iterations]`.
    pub keys: &'static str,
}

/// The iterations of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sweep {
    /// Newton iterations until the update is below a tolerance.
    Newton,
    /// Sweeps or rounds, a fixed number of them.
    Iterations,
    /// The method has no iterations, or all of them until it converges.
    Whole,
}

const NEWTON: Contender = Contender {
    name: "Newton",
    model: LAW,
    integrator: Integrator::ImplicitEuler,
    sweep: Sweep::Newton,
    tuned: None,
    keys: "",
};
const ITERATED: Contender = Contender { sweep: Sweep::Iterations, ..NEWTON };

/// Values that the two parameters without a rule for their choice are tuned over: as many for each.
const RADII: &[f64] = &[0.5, 0.8, 0.9, 0.95, 0.98];
const STIFFNESSES: &[f64] = &[0.01, 0.1, 0.5, 0.9, 1.0];

/// All methods. Newton's is the first.
pub const ALL: [Contender; 11] = [
    NEWTON,
    Contender {
        name: "linearly implicit",
        integrator: Integrator::LinearlyImplicitEuler,
        sweep: Sweep::Whole,
        ..NEWTON
    },
    Contender { name: "BDF2", integrator: Integrator::Bdf2, sweep: Sweep::Whole, ..NEWTON },
    Contender { name: "XPBD", integrator: Integrator::Xpbd, ..ITERATED },
    Contender { name: "XPBD, no residual", integrator: Integrator::Xpbd, keys: "residual = false\n", ..ITERATED },
    Contender { name: "VBD", integrator: Integrator::Vbd, ..ITERATED },
    Contender { name: "VBD, Chebyshev", integrator: Integrator::Vbd, tuned: Some(("acceleration", RADII)), ..ITERATED },
    Contender { name: "PD", integrator: Integrator::ProjectiveDynamics, ..ITERATED },
    Contender { name: "PBD", integrator: Integrator::Pbd, tuned: Some(("stiffness", STIFFNESSES)), ..ITERATED },
    Contender { name: "springs, Newton", model: SPRINGS, sweep: Sweep::Whole, ..NEWTON },
    Contender {
        name: "springs, linearly implicit",
        model: SPRINGS,
        integrator: Integrator::LinearlyImplicitEuler,
        sweep: Sweep::Whole,
        ..NEWTON
    },
];

impl Contender {
    /// The tables of a scene with this many iterations, or, of Newton's method, digits of its tolerance; and a value of the tuned key.
    pub fn tables(&self, iterations: usize, value: Option<f64>) -> String {
        match self.sweep {
            Sweep::Newton => format!("[newton]\ntolerance = 1e-{iterations}\n"),
            Sweep::Iterations => {
                let tuned = self.tuned.zip(value).map(|((key, _), value)| format!("{key} = {value}\n"));
                format!("[iterations]\ncount = {iterations}\n{}{}", self.keys, tuned.unwrap_or_default())
            }
            Sweep::Whole => String::new(),
        }
    }

    /// Returns true if the steps converge to those of implicit Euler for the elements, so that a solver error is defined.
    pub fn has_solver_error(&self) -> bool {
        self.model == LAW && ![Integrator::Bdf2, Integrator::Pbd].contains(&self.integrator)
    }

    /// Returns true if the number of iterations is a parameter of the method.
    pub fn is_iterated(&self) -> bool {
        self.sweep == Sweep::Iterations
    }
}
