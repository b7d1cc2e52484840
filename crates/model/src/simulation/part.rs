//! Parts of a simulation that a scene builds or leaves out.

/// One part of a simulation: built, or left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Short name, also its key in the statistics file.
    pub name: &'static str,
    /// True if the scene builds it.
    pub built: bool,
    /// The part's purpose, and the key of the scene that builds it or leaves it out.
    pub why: String,
    /// Memory that it occupies, bytes.
    pub bytes: usize,
    /// Number of uses so far.
    pub uses: usize,
    /// Wall-clock time spent in it so far, s.
    pub seconds: f64,
}

impl Part {
    /// A part that the scene builds. `(uses, seconds)` is what a [`Timer`](crate::Timer) reads.
    pub fn built(name: &'static str, why: impl Into<String>, bytes: usize, (uses, seconds): (usize, f64)) -> Self {
        Self { name, built: true, why: why.into(), bytes, uses, seconds }
    }

    /// A part that the scene leaves out.
    pub fn left_out(name: &'static str, why: impl Into<String>) -> Self {
        Self { name, built: false, why: why.into(), bytes: 0, uses: 0, seconds: 0.0 }
    }

    /// Nodes and elements, which are tetrahedra or triangles.
    pub fn mesh(nodes: usize, elements: usize, kind: &str, bytes: usize) -> Self {
        Self::built("mesh", format!("[mesh]: {nodes} nodes, {elements} {kind}"), bytes, (0, 0.0))
    }

    /// The scene's drag; `is_in_stiffness` tells if the stiffness contains its spring.
    pub fn drag(is_built: bool, is_in_stiffness: bool, used: (usize, f64)) -> Self {
        if is_built {
            let why = match is_in_stiffness {
                true => "[drag]: a spring in force and stiffness",
                false => "[drag]: a spring in the force, not in the stiffness (drag.in_stiffness)",
            };
            Self::built("drag", why, 0, used)
        } else {
            Self::left_out("drag", "the scene has no [drag]; the mouse can pull in the window all the same")
        }
    }

    /// The weights of the display surface; `bytes` is their size, `None` if the scene has no display surface.
    pub fn skinning(bytes: Option<usize>, used: (usize, f64)) -> Self {
        match bytes {
            Some(bytes) => Self::built("skinning", "mesh.display: four weights for each display vertex", bytes, used),
            None => Self::left_out("skinning", "the scene has no mesh.display, so the elements are shown"),
        }
    }
}
