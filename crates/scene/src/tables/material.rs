//! `[material]`: the constitutive law by its name, its parameters, and the density.

use crate::check::numbers::{Problem, check_finite, check_not_negative, check_positive, problem};

use super::{BoxTable, On, Selector, SphereTable};

/// The laws: the name of each, and the sets of parameters of which a scene gives one.
pub const MODELS: &[Model] = &[
    ("linear", &[ELASTIC]),
    ("corotated", &[ELASTIC]),
    ("st_venant_kirchhoff", &[ELASTIC]),
    ("neo_hookean", &[&["C", "D"], ELASTIC]),
    ("stable_neo_hookean", &[ELASTIC]),
    ("hencky", &[ELASTIC]),
    ("mooney_rivlin", &[&["C10", "C01", "D"]]),
    ("yeoh", &[&["C1", "C2", "C3", "D"]]),
];

/// The model without a constitutive law, in which every edge of the mesh is a spring.
const MASS_SPRING: Model =
    ("mass_spring", &[&["stiffness"], &["young"], &["stiffness", "damping"], &["young", "damping"]]);

/// A name, and the sets of parameters of which a scene gives one.
type Model = (&'static str, &'static [&'static [&'static str]]);

/// The laws, and the model without one.
fn models() -> impl Iterator<Item = &'static Model> {
    MODELS.iter().chain(std::iter::once(&MASS_SPRING))
}

/// Poisson's ratio above which linear tetrahedra lock visibly.
const LOCKS_ABOVE: f64 = 0.45;

/// Laws with a form for plane stress.
pub(crate) const IN_PLANE_STRESS: [&str; 2] = ["linear", "corotated"];

/// State of a flat body across its plane.
#[derive(Clone, Copy, Debug, Default, serde::Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum PlaneState {
    /// Plane strain: the thickness stays as it is, and a stress acts across the plane.
    #[default]
    Strain,
    /// Plane stress: no stress acts across the plane, and the thickness changes, as in a thin sheet. The laws `linear` and `corotated` have
    /// it, without plastic flow.
    Stress,
}

/// Young's modulus and Poisson's ratio of small strain.
const ELASTIC: &[&str] = &["young", "poisson"];

