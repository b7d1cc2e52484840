//! The floats of a simulation, for which this package compiles the loops over elements.

use fem_model::Body;
use nalgebra::Vector3;

use crate::materials::{AnyLaw, Law};
use crate::number::Float;
use crate::solids::{Groups, Solids};

/// The float that a whole simulation runs in: one whose loops over elements are compiled here.
pub trait Real: Float {
    /// A law by reference, whose kernels are those of this package.
    fn law(law: &AnyLaw<Self>) -> &dyn Law<Self>;

    /// The same in wide registers.
    fn fast_law(law: &AnyLaw<Self::Fast>) -> &dyn Law<Self::Fast>;

    /// The elastic elements of a body with `rest` positions of its nodes, m, where node i of the mesh has the number `numbers[i]`. `law` is
    /// that of the body's own material; without one, as in a mass-spring body, there is no element.
    fn solids(
        body: &Body,
        law: Option<AnyLaw<Self::Single>>,
        rest: &[Vector3<f64>],
        numbers: &[u32],
    ) -> Box<dyn Solids<Self>>;
}

/// Written out for each type: a method of all floats would be compiled by whoever calls it.
macro_rules! compiled_for {
    ($($T:ty),*) => {
        $(impl Real for $T {
            fn law(law: &AnyLaw<Self>) -> &dyn Law<Self> {
                law.as_law()
            }

            fn fast_law(law: &AnyLaw<Self::Fast>) -> &dyn Law<Self::Fast> {
                law.as_law()
            }

            fn solids(
                body: &Body,
                law: Option<AnyLaw<Self::Single>>,
                rest: &[Vector3<f64>],
                numbers: &[u32],
            ) -> Box<dyn Solids<Self>> {
                Box::new(Groups::<Self>::new(body, law, rest, numbers))
            }
        })*
    };
}
compiled_for!(f32, f64);
