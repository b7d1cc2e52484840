//! The elements of one material with its law, and the choice of the law and of the lanes for the loops over them.

use fem_model::{DampingForm, Plasticity as Model};

use super::LawWork;
use super::any_elements::AnyElements;
use crate::elements::BatchLaws;
use crate::materials::{AnyLaw, KelvinVoigt, Law, PlaneCorotated, Terms, Vectorized};
use crate::number::{Float, Lanes, Number};
use crate::plasticity::{PlasticLaw, PlasticLaws, Plasticity, Purpose};
use crate::tensor::{Tensor, Tensor4, contracted};

/// The elements of one material.
pub(super) struct Solid<T: Float> {
    pub(super) laws: SolidLaws<T::Single>,
    /// The same in wide registers, on processors that have them.
    pub(super) fast: Option<SolidLaws<T::Fast>>,
    pub(super) elements: AnyElements<T>,
    /// Shear modulus and bulk modulus of the material at small strain, Pa; its law here has a smaller one where the volume is averaged.
    pub(super) moduli: [f64; 2],
    /// Number of each quadrature point in the mesh, those of the first element first; empty where the group is the whole mesh in its order.
    pub(super) numbers: Vec<usize>,
}

/// The law of a material in the widest lanes of this processor, by reference, so that its kernels are those of this package. The flag is
/// true if the law allows J = det F ≤ 0.
pub enum LawInLanes<'a, T: Float> {
    /// One element after the other.
    Single(&'a dyn Law<T::Single>, bool),
    /// As many elements as a register holds.
    Fast(&'a dyn Law<T::Fast>, bool),
}

impl<T: Float> LawInLanes<'_, T> {
    /// Runs work with the law.
    pub fn run<W: LawWork<T>>(&self, work: W) -> W::Output {
        match self {
            Self::Single(law, allows_inversion) => work.run(*law, *allows_inversion),
            Self::Fast(law, allows_inversion) => work.run(*law, *allows_inversion),
        }
    }
}

/// The law of a material, in one kind of lanes.
pub(super) struct SolidLaws<L> {
    pub(super) law: AnyLaw<L>,
    /// The law of triangles where it has a form of its own.
    pub(super) in_plane: Option<Vectorized<PlaneCorotated<L>>>,
}

impl<L: Lanes> SolidLaws<L> {
    pub(super) fn new(law: AnyLaw<L>, is_in_plane: bool) -> Self {
        Self { law, in_plane: if is_in_plane { law.in_plane().map(Vectorized) } else { None } }
    }

    /// The law of elements that do not flow.
    pub(super) fn as_law(&self) -> &dyn Law<L> {
        self.in_plane.as_ref().map_or(self.law.as_law(), |law| law)
    }
}

/// Evaluates an expression for the elements of a group and its laws, called by reference, in the widest lanes of this processor.
macro_rules! with_laws_by_reference {
    ($solids:expr, $group:expr, $laws:ident, $elements:ident => $value:expr) => {
        match &$group.fast {
            Some(laws) => {
                let $laws = LawsByReference::new($group, laws, &$solids.plasticity);
                with_elements!(&$group.elements, $elements => $value)
            }
            None => {
                let $laws = LawsByReference::new($group, &$group.laws, &$solids.plasticity);
                with_elements!(&$group.elements, $elements => $value)
            }
        }
    };
}
pub(super) use with_laws_by_reference;

/// The same, but compiled for the law itself where many steps spend most of their time: in wide registers, for tetrahedra of the laws that
/// are worth it, and triangles of the corotated one.
macro_rules! with_laws {
    ($solids:expr, $group:expr, $laws:ident, $elements:ident => $value:expr) => {
        match (&$group.fast, &$group.elements) {
            (Some(laws), AnyElements::Tetrahedra($elements)) if $solids.plasticity.is_none() => {
                with_inlined_law!(&laws.law, $laws => $value, else {
                    let $laws = LawsByReference::new($group, laws, &None);
                    $value
                })
            }
            (Some(SolidLaws { in_plane: Some(Vectorized($laws)), .. }), AnyElements::Triangles($elements))
                if $solids.plasticity.is_none() =>
            {
                $value
            }
            _ => with_laws_by_reference!($solids, $group, $laws, $elements => $value),
        }
    };
}
pub(super) use with_laws;

/// Evaluates an expression for the elements of a group and the laws of their damping, called by reference, in the widest lanes of this
/// processor.
macro_rules! with_damping_laws {
    ($solids:expr, $group:expr, $form:expr, $laws:ident, $elements:ident => $value:expr) => {
        match &$group.fast {
            Some(laws) => {
                let damping = Vectorized(KelvinVoigt::new(laws.law.moduli()));
                let $laws = LawsByReference::of_damping($form, $group, (laws, &damping), &$solids.plasticity);
                with_elements!(&$group.elements, $elements => $value)
            }
            None => {
                let laws = &$group.laws;
                let damping = Vectorized(KelvinVoigt::new(laws.law.moduli()));
                let $laws = LawsByReference::of_damping($form, $group, (laws, &damping), &$solids.plasticity);
                with_elements!(&$group.elements, $elements => $value)
            }
        }
    };
}
pub(super) use with_damping_laws;

