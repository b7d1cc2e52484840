//! Constitutive laws with their parameters, and what is known about each.

use crate::elastic::{Elastic, PlaneState};

/// A constitutive law with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Hooke's law of the small strain.
    Linear(Elastic),
    /// Hooke's law in axes that turn with each element.
    Corotated(Elastic),
    /// Hooke's law of Green's strain.
    StVenantKirchhoff(Elastic),
    /// Compressible neo-Hookean.
    NeoHookean(NeoHookean),
    /// Neo-Hookean that is defined for inverted elements.
    StableNeoHookean(Elastic),
    /// Hooke's law of the logarithmic strain.
    Hencky(Elastic),
    /// Mooney–Rivlin.
    MooneyRivlin {
        /// Factor of Ī1 − 3, Pa.
        C10: f64,
        /// Factor of Ī2 − 3, Pa.
        C01: f64,
        /// Half the bulk modulus at small strain, Pa.
        D: f64,
    },
    /// Yeoh.
    Yeoh {
        /// Half the shear modulus at small strain, Pa.
        C1: f64,
        /// Factor of (Ī1 − 3)², Pa.
        C2: f64,
        /// Factor of (Ī1 − 3)³, Pa.
        C3: f64,
        /// Half the bulk modulus at small strain, Pa.
        D: f64,
    },
    /// Gent.
    Gent {
        /// Half the shear modulus at small strain, Pa.
        C: f64,
        /// Ī1 − 3 at which the stress has no bound.
        Jm: f64,
        /// Half the bulk modulus at small strain, Pa.
        D: f64,
    },
    /// Ogden.
    Ogden {
        /// μ, Pa, and α of each term.
        terms: [Option<[f64; 2]>; 3],
        /// Half the bulk modulus at small strain, Pa.
        D: f64,
    },
    /// No law: every edge of the mesh is a spring.
    MassSpring {
        /// Stiffness of the edges.
        stiffness: EdgeStiffness,
        /// Coefficient of the damper along every edge, N s/m.
        damping: f64,
    },
}

/// Hands all parameters of laws, with their documentation, to another macro.
#[macro_export]
macro_rules! law_parameters {
    ($callback:ident) => {
        $callback! {
            /// Young's modulus at small strain, Pa; positive.
            young,
            /// Poisson's ratio at small strain, above −1 and below 0.5, or 0.5 with `volumetric = "mixed"`. Linear tetrahedra lock above 0.45, and a warning says so.
            poisson,
            /// Lamé's first constant λ at small strain, Pa, above −2μ/3; with `mu` in place of `young` and `poisson`.
            lambda,
            /// Lamé's second constant μ at small strain, the shear modulus, Pa; positive.
            mu,
            /// Neo-Hookean and Gent: half the shear modulus at small strain, Pa; positive.
            C,
            /// Mooney–Rivlin: factor of Ī1 − 3, Pa.
            C10,
            /// Mooney–Rivlin: factor of Ī2 − 3, Pa.
            C01,
            /// Yeoh: half the shear modulus at small strain, Pa; positive.
            C1,
            /// Yeoh: factor of (Ī1 − 3)², Pa.
            C2,
            /// Yeoh: factor of (Ī1 − 3)³, Pa.
            C3,
            /// Gent: the limit of Ī1 − 3, at which the stress has no bound; positive.
            Jm,
            /// Ogden: factor of the first term, Pa. The shear modulus at small strain, Σ μ α/2 over the terms, is positive.
            mu1,
            /// Ogden: exponent of the stretches in the first term; not zero.
            alpha1,
            /// Ogden: factor of the second term, Pa.
            mu2,
            /// Ogden: exponent of the second term; not zero.
            alpha2,
            /// Ogden: factor of the third term, Pa.
            mu3,
            /// Ogden: exponent of the third term; not zero.
            alpha3,
            /// Half the bulk modulus at small strain, Pa; positive.
            D,
            /// Mass-spring: stiffness of every edge, N/m; positive. With `young` in its place an edge of length l has the stiffness E ΣV/l², summed
            /// over its elements.
            stiffness,
            /// Mass-spring: damping along every edge, N s/m; at least 0. Default: 0.
            damping,
        }
    };
}