/// The table as a struct, with a list of its parameters: `name: range`, where `range` is a function that checks a number.
macro_rules! material {
    ($($(#[$doc:meta])* $name:ident: $range:ident),* $(,)?) => {
        /// `[[materials]]`: another material than `[material]` for a part of the body, named by one selector. The last table that names an
        /// element counts. Engine only, and not with `mass_spring`.
        #[derive(Clone, Debug, serde::Deserialize, PartialEq)]
        #[serde(deny_unknown_fields)]
        pub struct MaterialsTable {
            /// All elements, or those whose centroid lies near one side of the mesh.
            pub on: Option<On>,
            /// The elements whose centroid lies in a box.
            #[serde(rename = "box")]
            pub cuboid: Option<BoxTable>,
            /// The elements whose centroid lies in a sphere.
            pub sphere: Option<SphereTable>,
            /// The elements of a named set of the mesh.
            pub set: Option<String>,
            /// Constitutive law, by its name.
            pub model: String,
            /// Density, kg/m³: mass per undeformed volume; positive.
            pub density: f64,
            $($(#[$doc])* pub $name: Option<f64>,)*
        }

        impl MaterialsTable {
            /// The material without its place.
            pub fn material(&self) -> Material {
                Material { model: self.model.clone(), density: self.density, thickness: None, plane: None, $($name: self.$name,)* }
            }
        }

        /// `[material]`: the constitutive law of the body, the parameters of that law and no others, and the density.
        #[derive(Clone, Debug, serde::Deserialize, PartialEq)]
        #[serde(deny_unknown_fields)]
        pub struct Material {
            /// Constitutive law, by its name, or `"mass_spring"` for springs in place of elastic elements. The pipeline `"course"` has
            /// `"neo_hookean"` alone.
            pub model: String,
            /// Density, kg/m³: mass per undeformed volume; positive.
            pub density: f64,
            /// Thickness of a flat body, m; positive. Engine only. Default: 1.
            pub thickness: Option<f64>,
            /// State of a flat body across its plane. Engine only. Default: `"strain"`.
            pub plane: Option<PlaneState>,
            $($(#[$doc])* pub $name: Option<f64>,)*
        }

        impl Material {
            /// The parameters that the table gives, in the order of its fields.
            pub fn parameters(&self) -> impl Iterator<Item = (&'static str, f64)> {
                let all = [$((stringify!($name), self.$name)),*];
                all.into_iter().filter_map(|(name, value)| Some((name, value?)))
            }

            fn check_ranges(&self, table: &str) -> Result<(), Problem> {
                $(if let Some(value) = self.$name {
                    $range(&format!("{table}.{}", stringify!($name)), value)?;
                })*
                Ok(())
            }
        }
    };
}

material! {
    /// Young's modulus at small strain, Pa; positive.
    young: positive,
    /// Poisson's ratio at small strain, above −1 and below 0.5. Linear tetrahedra lock above 0.45, and a warning says so.
    poisson: poissons_ratio,
    /// Neo-Hookean: half the shear modulus at small strain, Pa; positive.
    C: positive,
    /// Mooney–Rivlin: factor of Ī1 − 3, Pa.
    C10: finite,
    /// Mooney–Rivlin: factor of Ī2 − 3, Pa.
    C01: finite,
    /// Yeoh: half the shear modulus at small strain, Pa; positive.
    C1: positive,
    /// Yeoh: factor of (Ī1 − 3)², Pa.
    C2: finite,
    /// Yeoh: factor of (Ī1 − 3)³, Pa.
    C3: finite,
    /// Half the bulk modulus at small strain, Pa; positive.
    D: positive,
    /// Mass-spring: stiffness of every edge, N/m; positive. With `young` in its place an edge of length l has the stiffness E ΣV/l², summed
    /// over its elements.
    stiffness: spring_stiffness,
    /// Mass-spring: damping along every edge, N s/m; at least 0. Default: 0.
    damping: spring_damping,
}

impl MaterialsTable {
    /// The selectors that the table gives; exactly one in a checked scene.
    pub fn selectors(&self) -> Vec<Selector> {
        Selector::of_keys(&self.on, &self.cuboid, &self.sphere, &self.set)
    }
}

impl Material {
    /// Lamé's constants μ = E/(2(1+ν)) and λ = Eν/((1+ν)(1−2ν)), Pa, of `young` and `poisson`. In plane stress, λ is that of the law after
    /// the strain across the plane has been eliminated, 2λμ/(λ+2μ) = Eν/(1−ν²): Timoshenko and Goodier, Theory of Elasticity (1970), §15 f.
    pub fn lame(&self) -> Option<(f64, f64)> {
        let (E, nu) = (self.young?, self.poisson?);
        let lambda = match self.plane.unwrap_or_default() {
            PlaneState::Strain => E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
            PlaneState::Stress => E * nu / ((1.0 + nu) * (1.0 - nu)),
        };
        Some((E / (2.0 * (1.0 + nu)), lambda))
    }

    /// Poisson's ratio at small strain: as given, or (3K − 2G)/(2(3K + G)) of the shear modulus G and the bulk modulus K = 2D.
    pub fn poissons_ratio(&self) -> Option<f64> {
        let half_shear = self.C.or(self.C1).or(self.C10.zip(self.C01).map(|(C10, C01)| C10 + C01));
        let of_moduli = |(C, D): (f64, f64)| (3.0 * D - 2.0 * C) / (2.0 * (3.0 * D + C));
        self.poisson.or_else(|| half_shear.zip(self.D).map(of_moduli))
    }

    /// Returns true if every edge of the mesh is a spring, and no element is elastic.
    pub fn is_mass_spring(&self) -> bool {
        self.model == MASS_SPRING.0
    }

    /// Returns true if linear tetrahedra lock: Poisson's ratio is above 0.45.
    pub fn locks(&self) -> bool {
        self.poissons_ratio().is_some_and(|poisson| poisson > LOCKS_ABOVE)
    }

    /// C and D, Pa: as given, or those with the same small-strain moduli as `young` and `poisson`,
    /// C = E/(4(1+ν)) and D = E/(6(1−2ν)).
    pub fn neo_hookean(&self) -> Option<(f64, f64)> {
        match (self.C, self.D, self.young, self.poisson) {
            (Some(C), Some(D), _, _) => Some((C, D)),
            (_, _, Some(E), Some(nu)) => Some((E / (4.0 * (1.0 + nu)), E / (6.0 * (1.0 - 2.0 * nu)))),
            _ => None,
        }
    }

    /// Checks the material of a table, such as `material` or `materials[0]`.
    pub(crate) fn check(&self, table: &str) -> Result<(), Problem> {
        check_positive(&format!("{table}.density"), self.density, " of kg/m³")?;
        self.thickness.map_or(Ok(()), |thickness| check_positive(&format!("{table}.thickness"), thickness, " of m"))?;
        let Some((_, sets)) = models().find(|(name, _)| *name == self.model) else {
            let known: Vec<_> = models().map(|(name, _)| *name).collect();
            let text = format!("is `{}`, which is no law; write one of {}", self.model, known.join(", "));
            return problem(&format!("{table}.model"), text);
        };
        let given: Vec<&str> = self.parameters().map(|(name, _)| name).collect();
        let foreign: Vec<&str> =
            given.iter().copied().filter(|name| !sets.iter().any(|set| set.contains(name))).collect();
        if let [first, rest @ ..] = &foreign[..] {
            let rest: String = rest.iter().map(|name| format!("and {name} ")).collect();
            let verb = if rest.is_empty() { "belongs" } else { "belong" };
            let (owners, own) = (models_with(&foreign), alternatives(sets));
            return problem(&format!("{table}.{first}"), format!("{rest}{verb} to {owners}; give this model {own}"));
        }
        if !sets.iter().any(|set| set.len() == given.len() && is_subset(&given, set)) {
            let own = alternatives(sets);
            return match sets {
                [_] => problem(table, format!("needs {own}; give these and no others")),
                _ => {
                    let kind = if sets.iter().all(|set| set.len() == 2) { "pair" } else { "set" };
                    problem(table, format!("needs either {own}; give one {kind} and only one"))
                }
            };
        }
        self.check_ranges(table)
    }
}

fn is_subset(names: &[&str], of: &[&str]) -> bool {
    names.iter().all(|name| of.contains(name))
}

/// `C and D or young and poisson`
fn alternatives(sets: &[&[&str]]) -> String {
    sets.iter().map(|set| set.join(" and ")).collect::<Vec<_>>().join(" or ")
}

/// The models that take all these parameters together, or else the first of them.
fn models_with(names: &[&str]) -> String {
    let with = |names: &[&str]| -> Vec<&str> {
        let takes = |sets: &[&[&str]]| sets.iter().any(|set| is_subset(names, set));
        models().filter(|(_, sets)| takes(sets)).map(|(name, _)| *name).collect()
    };
    let all = with(names);
    if all.is_empty() { with(&names[..1]).join(", ") } else { all.join(", ") }
}

fn positive(field: &str, value: f64) -> Result<(), Problem> {
    check_positive(field, value, " of Pa")
}

fn spring_stiffness(field: &str, value: f64) -> Result<(), Problem> {
    check_positive(field, value, " of N/m")
}

fn spring_damping(field: &str, value: f64) -> Result<(), Problem> {
    check_not_negative(field, value, "N s/m")
}

fn finite(field: &str, value: f64) -> Result<(), Problem> {
    check_finite(field, &[value])
}

fn poissons_ratio(field: &str, value: f64) -> Result<(), Problem> {
    if value > -1.0 && value < 0.5 {
        return Ok(());
    }
    problem(field, format!("is {value}; Poisson's ratio lies above -1 and below 0.5"))
}
