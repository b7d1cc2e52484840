//! The elements of one material with its law, and the choice of the law and of the lanes for the loops over them.

use crate::materials::{AnyLaw, Law, PlaneCorotated, Vectorized};
use crate::model::any_elements::AnyElements;
use crate::number::{Lanes, Real};
use crate::plasticity::{PlasticLaws, Plasticity};

/// The elements of one material.
pub(super) struct Solid<T: Real> {
    pub(super) laws: SolidLaws<T::Lanes>,
    /// The same in wide registers, on processors that have them.
    pub(super) fast: Option<SolidLaws<T::Fast>>,
    pub(super) elements: AnyElements<T>,
    /// Number of each quadrature point in the mesh, those of the first element first; empty where the group is the whole mesh in its order.
    pub(super) numbers: Vec<usize>,
}

/// The law of a material, in one kind of lanes.
pub(super) struct SolidLaws<L> {
    pub(super) law: AnyLaw<L>,
    /// The law of triangles where it has a form of its own.
    pub(super) in_plane: Option<Vectorized<PlaneCorotated<L>>>,
}

impl<L: Lanes> SolidLaws<L> {
    pub(super) fn new(law: AnyLaw<L>, is_flat: bool) -> Self {
        Self { law, in_plane: if is_flat { law.in_plane().map(Vectorized) } else { None } }
    }

    /// The law of elements that do not flow.
    pub(super) fn as_law(&self) -> &dyn Law<L> {
        self.in_plane.as_ref().map_or(self.law.as_law(), |law| law)
    }
}

/// Evaluates an expression for the elements of a group with its law, in the widest lanes of this processor. For these `with_law!` compiles
/// the value for each law of tetrahedra that do not flow; old processors without them call laws by reference, to keep the program small.
macro_rules! with_law_and_elements {
    ($solids:expr, $group:expr, $law:ident, $elements:ident => $value:expr) => {
        match &$group.fast {
            Some(laws) => with_law_and_elements!(in laws, $solids, $group, $law, $elements => $value),
            None => with_law_by_reference!(in &$group.laws, $solids, $group, $law, $elements => $value),
        }
    };
    (in $laws:expr, $solids:expr, $group:expr, $law:ident, $elements:ident => $value:expr) => {
        match (&$group.elements, $group.plastic_laws(&$solids.plasticity, $laws)) {
            (AnyElements::Tetrahedra($elements), None) => with_law!(&$laws.law, $law => $value),
            (AnyElements::Triangles($elements), None) => match &$laws.in_plane {
                Some(Vectorized($law)) => $value,
                None => {
                    let $law = $laws.law.as_law();
                    $value
                }
            },
            (AnyElements::QuadraticTriangles($elements), None) => {
                let $law = $laws.as_law();
                $value
            }
            (AnyElements::Tetrahedra($elements), Some($law)) => $value,
            (AnyElements::Triangles($elements), Some($law)) => $value,
            (AnyElements::QuadraticTriangles($elements), Some($law)) => $value,
        }
    };
}
pub(super) use with_law_and_elements;

/// The same with the law by reference.
macro_rules! with_law_by_reference {
    ($solids:expr, $group:expr, $law:ident, $elements:ident => $value:expr) => {
        match &$group.fast {
            Some(laws) => with_law_by_reference!(in laws, $solids, $group, $law, $elements => $value),
            None => with_law_by_reference!(in &$group.laws, $solids, $group, $law, $elements => $value),
        }
    };
    (in $laws:expr, $solids:expr, $group:expr, $law:ident, $elements:ident => $value:expr) => {
        with_elements!(&$group.elements, $elements => match $group.plastic_laws(&$solids.plasticity, $laws) {
            None => {
                let $law = $laws.as_law();
                $value
            }
            Some($law) => $value,
        })
    };
}
pub(super) use with_law_by_reference;

impl<T: Real> Solid<T> {
    /// The number in the mesh of a quadrature point of the group.
    pub(super) fn number(&self, point: usize) -> usize {
        self.numbers.get(point).copied().unwrap_or(point)
    }

    /// The laws of its quadrature points where they flow.
    pub(super) fn plastic_laws<'a, L: Lanes<Element = T>>(
        &'a self,
        plasticity: &'a Option<Plasticity<T>>,
        laws: &SolidLaws<L>,
    ) -> Option<PlasticLaws<'a, T, L>> {
        plasticity.as_ref().map(|plasticity| PlasticLaws::new(plasticity, &laws.law, &self.numbers))
    }
}