/// The values of parameters by their names.
pub type Given<'a> = dyn Fn(&str) -> Option<f64> + 'a;

/// The properties of a law before it has parameters.
#[derive(Clone, Copy, Debug)]
pub struct LawFacts {
    /// The name in scene files.
    pub name: &'static str,
    /// The sets of parameters of which one is given.
    pub parameters: &'static [&'static [&'static str]],
    /// True if the law has a form for plane stress.
    pub has_plane_stress: bool,
    /// The energy of the volume, if the law is the sum of one and of an energy that does not depend on the volume.
    pub volume: Option<VolumeEnergy>,
    /// The law with given parameters; those that are missing are NaN, which [`Material::check`](crate::Material::check) refuses.
    pub of: fn(&Given) -> Law,
}

/// Young's modulus and Poisson's ratio of small strain.
const ELASTIC: &[&str] = &["young", "poisson"];

/// Lamé's constants in place of them.
const LAME: &[&str] = &["lambda", "mu"];

/// The names of an Ogden term's factor and exponent.
const OGDEN_TERMS: [[&str; 2]; 3] = [["mu1", "alpha1"], ["mu2", "alpha2"], ["mu3", "alpha3"]];

/// One, two or three terms.
const OGDEN: &[&[&str]] = &[
    &["mu1", "alpha1", "D"],
    &["mu1", "alpha1", "mu2", "alpha2", "D"],
    &["mu1", "alpha1", "mu2", "alpha2", "mu3", "alpha3", "D"],
];

/// Parameters of the neo-Hookean law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NeoHookean {
    /// Those with the same small-strain moduli: C = E/(4(1+ν)) and D = E/(6(1−2ν)).
    Elastic(Elastic),
    /// The law's own.
    Moduli {
        /// Half the shear modulus at small strain, Pa.
        C: f64,
        /// Half the bulk modulus at small strain, Pa.
        D: f64,
    },
}

/// Stiffness of the edges of a mass-spring body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EdgeStiffness {
    /// The same for every edge, N/m.
    Uniform(f64),
    /// E ΣV/l² of an edge of length l, summed over its elements, with Young's modulus E, Pa.
    Young(f64),
}

/// An energy of the volume, with the bulk modulus K.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VolumeEnergy {
    /// K/2 (tr G)², the law's J being 1 + tr G.
    Trace,
    /// K/2 (J − 1)².
    Change,
    /// K/2 (ln J)².
    Logarithm,
}

impl NeoHookean {
    /// C and D, Pa.
    pub fn moduli(self) -> [f64; 2] {
        match self {
            Self::Moduli { C, D } => [C, D],
            Self::Elastic(elastic @ Elastic { poisson: 0.5, .. }) => {
                let [mu, lambda] = elastic.lame(PlaneState::Strain);
                [0.5 * mu, 0.5 * lambda + mu / 3.0]
            }
            Self::Elastic(Elastic { young: E, poisson: nu }) => [E / (4.0 * (1.0 + nu)), E / (6.0 * (1.0 - 2.0 * nu))],
        }
    }
}

fn number(given: &Given, name: &str) -> f64 {
    given(name).unwrap_or(f64::NAN)
}

fn elastic(given: &Given) -> Elastic {
    match (given("lambda"), given("mu")) {
        (Some(lambda), Some(mu)) => Elastic::of_lame(lambda, mu),
        _ => Elastic::new(number(given, "young"), number(given, "poisson")),
    }
}

/// Σ μ α/2, Pa
fn ogden_shear_modulus(terms: &[Option<[f64; 2]>]) -> f64 {
    0.5 * terms.iter().flatten().map(|[mu, alpha]| mu * alpha).sum::<f64>()
}

fn ogden_terms(given: &Given) -> [Option<[f64; 2]>; 3] {
    let is_there = |names: &[&str; 2]| names[0] == "mu1" || names.iter().any(|name| given(name).is_some());
    OGDEN_TERMS.map(|names| is_there(&names).then(|| names.map(|name| number(given, name))))
}

