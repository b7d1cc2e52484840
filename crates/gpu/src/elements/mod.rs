//! Linear tetrahedra on a device: their shapes, and their constitutive law as functions of a shader.

/// Linear tetrahedra.
#[derive(Clone, Debug, Default)]
pub struct Tetrahedra {
    /// Nodes of each element.
    pub corners: Vec<[u32; 4]>,
    /// Gradients of the shape functions of the last three corners of each element, 1/m.
    pub gradients: Vec<[[f64; 3]; 3]>,
    /// Volume of each element, m³.
    pub volumes: Vec<f64>,
}

impl Tetrahedra {
    /// Their corners in four lists, see `elements.wgsl`.
    pub(crate) fn corner_lists(&self) -> Vec<u32> {
        lists(4, self.corners.len(), |k, e| self.corners[e][k])
    }

    /// Gradients and volumes in ten lists.
    pub(crate) fn shape_lists(&self) -> Vec<f64> {
        let entry = |k: usize, e: usize| if k < 9 { self.gradients[e][k / 3][k % 3] } else { self.volumes[e] };
        lists(10, self.corners.len(), entry)
    }
}

/// The constitutive laws that are implemented on a device. Their parameters are μ and λ, or C and D of the neo-Hookean law, Pa.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // the names are those of the laws
pub enum Law {
    Linear,
    Corotated,
    StVenantKirchhoff,
    NeoHookean,
    StableNeoHookean,
}

impl Law {
    /// Returns true if elements may be inverted.
    pub(crate) fn allows_inversion(self) -> bool {
        self != Self::NeoHookean
    }

    /// Functions of the law for shaders, and those that they call.
    fn source(self) -> [&'static str; 2] {
        let of_invariants = include_str!("invariants.wgsl");
        match self {
            Self::Linear => ["", include_str!("laws/linear.wgsl")],
            Self::Corotated => ["", include_str!("laws/corotated.wgsl")],
            Self::StVenantKirchhoff => ["", include_str!("laws/st_venant_kirchhoff.wgsl")],
            Self::NeoHookean => [of_invariants, include_str!("laws/neo_hookean.wgsl")],
            Self::StableNeoHookean => [of_invariants, include_str!("laws/stable_neo_hookean.wgsl")],
        }
    }
}

/// A shader with its functions of tensors, of a law and of tetrahedra.
pub(crate) fn source(law: Law, rest: &str) -> String {
    let [calls, of_law] = law.source();
    [include_str!("tensors.wgsl"), calls, of_law, include_str!("elements.wgsl"), rest].join("\n")
}

/// `lists` lists of `length` entries each, one behind the other.
pub(crate) fn lists<T>(lists: usize, length: usize, entry: impl Fn(usize, usize) -> T) -> Vec<T> {
    let entry = &entry;
    (0..lists).flat_map(|list| (0..length).map(move |place| entry(list, place))).collect()
}
