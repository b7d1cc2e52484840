//! The elements of a body, grouped by material: the loops over a group are compiled for its law.

use fem_model::{Body, DampingForm, Material, PlaneState, Volumetric};
use nalgebra::{Matrix3, Vector3};

use super::Solids;
use super::any_elements::{AnyElements, with_elements};
use super::material::{
    LawInLanes, LawsByReference, Solid, SolidLaws, with_damping_laws, with_laws, with_laws_by_reference,
};
use crate::elements::smaller;
use crate::materials::{
    AnyLaw, KelvinVoigt, QuadraticForm, Vectorized, cauchy_stress, in_plane_stress, match_inlined_law, with_inlined_law,
};
use crate::number::{Float, Number, constant};
use crate::plasticity::{Internal, Plasticity};
use crate::sparse::{Block, Pattern};

/// All elements of a body. A body of one material is one group.
pub struct Groups<T: Float> {
    groups: Vec<Solid<T>>,
    /// Number of quadrature points: one in every linear element, three in a quadratic triangle, four in a quadratic tetrahedron.
    count: usize,
    points_per_element: usize,
    nodes: usize,
    /// Factor of the moduli of each of the mesh's elements; empty where all are 1.
    factors: Vec<f64>,
    plasticity: Option<Plasticity<T>>,
    /// No stress acts across a flat body.
    is_in_plane_stress: bool,
}

impl<T: Float> Groups<T> {
    /// Groups the elements of a body, with positions and numbers of nodes as the engine has them. `law` is that of the body's own
    /// material; without one, as in a mass-spring body, no element is built.
    pub fn new(body: &Body, law: Option<AnyLaw<T::Single>>, rest: &[Vector3<f64>], node_numbers: &[u32]) -> Self {
        let Some(law) = law else { return Self::none() };
        let factors = &body.stiffness_factors;
        let (count, points_per_element) = (body.shape.mesh.elements(), body.shape.mesh.element().points.len());
        let is_in_plane = body.shape.mesh.dimension() == 2;
        let group = |(law, material): (AnyLaw<T::Single>, &Material), elements: Vec<usize>| {
            let of_element = |&element: &usize| element * points_per_element..(element + 1) * points_per_element;
            let numbers = elements.iter().flat_map(of_element).collect();
            let elements = AnyElements::new(&body.shape.mesh, factors, &elements, rest, node_numbers);
            let fast = if T::has_fast() { AnyLaw::<T::Fast>::new(material) } else { None };
            if let Some(fast) = &fast {
                assert_eq!(fast.moduli(), law.moduli(), "the law is that of the body's material");
            }
            let (moduli, is_apart) = (law.moduli(), material.volumetric != Volumetric::Standard);
            let fast = fast.map(|fast| SolidLaws::new(at_points(fast, is_apart), is_in_plane));
            let laws = SolidLaws::new(at_points(law, is_apart), is_in_plane);
            Solid { laws, fast, elements, moduli, numbers }
        };
        let groups = if body.regions.is_empty() {
            vec![Solid { numbers: Vec::new(), ..group((law, &body.material), (0..count).collect()) }]
        } else {
            let of_region = |material: &Material| {
                AnyLaw::new(material).unwrap_or_else(|| unreachable!("a material without parameters is refused"))
            };
            let laws = std::iter::once(law).chain(body.regions.iter().map(|region| of_region(&region.material)));
            let groups = laws.zip(body.materials()).filter(|(_, (_, elements))| !elements.is_empty());
            groups.map(|(law, (material, elements))| group((law, material), elements)).collect()
        };
        let count = count * points_per_element;
        let plasticity = body.plasticity.map(|model| Plasticity::new(model, count, is_in_plane));
        let is_in_plane_stress = body.material.plane == PlaneState::Stress;
        Self {
            groups,
            count,
            points_per_element,
            nodes: rest.len(),
            factors: factors.clone(),
            plasticity,
            is_in_plane_stress,
        }
    }

    /// No elements: a mass-spring body has its elasticity in its springs.
    fn none() -> Self {
        Self {
            groups: Vec::new(),
            nodes: 0,
            count: 0,
            points_per_element: 1,
            factors: Vec::new(),
            plasticity: None,
            is_in_plane_stress: false,
        }
    }