/// The laws of the elements of one material, called by reference once per batch.
#[derive(Clone, Copy)]
pub(super) struct LawsByReference<'a, T: Float, L> {
    laws: ElasticOrPlastic<&'a dyn Law<L>, PlasticLaws<'a, T, L>>,
    is_projected: bool,
}

/// The law of a batch, which is that of all elements or has internal variables. Its derivative may be the projected one.
pub(super) struct LawByReference<'a, L> {
    law: ElasticOrPlastic<&'a dyn Law<L>, PlasticLaw<L>>,
    is_projected: bool,
}

#[derive(Clone, Copy)]
enum ElasticOrPlastic<E, P> {
    Elastic(E),
    Plastic(P),
}

impl<'a, T: Float, L: Lanes<Element = T>> LawsByReference<'a, T, L> {
    /// The laws of a group's elements.
    pub(super) fn new(group: &'a Solid<T>, laws: &'a SolidLaws<L>, plasticity: &'a Option<Plasticity<T>>) -> Self {
        match plasticity {
            None => Self::one(laws.as_law()),
            Some(plasticity) => {
                let laws = PlasticLaws::new(plasticity, &laws.law, &group.numbers);
                Self { laws: ElasticOrPlastic::Plastic(laws), is_projected: false }
            }
        }
    }

    /// The laws whose derivatives are the damping of a group's elements. A linear law damps by its own derivative, which is constant; so
    /// does every law in Rayleigh's form, without the flow of plastic elements.
    pub(super) fn of_damping(
        form: DampingForm,
        group: &'a Solid<T>,
        (laws, damping): (&'a SolidLaws<L>, &'a Vectorized<KelvinVoigt<L>>),
        plasticity: &'a Option<Plasticity<T>>,
    ) -> Self {
        let is_viscous = form == DampingForm::KelvinVoigt && !laws.law.is_linear();
        match plasticity {
            // Additive plasticity keeps the deformation of the body in its elastic part.
            Some(plasticity) if !is_viscous || matches!(plasticity.model(), Model::J2 { .. }) => {
                let purpose = if is_viscous { Purpose::Viscosity } else { Purpose::ElasticDerivative };
                let laws = PlasticLaws::new(plasticity, &laws.law, &group.numbers).with_purpose(purpose);
                Self { laws: ElasticOrPlastic::Plastic(laws), is_projected: false }
            }
            _ => Self::one(if is_viscous { damping } else { laws.as_law() }),
        }
    }

    /// One law for all elements.
    pub(super) fn one(law: &'a dyn Law<L>) -> Self {
        Self { laws: ElasticOrPlastic::Elastic(law), is_projected: false }
    }

    /// The laws whose derivatives are the positive semi-definite projections of these.
    pub(super) fn projected(self) -> Self {
        Self { is_projected: true, ..self }
    }
}

impl<'a, T: Float, L: Lanes<Element = T>> BatchLaws<L> for LawsByReference<'a, T, L> {
    type Law = LawByReference<'a, L>;
    const IS_INLINED: bool = false;

    #[inline(always)]
    fn of_batch(&self, elements: &[u32], batch: usize) -> LawByReference<'a, L> {
        let law = match &self.laws {
            ElasticOrPlastic::Elastic(law) => ElasticOrPlastic::Elastic(*law),
            ElasticOrPlastic::Plastic(laws) => ElasticOrPlastic::Plastic(laws.of_batch(elements, batch)),
        };
        LawByReference { law, is_projected: self.is_projected }
    }
}

impl<L: Number> LawByReference<'_, L> {
    fn law(&self) -> &dyn Law<L> {
        match &self.law {
            ElasticOrPlastic::Elastic(law) => *law,
            ElasticOrPlastic::Plastic(law) => law,
        }
    }
}

impl<L: Number> Law<L> for LawByReference<'_, L> {
    fn energy(&self, G: &Tensor<L>) -> L {
        self.law().energy(G)
    }

    fn stress(&self, G: &Tensor<L>) -> Tensor<L> {
        self.law().stress(G)
    }

    fn energy_and_stress(&self, G: &Tensor<L>) -> (L, Tensor<L>) {
        self.law().energy_and_stress(G)
    }

    fn derivative(&self, G: &Tensor<L>) -> Tensor4<L> {
        if self.is_projected { self.law().projected_derivative(G) } else { self.law().derivative(G) }
    }

    fn derivative_times(&self, G: &Tensor<L>, rate: &Tensor<L>) -> Tensor<L> {
        if self.is_projected { contracted(&self.derivative(G), rate) } else { self.law().derivative_times(G, rate) }
    }

    fn terms(&self, G: &Tensor<L>) -> Terms<L> {
        if self.is_projected { Terms::Entries } else { self.law().terms(G) }
    }

    fn projected_derivative(&self, G: &Tensor<L>) -> Tensor4<L> {
        self.law().projected_derivative(G)
    }
}

impl<T: Float> Solid<T> {
    /// The number in the mesh of a quadrature point of the group.
    pub(super) fn number(&self, point: usize) -> usize {
        self.numbers.get(point).copied().unwrap_or(point)
    }
}
