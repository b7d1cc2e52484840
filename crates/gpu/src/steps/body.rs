//! The data of a batch on a device: mesh, masses and loads of a body, the parameters of each environment, and the method.

use super::Cause;
use crate::elements::Tetrahedra;

/// A body with all that its environments share.
#[derive(Clone, Debug, Default)]
pub struct Body {
    /// Its elements.
    pub tetrahedra: Tetrahedra,
    /// One over the mass of each node in each direction, 1/kg; zero in constrained ones.
    pub inverse_masses: Vec<[f64; 3]>,
    /// Weight of each node, N.
    pub weights: Vec<[f64; 3]>,
    /// Other dead loads on each node, N.
    pub loads: Vec<[f64; 3]>,
    /// Velocities at the start, m/s; empty for a body at rest.
    pub velocities: Vec<[f64; 3]>,
}

impl Body {
    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.inverse_masses.len()
    }
}

/// The parameters of one environment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// Parameters of the law, Pa.
    pub moduli: [f64; 2],
    /// Factor on the weights.
    pub weight: f64,
    /// Factor on the masses.
    pub density: f64,
}

/// A time integration method with its step.
#[derive(Clone, Debug, PartialEq)]
pub struct Method {
    /// The method.
    pub scheme: Scheme,
    /// s
    pub dt: f64,
    /// Damping of the mass, the force −α M v, 1/s.
    pub alpha: f64,
}

/// Time integration methods.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)] // the names are the field's
pub enum Scheme {
    ExplicitEuler,
    SemiImplicitEuler,
    Verlet,
    Rk2,
    Rk4,
    VertexBlockDescent {
        /// Sweeps over all nodes in a step.
        sweeps: usize,
        /// The nodes by colour: those of a colour share no element.
        colors: Vec<Vec<u32>>,
    },
}

/// Decodes the number in which a shader reports an inverted element or a value that is not finite: see `found` there.
pub(super) fn cause(found: u32) -> Option<Cause> {
    const NODE: u32 = 1 << 31;
    match found {
        u32::MAX => None,
        element if element < NODE => Some(Cause::Inverted { element: element as usize }),
        node => Some(Cause::NotFinite { node: (node - NODE) as usize }),
    }
}
