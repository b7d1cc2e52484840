//! A body: mesh, materials, constraints, loads and obstacles.

use std::path::Path;

use nalgebra::Vector3;

use crate::numbers::{check_finite, check_not_negative, check_positive, check_vector, problem};
use crate::regions::density_factors;
use crate::selector::{elements, listed, loaded_faces, nodes};
use crate::simulation::Shape;
use crate::{
    BodyMesh, Contact, Damping, DirichletCondition, Drag, FibreDirections, FibreFamily, FibreLaw, ForceFields, Law,
    LoadCurve, Material, MaterialRegion, Method, Motion, NodalForce, PlaneState, Plasticity, Pressure, Refusal,
    Selector, Spring, Traction, Volumetric, check_disjoint,
};

/// A body as a pipeline simulates it: checked meshes, material, constraints and external forces, in the mesh's node numbers and
/// SI units.
///
/// [`Body::new`] makes one at rest without loads; the methods below add to it and refuse what cannot be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name in titles and statistics.
    pub name: String,
    /// Nodes, elements and surfaces.
    pub shape: Shape,
    /// Remarks on the mesh files, one line each: what was left out of them, and what was changed.
    pub notes: Vec<String>,
    /// Constitutive law and density of the elements outside of all regions.
    pub material: Material,
    /// Parts of the body with materials of their own. No element belongs to two of them.
    pub regions: Vec<MaterialRegion>,
    /// Plastic flow of all elements.
    pub plasticity: Option<Plasticity>,
    /// True if the mass matrix is lumped instead of consistent; see [`Integrator::lumps_mass`](crate::Integrator::lumps_mass).
    pub lumped_mass: bool,
    /// Factor on the moduli of each element; empty for a uniform body. Scene files have no key for it.
    pub stiffness_factors: Vec<f64>,
    /// Factor on the density of `material` for each element, that of its region included; empty for a uniform body.
    pub density_factors: Vec<f64>,
    /// Acceleration of gravity, m/s².
    pub gravity: Option<Vector3<f64>>,
    /// Factor of time on gravity.
    pub gravity_curve: Option<LoadCurve>,
    /// Body force per undeformed volume, N/m³.
    pub body_force: Option<Vector3<f64>>,
    /// Factor of time on the body force.
    pub body_force_curve: Option<LoadCurve>,
    /// Fixed nodes first, then prescribed motions. No two of them prescribe the same coordinate.
    pub dirichlet: Vec<DirichletCondition>,
    /// Velocity of each node at the start, m/s; empty for a body at rest. Constrained nodes have their prescribed motion instead.
    pub initial_velocity: Vec<Vector3<f64>>,
    /// Dead loads on the surface.
    pub tractions: Vec<Traction>,
    /// Dead loads on single nodes.
    pub nodal_forces: Vec<NodalForce>,
    /// Follower loads on the surface.
    pub pressures: Vec<Pressure>,
    /// Families of fibres in the elements.
    pub fibres: Vec<FibreFamily>,
    /// Force fields.
    pub fields: ForceFields,
    /// Springs between nodes.
    pub springs: Vec<Spring>,
    /// Obstacles.
    pub contact: Option<Contact>,
    /// The scripted drag.
    pub drag: Option<Drag>,
    /// Damping; `None` if both coefficients are zero.
    pub damping: Option<Damping>,
}

impl Body {
    /// A uniform body at rest without constraints and loads. Refuses a mesh that cannot be simulated (a node outside the mesh, an element
    /// without volume, …) and parameters out of range.
    pub fn new(mesh: impl Into<BodyMesh>, material: Material) -> Result<Self, Refusal> {
        let checked = mesh.into().checked(Path::new("mesh"));
        let mesh = checked.map_err(|error| Refusal::new("mesh", format!("cannot be simulated: {error}")))?;
        mesh.thickness().map_or(Ok(()), |thickness| check_positive("material.thickness", thickness, " of m"))?;
        material.check("material")?;
        if material.plane == PlaneState::Stress
            && !(mesh.thickness().is_some()
                && Law::named(material.law.name()).is_some_and(|facts| facts.has_plane_stress))
        {
            return problem("material.plane", "is stress, a state of flat bodies whose law is linear or corotated");
        }
        Ok(Self::of_shape(Shape { boundary: mesh.surface(), mesh, display: None, picture: None }, material))
    }

    /// Each material with its elements, the body's own first.
    pub fn materials(&self) -> impl Iterator<Item = (&Material, Vec<usize>)> {
        let mut is_own = vec![true; self.shape.mesh.elements()];
        self.regions.iter().flat_map(|region| &region.elements).for_each(|&element| is_own[element] = false);
        let own = (0..is_own.len()).filter(|&element| is_own[element]).collect();
        let regions = self.regions.iter().map(|region| (&region.material, region.elements.clone()));
        std::iter::once((&self.material, own)).chain(regions)
    }

