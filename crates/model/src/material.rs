//! Materials: the constitutive law with its parameters, the density, and how the energy is evaluated.

use serde::Deserialize;

use crate::numbers::{check_finite, check_not_negative, check_positive, problem};
use crate::{Law, PlaneState, Refusal, VolumeEnergy};

/// The material of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Constitutive law, or springs along the edges in place of one.
    pub law: Law,
    /// Mass per undeformed volume, kg/m³.
    pub density: f64,
    /// State of a flat body across its plane.
    pub plane: PlaneState,
    /// Evaluation of the energy of the volume.
    pub volumetric: Volumetric,
}

/// The evaluation of the part of the energy that depends on the volume.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Volumetric {
    /// At each quadrature point. As Poisson's ratio approaches ½, elements lock: linear ones most, quadratic ones a little.
    #[default]
    Standard,
    /// At the mean of J = det F over a quadratic element, or over a patch of about eight linear ones: they lock far less. For the laws `linear`,
    /// `neo_hookean`, `hencky`, `mooney_rivlin`, `yeoh`, `gent` and `ogden`; not in plane stress. Engine only.
    Averaged,
    /// By continuous pressures at the corners as unknowns beside the displacements: no element locks, and Poisson's ratio may be ½. For the same
    /// laws, with `static`, `implicit_euler` and the implicit methods of second order. Engine only.
    Mixed,
}

impl Volumetric {
    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Averaged => "averaged",
            Self::Mixed => "mixed",
        }
    }
}

/// Poisson's ratio above which linear tetrahedra lock visibly.
const LOCKS_ABOVE: f64 = 0.45;

impl Material {
    /// A material of a density, kg/m³; plane strain if the body is flat.
    pub fn new(law: Law, density: f64) -> Self {
        Self { law, density, plane: PlaneState::Strain, volumetric: Volumetric::Standard }
    }

    /// Lamé's constants μ and λ, Pa, of a law with Young's modulus and Poisson's ratio.
    pub fn lame(&self) -> Option<[f64; 2]> {
        self.law.elastic().map(|elastic| elastic.lame(self.plane))
    }

    /// Returns true if every edge of the mesh is a spring, and no element is elastic.
    pub fn is_mass_spring(&self) -> bool {
        matches!(self.law, Law::MassSpring { .. })
    }

    /// The energy of the volume, if it is evaluated in this way.
    pub fn volume_energy(&self, volumetric: Volumetric) -> Option<VolumeEnergy> {
        let volume = Law::named(self.law.name()).and_then(|facts| facts.volume);
        volume.filter(|_| self.volumetric == volumetric)
    }

    /// Returns true if linear tetrahedra lock: Poisson's ratio is above 0.45.
    pub fn locks(&self) -> bool {
        self.volumetric == Volumetric::Standard
            && self.law.poissons_ratio().is_some_and(|poisson| poisson > LOCKS_ABOVE)
    }

    /// Refuses parameters and a density out of range. `table` names the material, such as `material` or `materials[0]`.
    pub fn check(&self, table: &str) -> Result<(), Refusal> {
        check_positive(&format!("{table}.density"), self.density, " of kg/m³")?;
        for (name, value) in self.law.parameters() {
            let field = format!("{table}.{name}");
            match name {
                "poisson" if value > -1.0 && value < 0.5 => {}
                "poisson" if value == 0.5 && self.volumetric == Volumetric::Mixed => {}
                "poisson" => {
                    let range = format!("is {value}; Poisson's ratio lies above -1 and below 0.5");
                    let mixed = format!(", or is that with {table}.volumetric = \"mixed\"");
                    return problem(&field, range + if value == 0.5 { &mixed } else { "" });
                }
                "C10" | "C01" | "C2" | "C3" | "mu1" | "mu2" | "mu3" => check_finite(&field, &[value])?,
                "alpha1" | "alpha2" | "alpha3" if value == 0.0 => {
                    return problem(
                        &field,
                        "is 0, where a term has no energy; give another exponent, or leave the term out",
                    );
                }
                "alpha1" | "alpha2" | "alpha3" => check_finite(&field, &[value])?,
                "Jm" => check_positive(&field, value, "")?,
                "stiffness" => check_positive(&field, value, " of N/m")?,
                "damping" => check_not_negative(&field, value, "N s/m")?,
                _ => check_positive(&field, value, " of Pa")?,
            }
        }
        self.check_volumetric(&format!("{table}.volumetric"))
    }

    fn check_volumetric(&self, field: &str) -> Result<(), Refusal> {
        if self.volumetric == Volumetric::Standard {
            return Ok(());
        }
        if self.volume_energy(self.volumetric).is_none() {
            let known: Vec<_> =
                Law::FACTS.iter().filter(|facts| facts.volume.is_some()).map(|facts| facts.name).collect();
            let (how, own, known) = (self.volumetric.name(), self.law.name(), known.join(", "));
            let text =
                format!("is \"{how}\", and `{own}` has no energy of the volume alone; take {known}, or remove it");
            return problem(field, text);
        }
        match self.plane {
            PlaneState::Strain => Ok(()),
            PlaneState::Stress => problem(
                field,
                format!(
                    "is \"{}\", and in plane stress nothing holds the volume and no element locks; remove it",
                    self.volumetric.name()
                ),
            ),
        }
    }
}