    fn least(&self, u: &[[T; 3]], is_meant: impl Fn(&Solid<T>) -> bool) -> (T, usize) {
        let mut least = (T::of(f64::INFINITY), 0);
        for group in self.groups.iter().filter(|group| is_meant(group)) {
            let (J, point) = with_elements!(&group.elements, elements => elements.min_det_F(u));
            least = smaller(least, (J, group.number(point) / self.points_per_element));
        }
        least
    }
}

/// The law of the elements: where the volume is averaged or has pressures, the rest of its energy is a force of its own.
fn at_points<L: Number>(law: AnyLaw<L>, is_apart: bool) -> AnyLaw<L> {
    if is_apart { law.without_lambda().unwrap_or(law) } else { law }
}

impl<T: Float> Solids<T> for Groups<T> {
    fn count(&self) -> usize {
        self.count
    }

    fn law(&self, material: usize) -> &AnyLaw<T::Single> {
        &self.groups[material].laws.law
    }

    fn law_in_lanes(&self, material: usize) -> LawInLanes<'_, T> {
        let Solid { laws, fast, .. } = &self.groups[material];
        let allows_inversion = laws.law.allows_inversion();
        match fast {
            Some(laws) => LawInLanes::Fast(laws.as_law(), allows_inversion),
            None => LawInLanes::Single(laws.as_law(), allows_inversion),
        }
    }

    fn materials(&self) -> usize {
        self.groups.len()
    }

    fn numbers(&self, material: usize) -> Vec<usize> {
        let of_group = &self.groups[material].numbers;
        if of_group.is_empty() { (0..self.count).collect() } else { of_group.clone() }
    }

    fn factor(&self, element: usize) -> f64 {
        self.factors.get(element).copied().unwrap_or(1.0)
    }

    fn set_pattern(&mut self, pattern: &Pattern) {
        for group in &mut self.groups {
            with_elements!(&mut group.elements, elements => elements.set_pattern(pattern));
        }
    }

    fn bytes(&self) -> usize {
        self.groups
            .iter()
            .map(|group| {
                with_elements!(&group.elements, elements => elements.bytes()) + size_of_val(&group.numbers[..])
            })
            .sum()
    }

    fn energy(&self, u: &[[T; 3]]) -> f64 {
        self.groups
            .iter()
            .map(|group| with_laws_by_reference!(self, group, laws, elements => elements.energy(laws, u)))
            .sum()
    }

    fn add_gradient(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        for group in &self.groups {
            with_laws!(self, group, laws, elements => elements.add_gradient(laws, u, gradient));
        }
    }

    fn add_energy_and_gradient(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) -> f64 {
        let mut energy = 0.0;
        for group in &self.groups {
            energy += with_laws!(self, group, laws, elements => elements.add_energy_and_gradient(laws, u, gradient));
        }
        energy
    }

    fn add_stiffness(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]) {
        for group in &self.groups {
            with_laws!(self, group, laws, elements => elements.add_stiffness(laws, factor, u, values));
        }
    }

    fn add_projected_stiffness(&self, factor: T, u: &[[T; 3]], values: &mut [Block<T, 3>]) {
        for group in &self.groups {
            with_laws_by_reference!(self, group, laws, elements => {
                elements.add_stiffness(laws.projected(), factor, u, values)
            });
        }
    }

    fn add_stiffness_times(&self, factor: T, u: &[[T; 3]], d: &[[T; 3]], product: &mut [[T; 3]]) {
        for group in &self.groups {
            with_laws_by_reference!(self, group, laws, elements => {
                elements.add_stiffness_times(laws, factor, u, d, product)
            });
        }
    }

    fn add_damping_matrix(
        &self,
        form: DampingForm,
        is_projected: bool,
        factor: T,
        u: &[[T; 3]],
        values: &mut [Block<T, 3>],
    ) {
        for group in &self.groups {
            with_damping_laws!(self, group, form, laws, elements => {
                let laws = if is_projected { laws.projected() } else { laws };
                elements.add_stiffness(laws, factor, u, values)
            });
        }
    }

    fn add_damping_times(&self, form: DampingForm, factor: T, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]) {
        for group in &self.groups {
            with_damping_laws!(self, group, form, laws, e => e.add_stiffness_times(laws, factor, u, v, product));
        }
    }

    fn cancelled(&self, u: &[[T; 3]]) -> f64 {
        self.groups
            .iter()
            .map(|group| group.laws.law.size() * with_elements!(&group.elements, elements => elements.squares(u)))
            .sum()
    }

    fn min_det_F(&self, u: &[[T; 3]]) -> (T, usize) {
        self.least(u, |_| true)
    }

    fn min_det_F_of_barriers(&self, u: &[[T; 3]]) -> (T, usize) {
        self.least(u, |group| !group.laws.law.allows_inversion())
    }

    fn inverted(&self, u: &[[T; 3]]) -> usize {
        self.groups.iter().map(|group| with_elements!(&group.elements, elements => elements.inverted(u))).sum()
    }

    fn points_per_element(&self) -> usize {
        self.points_per_element
    }

    fn moduli_of(&self, material: usize) -> [f64; 2] {
        self.groups[material].moduli
    }

    fn is_in_plane_stress(&self) -> bool {
        self.is_in_plane_stress
    }

    fn cauchy_stresses_at_points(&self, u: &[[T; 3]]) -> Vec<Matrix3<f64>> {
        let mut stresses = vec![Matrix3::zeros(); self.count];
        for group in &self.groups {
            let law = &group.laws.law;
            let is_pushed_forward = !law.is_linear() || self.plasticity.is_some();
            let shear_modulus = (self.is_in_plane_stress && self.plasticity.is_none()).then(|| law.moduli()[0]);
            let of_group = with_laws_by_reference!(self, group, laws, elements => {
                elements.cauchy_stresses(laws, u, &|law, G| {
                    let (mut P, mut G) = (law.stress(G), *G);
                    if let Some(shear_modulus) = shear_modulus {
                        (P, G) = in_plane_stress(shear_modulus, &P, &G);
                    }
                    if is_pushed_forward { cauchy_stress(&P, &G) } else { P }
                })
            });
            for (point, stress) in of_group.into_iter().enumerate() {
                let number = group.number(point);
                let factor = self.factor(number / self.points_per_element);
                stresses[number] = factor * Matrix3::from_fn(|i, j| stress[i][j]);
            }
        }
        stresses
    }

    fn add_metric(&self, values: &mut [Block<T, 3>]) {
        let zero = vec![[T::default(); 3]; self.nodes];
        for group in &self.groups {
            let modulus = 4.0 / 3.0 * group.laws.law.moduli()[0] + group.laws.law.moduli()[1];
            if T::has_fast() {
                let law = QuadraticForm::<T::Fast>(constant(modulus));
                let laws = LawsByReference::one(&law);
                with_elements!(&group.elements, elements => elements.add_stiffness(laws, T::one(), &zero, values));
            } else {
                let law = QuadraticForm::<T::Single>(constant(modulus));
                let laws = LawsByReference::one(&law);
                with_elements!(&group.elements, elements => elements.add_stiffness(laws, T::one(), &zero, values));
            }
        }
    }

    fn plasticity(&self) -> Option<&Plasticity<T>> {
        self.plasticity.as_ref()
    }

    fn plasticity_mut(&mut self) -> Option<&mut Plasticity<T>> {
        self.plasticity.as_mut()
    }

    fn flow(&mut self, u: &[[T; 3]], dt: f64) {
        let Self { groups, plasticity: Some(plasticity), .. } = self else { return };
        for group in groups.iter() {
            let moduli = group.laws.law.moduli();
            with_elements!(&group.elements, elements => elements.for_each_gradient(u, |point, volume, G| {
                plasticity.flow(group.number(point), moduli, volume, G, dt);
            }));
        }
    }

    fn plastic_strains(&self) -> Option<Vec<f64>> {
        let points = self.plasticity.as_ref()?.variables().chunks_exact(self.points_per_element);
        let sum = |points: &[Internal<T>]| points.iter().map(|of| of.strain.as_f64()).sum::<f64>();
        Some(points.map(|points| sum(points) / self.points_per_element as f64).collect())
    }
}