    /// Returns true if a part of the body has Poisson's ratio ½.
    pub fn is_incompressible(&self) -> bool {
        self.has_pressures() && self.materials().any(|(material, _)| material.law.poissons_ratio() == Some(0.5))
    }

    /// Returns true if pressures are unknowns beside the displacements in a part of the body.
    pub fn has_pressures(&self) -> bool {
        self.materials().any(|(material, _)| material.volumetric == Volumetric::Mixed)
    }

    /// The first material whose energy of the volume is not evaluated at each quadrature point: how it is.
    pub fn volumetric(&self) -> Option<Volumetric> {
        let regions = self.regions.iter().map(|region| &region.material);
        let mut materials = std::iter::once(&self.material).chain(regions).map(|material| material.volumetric);
        materials.find(|volumetric| *volumetric != Volumetric::Standard)
    }

    /// The same of a shape and a material that have been checked.
    pub fn of_shape(shape: Shape, material: Material) -> Self {
        Self {
            name: "body".to_owned(),
            shape,
            notes: Vec::new(),
            material,
            regions: Vec::new(),
            plasticity: None,
            lumped_mass: false,
            stiffness_factors: Vec::new(),
            density_factors: Vec::new(),
            gravity: None,
            gravity_curve: None,
            body_force: None,
            body_force_curve: None,
            dirichlet: Vec::new(),
            initial_velocity: Vec::new(),
            tractions: Vec::new(),
            nodal_forces: Vec::new(),
            pressures: Vec::new(),
            fibres: Vec::new(),
            fields: ForceFields::default(),
            springs: Vec::new(),
            contact: None,
            drag: None,
            damping: None,
        }
    }

    /// Gives elements that no other region has a material of their own.
    pub fn region(mut self, selector: &Selector, material: Material) -> Result<Self, Refusal> {
        let name = format!("materials[{}]", self.regions.len());
        material.check(&name)?;
        let elements = elements(&name, selector, &self.shape.mesh)?;
        let owner = self.regions.iter().find(|region| region.elements.iter().any(|element| elements.contains(element)));
        if let Some(owner) = owner {
            return problem(&name, format!("has elements of {}; name each element once", owner.name));
        }
        self.regions.push(MaterialRegion { name, material, elements });
        self.density_factors = density_factors(&self.regions, self.material.density, self.shape.mesh.elements());
        Ok(self)
    }

    /// Adds gravity: an acceleration, m/s².
    pub fn gravity(mut self, acceleration: [f64; 3]) -> Result<Self, Refusal> {
        check_vector("gravity.acceleration", &acceleration)?;
        self.gravity = Some(acceleration.into());
        Ok(self)
    }

    /// Adds a force per undeformed volume, N/m³.
    pub fn body_force(mut self, density: [f64; 3]) -> Result<Self, Refusal> {
        check_vector("body_force.density", &density)?;
        self.body_force = Some(density.into());
        Ok(self)
    }

    /// Fixes nodes where they are.
    pub fn fix(mut self, selector: &Selector) -> Result<Self, Refusal> {
        let mut chosen = nodes("fixed", selector, &self.shape.mesh)?;
        if self.dirichlet.first().is_some_and(|condition| condition.motion.is_none()) {
            chosen.extend(self.dirichlet.remove(0).nodes);
            chosen.sort_unstable();
            chosen.dedup();
        }
        let (name, components) = ("fixed".to_owned(), [true; 3]);
        self.dirichlet.insert(0, DirichletCondition { name, nodes: chosen, components, motion: None, until: None });
        self.disjoint()
    }

    /// Prescribes a motion of nodes along the axes x, y and z whose component is true.
    pub fn prescribe(mut self, selector: &Selector, components: [bool; 3], motion: Motion) -> Result<Self, Refusal> {
        let number = self.dirichlet.iter().filter(|condition| condition.motion.is_some()).count();
        let name = format!("prescribed[{number}]");
        check_vector(&format!("{name}.displacement"), &motion.displacement.into())?;
        if let Some(rotation) = &motion.rotation {
            check_vector(&format!("{name}.rotation.center"), &rotation.center.into())?;
            check_finite(&format!("{name}.rotation.turns"), &[rotation.turns])?;
        }
        let nodes = nodes(&name, selector, &self.shape.mesh)?;
        self.dirichlet.push(DirichletCondition { name, nodes, components, motion: Some(motion), until: None });
        self.disjoint()
    }

