//! Forces on every part of a body, such as force fields. The table of a scene is the value itself.

use nalgebra::Vector3;
use serde::Deserialize;

use crate::numbers::{check_not_negative, check_positive, check_vector, problem};
use crate::{BodyMesh, Refusal, Viscosity};

/// Hands all of them, each as `table: Struct`, to another macro. Scenes, bodies and the engine read this list.
#[macro_export]
macro_rules! force_fields {
    ($callback:ident) => {
        $callback! {
            /// `[central_gravity]`
            central_gravity: CentralGravity,
            /// `[viscosity]`
            viscosity: Viscosity,
        }
    };
}

/// The force fields of a body, as lists of each kind.
macro_rules! lists {
    ($($(#[$doc:meta])* $table:ident: $Field:ident,)*) => {
        /// The force fields of a body.
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct ForceFields {
            $($(#[$doc])* pub $table: Vec<$Field>,)*
        }

        impl ForceFields {
            /// The scene's tables of the fields that are there.
            pub fn tables(&self) -> impl Iterator<Item = &'static str> {
                [$((stringify!($table), self.$table.is_empty())),*].into_iter().filter(|field| !field.1).map(|field| field.0)
            }

            /// Adds other fields.
            pub fn extend(&mut self, others: Self) {
                $(self.$table.extend(others.$table);)*
            }

            /// Refuses parameters that are out of range.
            pub fn check(&self) -> Result<(), Refusal> {
                $(self.$table.iter().try_for_each($Field::check)?;)*
                Ok(())
            }

            /// Refuses a field that is infinite on the undeformed body, or that moves a flat body out of its plane.
            pub fn check_on(&self, mesh: &BodyMesh) -> Result<(), Refusal> {
                $(self.$table.iter().try_for_each(|field| field.check_on(mesh))?;)*
                Ok(())
            }
        }

        $(impl From<$Field> for ForceFields {
            fn from(field: $Field) -> Self {
                let mut fields = Self::default();
                fields.$table.push(field);
                fields
            }
        })*
    };
}

force_fields! { lists }

/// `[central_gravity]`: gravity towards a point, as of a planet: the acceleration −μ d/(|d|² + ε²)^(3/2) of every part of the body, where d
/// is the vector from the point. Engine only.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct CentralGravity {
    /// The point, m. That of a flat body has z = 0.
    pub center: [f64; 3],
    /// μ, the constant of gravitation times the mass in the point, m³/s²; positive. At a distance r far above ε the acceleration is μ/r².
    pub strength: f64,
    /// Softening length ε, m: the force is largest at a distance of ε/√2 and zero at the point, where without softening it is infinite. At
    /// least 0.
    #[serde(default)]
    pub softening: f64,
}

impl CentralGravity {
    /// Gravity of this strength, m³/s², towards a point, m, without softening.
    pub fn new(center: [f64; 3], strength: f64) -> Self {
        Self { center, strength, softening: 0.0 }
    }

    fn check(&self) -> Result<(), Refusal> {
        check_vector("central_gravity.center", &self.center)?;
        check_positive("central_gravity.strength", self.strength, " of m³/s²")?;
        check_not_negative("central_gravity.softening", self.softening, "m")
    }

    fn check_on(&self, mesh: &BodyMesh) -> Result<(), Refusal> {
        if mesh.dimension() == 2 && self.center[2] != 0.0 {
            let text = format!(
                "has z = {}, and its force would move a flat body out of its plane; give z = 0",
                self.center[2]
            );
            return problem("central_gravity.center", text);
        }
        let distance = |x: &Vector3<f64>| (x - Vector3::from(self.center)).norm().hypot(self.softening);
        let is_singular = |x: &Vector3<f64>| distance(x).powi(3) < f64::MIN_POSITIVE;
        match mesh.vertices().iter().position(is_singular) {
            Some(node) => problem(
                "central_gravity.center",
                format!(
                    "lies on node {node}, where the force is infinite; move it, or give central_gravity.softening a length in m"
                ),
            ),
            None => Ok(()),
        }
    }
}
