//! `[material]`: the constitutive law by its name, its parameters, and the density.

use fem_model::numbers::{check_positive, problem};
use fem_model::{Law, LawFacts, Material, PlaneState, Refusal, Selector, Volumetric};

use super::selector::of_keys;
use super::{BoxTable, On, SphereTable};

/// The table as a struct, with a list of its parameters.
macro_rules! material {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {
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
            /// Evaluation of the energy of the volume. Default: `"standard"`.
            pub volumetric: Option<Volumetric>,
            $($(#[$doc])* pub $name: Option<f64>,)*
        }

        impl MaterialsTable {
            /// The material without its place.
            pub fn material(&self) -> MaterialTable {
                MaterialTable { model: self.model.clone(), density: self.density, thickness: None, plane: None, volumetric: self.volumetric, $($name: self.$name,)* }
            }
        }

        /// `[material]`: the constitutive law of the body, the parameters of that law and no others, and the density.
        #[derive(Clone, Debug, Default, serde::Deserialize, PartialEq)]
        #[serde(deny_unknown_fields)]
        pub struct MaterialTable {
            /// Constitutive law, by its name, or `"mass_spring"` for springs in place of elastic elements. The pipeline `"course"` has
            /// `"neo_hookean"` alone.
            pub model: String,
            /// Density, kg/m³: mass per undeformed volume; positive.
            pub density: f64,
            /// Thickness of a flat body, m; positive. Engine only. Default: 1.
            pub thickness: Option<f64>,
            /// State of a flat body across its plane. Engine only. Default: `"strain"`.
            pub plane: Option<PlaneState>,
            /// Evaluation of the energy of the volume. Engine only. Default: `"standard"`.
            pub volumetric: Option<Volumetric>,
            $($(#[$doc])* pub $name: Option<f64>,)*
        }

        impl MaterialTable {
            /// The parameters that the table gives, in the order of its fields.
            pub fn parameters(&self) -> impl Iterator<Item = (&'static str, f64)> {
                let all = [$((stringify!($name), self.$name)),*];
                all.into_iter().filter_map(|(name, value)| Some((name, value?)))
            }
        }
    };
}

fem_model::law_parameters! { material }

impl MaterialsTable {
    /// The selectors that the table gives; exactly one in a checked scene.
    pub fn selectors(&self) -> Vec<Selector> {
        of_keys(&self.on, &self.cuboid, &self.sphere, &self.set, &None)
    }
}

impl MaterialTable {
    /// The material of a checked table.
    pub fn value(&self) -> Material {
        let given = |name: &str| self.parameters().find(|(own, _)| *own == name).map(|(_, value)| value);
        let law = (Law::named(&self.model).unwrap_or(Law::SPRINGS).of)(&given);
        Material {
            law,
            density: self.density,
            plane: self.plane.unwrap_or_default(),
            volumetric: self.volumetric.unwrap_or_default(),
        }
    }

    /// Returns true if every edge of the mesh is a spring, and no element is elastic.
    pub fn is_mass_spring(&self) -> bool {
        self.model == Law::SPRINGS.name
    }

    /// Checks the material of a table, such as `material` or `materials[0]`.
    pub(crate) fn check(&self, table: &str) -> Result<(), Refusal> {
        check_positive(&format!("{table}.density"), self.density, " of kg/m³")?;
        self.thickness.map_or(Ok(()), |thickness| check_positive(&format!("{table}.thickness"), thickness, " of m"))?;
        let Some(LawFacts { parameters: sets, .. }) = Law::named(&self.model) else {
            let known: Vec<_> = Law::all_facts().map(|facts| facts.name).collect();
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
        if let (Some(lambda), Some(mu)) = (self.lambda, self.mu) {
            check_positive(&format!("{table}.mu"), mu, " of Pa")?;
            if !(3.0 * lambda + 2.0 * mu > 0.0 && lambda.is_finite()) {
                return problem(&format!("{table}.lambda"), format!("is {lambda:e} Pa; give more than -2/3 of mu"));
            }
        }
        self.value().check(table)
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
        Law::all_facts().filter(|facts| takes(facts.parameters)).map(|facts| facts.name).collect()
    };
    let all = with(names);
    if all.is_empty() { with(&names[..1]).join(", ") } else { all.join(", ") }
}