    /// Sets the velocity of all nodes at the start, m/s.
    pub fn velocity(mut self, velocity: [f64; 3]) -> Result<Self, Refusal> {
        check_vector("initial_velocity", &velocity)?;
        self.initial_velocity = vec![velocity.into(); self.shape.mesh.vertices().len()];
        Ok(self)
    }

    /// Loads a part of the surface with a force per undeformed area, Pa, which keeps its direction.
    pub fn traction(mut self, selector: &Selector, force_per_area: [f64; 3]) -> Result<Self, Refusal> {
        let table = format!("traction[{}]", self.tractions.len() + self.pressures.len());
        check_vector(&format!("{table}.force_per_area"), &force_per_area)?;
        let faces = loaded_faces(&table, selector, &self.shape)?;
        self.tractions.push(Traction { faces, force_per_area: force_per_area.into(), curve: None });
        Ok(self)
    }

    /// Loads a part of the surface with a pressure, Pa, against the deformed surface; positive pushes inwards.
    pub fn pressure(mut self, selector: &Selector, pressure: f64) -> Result<Self, Refusal> {
        let table = format!("traction[{}]", self.tractions.len() + self.pressures.len());
        check_vector(&format!("{table}.pressure"), &[pressure, 0.0, 0.0])?;
        let faces = loaded_faces(&table, selector, &self.shape)?;
        self.pressures.push(Pressure { faces, pressure, curve: None });
        Ok(self)
    }

    /// Loads each of some nodes with a force, N, which keeps its direction.
    pub fn force(mut self, selector: &Selector, force: [f64; 3]) -> Result<Self, Refusal> {
        let table = format!("force[{}]", self.nodal_forces.len());
        check_vector(&format!("{table}.value"), &force)?;
        let nodes = nodes(&table, selector, &self.shape.mesh)?;
        self.nodal_forces.push(NodalForce { nodes, force: force.into(), curve: None });
        Ok(self)
    }

    /// Adds a family of fibres to elements, beside the law of their material.
    pub fn fibres(mut self, selector: &Selector, law: FibreLaw, directions: &FibreDirections) -> Result<Self, Refusal> {
        let name = format!("fibres[{}]", self.fibres.len());
        law.check(&name)?;
        let elements = elements(&name, selector, &self.shape.mesh)?;
        let directions = directions.of(&name, &elements, &self.shape.mesh)?;
        self.fibres.push(FibreFamily { name, law, directions });
        Ok(self)
    }

    /// Adds a force field, such as [`CentralGravity`](crate::CentralGravity).
    pub fn field(mut self, field: impl Into<ForceFields>) -> Result<Self, Refusal> {
        let field = field.into();
        field.check()?;
        field.check_on(&self.shape.mesh)?;
        self.fields.extend(field);
        Ok(self)
    }

    /// Joins two nodes by a spring of a stiffness, N/m, that is relaxed in the undeformed body.
    pub fn spring(mut self, [a, b]: [usize; 2], stiffness: f64) -> Result<Self, Refusal> {
        let table = format!("springs[{}]", self.springs.len());
        check_positive(&format!("{table}.stiffness"), stiffness, " of N/m")?;
        if listed(&format!("{table}.nodes"), &[a, b], &self.shape.mesh)?.len() == 1 {
            return problem(&format!("{table}.nodes"), format!("names node {a} twice; a spring joins two nodes"));
        }
        let x = self.shape.mesh.vertices();
        let rest_length = (x[b] - x[a]).norm();
        self.springs.push(Spring { nodes: [a, b], stiffness, rest_length, is_initially_relaxed: true, damping: 0.0 });
        Ok(self)
    }

    /// Adds damping.
    pub fn damping(mut self, damping: Damping) -> Result<Self, Refusal> {
        check_not_negative("damping.alpha", damping.alpha, "1/s")?;
        check_not_negative("damping.beta", damping.beta, "s")?;
        self.damping = Some(damping).filter(|damping| damping.alpha > 0.0 || damping.beta > 0.0);
        Ok(self)
    }

    /// Lumps the mass at the nodes if the method does so by default.
    pub fn lump_mass_for(mut self, method: &Method) -> Self {
        self.lumped_mass = method.integrator.lumps_mass(self.shape.mesh.vertices().len(), self.contact.is_some());
        self
    }

    /// The fixed nodes, ascending and without repeats; `None` if there are none.
    pub fn fixed_nodes(&self) -> Option<&[usize]> {
        self.dirichlet.iter().find(|condition| condition.motion.is_none()).map(|condition| &condition.nodes[..])
    }

    fn disjoint(self) -> Result<Self, Refusal> {
        check_disjoint(&self.dirichlet, self.shape.mesh.vertices().len())?;
        Ok(self)
    }
}