impl Law {
    /// The constitutive laws.
    pub const FACTS: [LawFacts; 10] = {
        use VolumeEnergy::{Change, Logarithm, Trace};
        const fn of_elastic(
            name: &'static str,
            has_plane_stress: bool,
            volume: Option<VolumeEnergy>,
            of: fn(&Given) -> Law,
        ) -> LawFacts {
            LawFacts { name, parameters: &[ELASTIC, LAME], has_plane_stress, volume, of }
        }
        const fn of(
            name: &'static str,
            parameters: &'static [&'static [&'static str]],
            of: fn(&Given) -> Law,
        ) -> LawFacts {
            LawFacts { name, parameters, has_plane_stress: false, volume: Some(Change), of }
        }
        [
            of_elastic("linear", true, Some(Trace), |given| Self::Linear(elastic(given))),
            of_elastic("corotated", true, None, |given| Self::Corotated(elastic(given))),
            of_elastic("st_venant_kirchhoff", false, None, |given| Self::StVenantKirchhoff(elastic(given))),
            of("neo_hookean", &[&["C", "D"], ELASTIC, LAME], |given| {
                Self::NeoHookean(match (given("C"), given("D")) {
                    (Some(C), Some(D)) => NeoHookean::Moduli { C, D },
                    _ => NeoHookean::Elastic(elastic(given)),
                })
            }),
            of_elastic("stable_neo_hookean", false, None, |given| Self::StableNeoHookean(elastic(given))),
            of_elastic("hencky", false, Some(Logarithm), |given| Self::Hencky(elastic(given))),
            of("mooney_rivlin", &[&["C10", "C01", "D"]], |given| {
                let [C10, C01, D] = ["C10", "C01", "D"].map(|name| number(given, name));
                Self::MooneyRivlin { C10, C01, D }
            }),
            of("yeoh", &[&["C1", "C2", "C3", "D"]], |given| {
                let [C1, C2, C3, D] = ["C1", "C2", "C3", "D"].map(|name| number(given, name));
                Self::Yeoh { C1, C2, C3, D }
            }),
            of("gent", &[&["C", "Jm", "D"]], |given| {
                let [C, Jm, D] = ["C", "Jm", "D"].map(|name| number(given, name));
                Self::Gent { C, Jm, D }
            }),
            of("ogden", OGDEN, |given| Self::Ogden { terms: ogden_terms(given), D: number(given, "D") }),
        ]
    };

    /// Springs in place of a law.
    pub const SPRINGS: LawFacts = LawFacts {
        name: "mass_spring",
        parameters: &[&["stiffness"], &["young"], &["stiffness", "damping"], &["young", "damping"]],
        has_plane_stress: false,
        volume: None,
        of: |given| Self::MassSpring {
            stiffness: given("stiffness").map_or(EdgeStiffness::Young(number(given, "young")), EdgeStiffness::Uniform),
            damping: given("damping").unwrap_or(0.0),
        },
    };

    /// The laws, and springs in place of one.
    pub fn all_facts() -> impl Iterator<Item = LawFacts> {
        Self::FACTS.into_iter().chain([Self::SPRINGS])
    }

    /// The law, or springs, of that name.
    pub fn named(name: &str) -> Option<LawFacts> {
        Self::all_facts().find(|facts| facts.name == name)
    }

    /// The name in scene files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Linear(_) => "linear",
            Self::Corotated(_) => "corotated",
            Self::StVenantKirchhoff(_) => "st_venant_kirchhoff",
            Self::NeoHookean(_) => "neo_hookean",
            Self::StableNeoHookean(_) => "stable_neo_hookean",
            Self::Hencky(_) => "hencky",
            Self::MooneyRivlin { .. } => "mooney_rivlin",
            Self::Yeoh { .. } => "yeoh",
            Self::Gent { .. } => "gent",
            Self::Ogden { .. } => "ogden",
            Self::MassSpring { .. } => "mass_spring",
        }
    }

    /// Young's modulus and Poisson's ratio, where they are the law's parameters.
    pub fn elastic(&self) -> Option<Elastic> {
        match *self {
            Self::Linear(elastic)
            | Self::Corotated(elastic)
            | Self::StVenantKirchhoff(elastic)
            | Self::NeoHookean(NeoHookean::Elastic(elastic))
            | Self::StableNeoHookean(elastic)
            | Self::Hencky(elastic) => Some(elastic),
            Self::NeoHookean(NeoHookean::Moduli { .. }) | Self::MooneyRivlin { .. } | Self::Yeoh { .. } => None,
            Self::Gent { .. } | Self::Ogden { .. } | Self::MassSpring { .. } => None,
        }
    }

    /// The same law with other moduli, where they are its parameters; a mass-spring body takes Young's modulus alone.
    pub fn with_moduli(mut self, young: Option<f64>, poisson: Option<f64>) -> Self {
        match &mut self {
            Self::Linear(elastic)
            | Self::Corotated(elastic)
            | Self::StVenantKirchhoff(elastic)
            | Self::NeoHookean(NeoHookean::Elastic(elastic))
            | Self::StableNeoHookean(elastic)
            | Self::Hencky(elastic) => {
                elastic.young = young.unwrap_or(elastic.young);
                elastic.poisson = poisson.unwrap_or(elastic.poisson);
            }
            Self::MassSpring { stiffness: EdgeStiffness::Young(own), .. } => *own = young.unwrap_or(*own),
            Self::NeoHookean(NeoHookean::Moduli { .. }) | Self::MooneyRivlin { .. } | Self::Yeoh { .. } => {}
            Self::Gent { .. } | Self::Ogden { .. } => {}
            Self::MassSpring { stiffness: EdgeStiffness::Uniform(_), .. } => {}
        }
        self
    }

    /// The parameters with their names in scene files.
    pub fn parameters(&self) -> Vec<(&'static str, f64)> {
        if let Some(Elastic { young, poisson }) = self.elastic() {
            return vec![("young", young), ("poisson", poisson)];
        }
        match *self {
            Self::NeoHookean(law) => {
                let [C, D] = law.moduli();
                vec![("C", C), ("D", D)]
            }
            Self::MooneyRivlin { C10, C01, D } => vec![("C10", C10), ("C01", C01), ("D", D)],
            Self::Yeoh { C1, C2, C3, D } => vec![("C1", C1), ("C2", C2), ("C3", C3), ("D", D)],
            Self::Gent { C, Jm, D } => vec![("C", C), ("Jm", Jm), ("D", D)],
            Self::Ogden { terms, D } => {
                let of_terms = OGDEN_TERMS.into_iter().zip(terms).filter_map(|(names, term)| Some((names, term?)));
                let mut all: Vec<_> = of_terms.flat_map(|(names, term)| names.into_iter().zip(term)).collect();
                all.push(("D", D));
                all
            }
            Self::MassSpring { stiffness, damping } => {
                let stiffness = match stiffness {
                    EdgeStiffness::Uniform(stiffness) => ("stiffness", stiffness),
                    EdgeStiffness::Young(young) => ("young", young),
                };
                let damping = (damping != 0.0).then_some(("damping", damping));
                std::iter::once(stiffness).chain(damping).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Poisson's ratio at small strain: as given, or (3K − 2G)/(2(3K + G)) of the shear modulus G and the bulk modulus K = 2D. None for
    /// springs.
    pub fn poissons_ratio(&self) -> Option<f64> {
        let of_moduli = |C: f64, D: f64| (3.0 * D - 2.0 * C) / (2.0 * (3.0 * D + C));
        match *self {
            Self::NeoHookean(NeoHookean::Moduli { C, D }) | Self::Yeoh { C1: C, D, .. } | Self::Gent { C, D, .. } => {
                Some(of_moduli(C, D))
            }
            Self::MooneyRivlin { C10, C01, D } => Some(of_moduli(C10 + C01, D)),
            Self::Ogden { terms, D } => Some(of_moduli(0.5 * ogden_shear_modulus(&terms), D)),
            _ => self.elastic().map(|elastic| elastic.poisson),
        }
    }
}
