//! Assembly: the elements' vectors and matrices, and their places in the mesh.

use finite_elements_3d as solved;
use finite_elements_3d::given;
use grader_child::algebra;
use nalgebra::{DMatrix, DVector, SMatrix, Vector3};

use crate::diagnosis::switches::Switch;
use crate::reference::trial::{Input, Mesh, Observed, Trial};

type Block = DMatrix<f64>;

/// The decisions of an assembly.
#[derive(Clone, Copy)]
pub struct Settings {
    /// Indices of the elements that are added, of so many.
    elements: fn(usize) -> Vec<usize>,
    volume: fn(&[f64], usize) -> f64,
    /// The place of an element's volume, from its number and its vertices.
    volume_at: fn(usize, &[usize; 4]) -> usize,
    /// The place of the volume that an element's row is multiplied by instead, from its vertices and the row.
    volume_of_row: Option<fn(&[usize; 4], usize) -> usize>,
    positions: fn(&DVector<f64>, &[Vector3<f64>]) -> DVector<f64>,
    /// The element's vertices where its answer is placed.
    vertices: fn([usize; 4], usize) -> [usize; 4],
    /// The same for the columns.
    columns: fn([usize; 4]) -> [usize; 4],
    /// The row of a local coordinate, from the vertices and the number of rows.
    place: fn(&[usize; 4], usize, usize) -> usize,
    /// From the element's Hessian to what is added.
    projection: fn(&SMatrix<f64, 12, 12>) -> SMatrix<f64, 12, 12>,
    /// The entries of an element's answer that are added, with their values.
    entry: fn(&Block, usize, usize) -> f64,
    put: fn(f64, f64) -> f64,
    divided_by_valence: bool,
}

/// The assembly of the course.
pub const RIGHT: Settings = Settings {
    elements: |n| (0..n).collect(),
    volume: |v0, e| v0[e],
    volume_at: |e, _| e,
    volume_of_row: None,
    positions: |q, _| q.clone(),
    vertices: |element, _| element,
    columns: |vertices| vertices,
    place: |element, i, _| 3 * element[i / 3] + i % 3,
    projection: |H| -given::project(H),
    entry: |block, i, j| block[(i, j)],
    put: |sum, value| sum + value,
    divided_by_valence: false,
};

const ELEMENTS: &str = "Not every element is added once: compare the mass of the mesh with that of its elements.";
const VOLUMES: &str = "Elements have different volumes: `v0` runs along `T`.";
const PLACE: &str = "A single 3×3 block is right, its place is not: which rows of the mesh does a vertex have?";
const ORDER: &str = "The element's answer is right, but belongs to other vertices: in which order does it hold them?";
const PARTS: &str = "Only some of the element's entries are added: which pairs of its vertices interact?";
const PROJECTION: &str =
    "The eigenvalues of the element's matrix are changed in another way than by the projection that the course gives.";

/// The mistakes.
pub const SWITCHES: &[Switch<Settings>] = &[
    ("last element left out", ELEMENTS, |s| s.elements = |n| (0..n.saturating_sub(1)).collect()),
    ("first element left out", ELEMENTS, |s| s.elements = |n| (1..n).collect()),
    ("only the first element", ELEMENTS, |s| s.elements = |_| vec![0]),
    ("only the last element", ELEMENTS, |s| s.elements = |n| vec![n - 1]),
    ("every other element", ELEMENTS, |s| s.elements = |n| (0..n).step_by(2).collect()),
    ("first element twice", ELEMENTS, |s| s.elements = |n| (0..n).chain([0]).collect()),
    ("first volume for all", VOLUMES, |s| s.volume = |v0, _| v0[0]),
    ("last volume for all", VOLUMES, |s| s.volume = |v0, _| v0[v0.len() - 1]),
    ("mean volume for all", VOLUMES, |s| s.volume = |v0, _| v0.iter().sum::<f64>() / v0.len() as f64),
    ("whole volume for all", VOLUMES, |s| s.volume = |v0, _| v0.iter().sum()),
    ("missing volume", VOLUMES, |s| s.volume = |_, _| 1.0),
    ("volume squared", VOLUMES, |s| s.volume = |v0, e| v0[e] * v0[e]),
    ("volume of the next element", VOLUMES, |s| s.volume = |v0, e| v0[(e + 1) % v0.len()]),
    ("volumes by vertex", VOLUMES, |s| s.volume_at = |_, vertices| vertices[0]),
    ("volumes by vertex", VOLUMES, |s| s.volume_of_row = Some(|vertices, i| vertices[i / 3])),
    ("volumes by local vertex", VOLUMES, |s| s.volume_of_row = Some(|_, i| i / 3)),
    ("volumes in reverse", VOLUMES, |s| s.volume = |v0, e| v0[v0.len() - 1 - e]),
    (
        "rest for deformed",
        "The answer is that of a body at rest. From which positions is the deformation gradient computed?",
        |s| {
            s.positions = |q, V| DVector::from_fn(q.len(), |i, _| V[i / 3][i % 3]);
        },
    ),
    (
        "local for global indices",
        "All elements are added to the first twelve rows: which vertices of the mesh does an element have?",
        |s| {
            s.vertices = |_, _| [0, 1, 2, 3];
        },
    ),
    (
        "local for global indices in the columns",
        "The rows are right: which vertices of the mesh do the columns belong to?",
        |s| {
            s.columns = |_| [0, 1, 2, 3];
        },
    ),
    ("sorted vertices", ORDER, |s| {
        s.vertices = |mut element, _| {
            element.sort_unstable();
            element
        };
    }),
    ("wrong vertex order", ORDER, |s| s.vertices = |[a, b, c, d], _| [d, c, b, a]),
    ("wrong vertex order", ORDER, |s| s.vertices = |[a, b, c, d], _| [b, a, c, d]),
    ("wrong vertex order", ORDER, |s| s.vertices = |[a, b, c, d], _| [a, c, b, d]),
    ("wrong vertex order", ORDER, |s| s.vertices = |[a, b, c, d], _| [a, b, d, c]),
    ("wrong vertex order", ORDER, |s| s.vertices = |[a, b, c, d], _| [b, c, d, a]),
    ("wrong vertex order", ORDER, |s| s.vertices = |[a, b, c, d], _| [d, a, b, c]),
    ("last vertex taken for the first", ORDER, |s| s.vertices = |[a, b, c, _], _| [a, b, c, a]),
    ("one vertex for all", ORDER, |s| s.vertices = |[a, ..], _| [a; 4]),
    ("factor 3 left out of the place", PLACE, |s| s.place = |element, i, _| element[i / 3] + i % 3),
    ("vertices for rows", PLACE, |s| s.place = |element, i, _| element[i / 3]),
    ("grouped by coordinate", PLACE, |s| s.place = |element, i, size| element[i / 3] + size / 3 * (i % 3)),
    ("all coordinates in one row", PLACE, |s| s.place = |element, i, _| 3 * element[i / 3]),
    ("coordinates in reverse", PLACE, |s| s.place = |element, i, _| 3 * element[i / 3] + 2 - i % 3),
    (
        "element's rows grouped by coordinate",
        "An element's rows are read as all x first: in which order does the element's answer hold them?",
        |s| {
            s.place = |element, i, _| 3 * element[i % 4] + i / 4;
        },
    ),
    (
        "transposed",
        "Single 3×3 blocks are transposed. Only the whole matrix is symmetric, its blocks one by one are not.",
        |s| {
            s.entry = |block, i, j| {
                if block.ncols() == 1 { block[(i, j)] } else { block[(i / 3 * 3 + j % 3, j / 3 * 3 + i % 3)] }
            };
        },
    ),
    ("only the element's diagonal", PARTS, |s| s.entry = |block, i, j| if i == j { block[(i, j)] } else { 0.0 }),
    ("only the element's diagonal blocks", PARTS, |s| {
        s.entry = |block, i, j| if i / 3 == j / 3 { block[(i, j)] } else { 0.0 }
    }),
    ("element's diagonal blocks left out", PARTS, |s| {
        s.entry = |block, i, j| if i / 3 != j / 3 { block[(i, j)] } else { 0.0 }
    }),
    ("only the element's upper triangle", PARTS, |s| s.entry = |block, i, j| if i <= j { block[(i, j)] } else { 0.0 }),
    ("only the element's lower triangle", PARTS, |s| s.entry = |block, i, j| if i >= j { block[(i, j)] } else { 0.0 }),
    ("only the element's upper blocks", PARTS, |s| {
        s.entry = |block, i, j| if i / 3 <= j / 3 { block[(i, j)] } else { 0.0 }
    }),
    ("only the element's lower blocks", PARTS, |s| {
        s.entry = |block, i, j| if i / 3 >= j / 3 { block[(i, j)] } else { 0.0 }
    }),
    ("element's diagonal doubled", PARTS, |s| {
        s.entry = |block, i, j| if i == j { 2.0 * block[(i, j)] } else { block[(i, j)] }
    }),
    ("only the first vertex of each element", PARTS, |s| {
        s.entry = |block, i, j| if i < 3 && j < 3 { block[(i, j)] } else { 0.0 }
    }),
    ("last vertex of each element left out", PARTS, |s| {
        s.entry = |block, i, j| if i < 9 && j < 9 { block[(i, j)] } else { 0.0 }
    }),
    ("first vertex of each element left out", PARTS, |s| {
        s.entry = |block, i, j| if i > 2 && (j > 2 || block.ncols() == 1) { block[(i, j)] } else { 0.0 };
    }),
    ("only x", PARTS, |s| s.entry = |block, i, j| if i % 3 == 0 && j % 3 == 0 { block[(i, j)] } else { 0.0 }),
    ("z left out", PARTS, |s| s.entry = |block, i, j| if i % 3 != 2 && j % 3 != 2 { block[(i, j)] } else { 0.0 }),
    ("coordinates not kept apart", PARTS, |s| s.entry = |block, i, j| block[(i / 3 * 3, j / 3 * 3)]),
    ("absolute values", PARTS, |s| s.entry = |block, i, j| block[(i, j)].abs()),
    ("absolute values with the sign of a force", PARTS, |s| s.entry = |block, i, j| -block[(i, j)].abs()),
    (
        "lumped",
        "The mass is concentrated at the vertices. Which integral of two shape functions does a consistent mass matrix hold?",
        |s| {
            s.entry = |block, i, j| if i == j { block.row(i).sum() } else { 0.0 };
        },
    ),
    ("not projected", "Fine until the first strong compression: the element matrices are added as they are.", |s| {
        s.projection = |H| -H
    }),
    (
        "projected after the minus",
        "The stiff directions are gone: which sign do they have at the moment of projection?",
        |s| {
            s.projection = |H| given::project(&-H);
        },
    ),
    ("projected twice", PROJECTION, |s| s.projection = |H| -given::project(&-given::project(H))),
    ("absolute eigenvalues", PROJECTION, |s| s.projection = |H| -with_eigenvalues(H, f64::abs)),
    ("eigenvalues cut off above", PROJECTION, |s| s.projection = |H| -with_eigenvalues(H, |value| value.min(0.0))),
    ("eigenvalues raised above zero", PROJECTION, |s| s.projection = |H| -raised(H, 1e-1)),
    ("eigenvalues raised above zero", PROJECTION, |s| s.projection = |H| -raised(H, 1e-2)),
    ("eigenvalues raised above zero", PROJECTION, |s| s.projection = |H| -raised(H, 1e-3)),
    ("eigenvalues raised above zero", PROJECTION, |s| s.projection = |H| -raised(H, 1e-4)),
    ("negative entries cut off", PROJECTION, |s| s.projection = |H| -H.map(|entry| entry.max(0.0))),
    ("negative diagonal cut off", PROJECTION, |s| {
        s.projection = |H| -SMatrix::<f64, 12, 12>::from_fn(|i, j| if i == j { H[(i, j)].max(0.0) } else { H[(i, j)] });
    }),
    (
        "overwritten instead of added",
        "A single element is right, elements that share a vertex are not: what happens to the entries that are there already?",
        |s| {
            s.put = |_, value| value;
        },
    ),
    (
        "first contribution kept",
        "A single element is right, elements that share a vertex are not: only the first contribution to an entry counts.",
        |s| {
            s.put = |sum, value| if sum == 0.0 { value } else { sum };
        },
    ),
    (
        "largest contribution kept",
        "A single element is right, elements that share a vertex are not: which of their contributions counts?",
        |s| {
            s.put = |sum, value| if value.abs() > f64::abs(sum) { value } else { sum };
        },
    ),
    ("mean of the elements", "Elements that share a vertex add up; their mean is something else.", |s| {
        s.divided_by_valence = true
    }),
];

/// The matrix with changed eigenvalues.
pub fn with_eigenvalues(H: &SMatrix<f64, 12, 12>, change: impl Fn(f64) -> f64) -> SMatrix<f64, 12, 12> {
    let mut eigen = algebra::eigen(H);
    eigen.eigenvalues.apply(|value| *value = change(*value));
    eigen.recompose()
}

fn raised(H: &SMatrix<f64, 12, 12>, share: f64) -> SMatrix<f64, 12, 12> {
    let floor = share * algebra::eigenvalues_of_element(H).amax();
    with_eigenvalues(H, |value| value.max(floor))
}

/// The volume that an element is given; `None` if the list has none there.
fn volume_of(s: &Settings, v0: &[f64], T: &[[usize; 4]], index: usize) -> Option<f64> {
    let place = (s.volume_at)(index, &T[index]);
    (place < v0.len()).then(|| (s.volume)(v0, place))
}

/// Contribution of an element: a column for forces, a matrix otherwise.
fn of_element(s: &Settings, trial: &Trial, index: usize) -> Option<Block> {
    match &trial.input {
        Input::MeshMass { density, v0, T, .. } => {
            let M = solved::mass_matrix_linear_tetrahedron(*density, volume_of(s, v0, T, index)?);
            Some(Block::from_fn(12, 12, |i, j| M[(i, j)]))
        }
        Input::Mesh(Mesh { q, V, T, v0, C, D }) => {
            let (q, volume) = ((s.positions)(q, V), volume_of(s, v0, T, index)?);
            if trial.function == "assemble_forces" {
                let f = solved::dV_linear_tetrahedron_dq(&q, V, &T[index], volume, *C, *D);
                return Some(Block::from_fn(12, 1, |i, _| -f[i]));
            }
            let H = (s.projection)(&solved::d2V_linear_tetrahedron_dq2(&q, V, &T[index], volume, *C, *D));
            Some(Block::from_fn(12, 12, |i, j| H[(i, j)]))
        }
        _ => None,
    }
}

/// The assembly with these settings.
pub fn run(s: &Settings, trial: &Trial) -> Option<Observed> {
    let (T, v0, size) = match &trial.input {
        Input::MeshMass { q_size, T, v0, .. } => (T, v0, *q_size),
        Input::Mesh(mesh) => (&mesh.T, &mesh.v0, mesh.q.len()),
        _ => return None,
    };
    let columns = if trial.function == "assemble_forces" { 1 } else { size };
    let mut numbers = vec![0.0; size * columns];
    for index in (s.elements)(T.len()) {
        let (mut block, vertices) = (of_element(s, trial, index)?, (s.vertices)(T[index], index));
        if let Some(place) = s.volume_of_row {
            for i in 0..12 {
                block.row_mut(i).scale_mut(v0.get(place(&T[index], i))? / v0[index]);
            }
        }
        for (i, j) in (0..12).flat_map(|i| (0..block.ncols()).map(move |j| (i, j))) {
            let row = (s.place)(&vertices, i, size);
            let column = if columns == 1 { 0 } else { (s.place)(&(s.columns)(vertices), j, size) };
            let place = numbers.get_mut(row * columns + column)?;
            *place = (s.put)(*place, (s.entry)(&block, i, j));
        }
    }
    if s.divided_by_valence {
        let valence = |row: usize| T.iter().filter(|t| t.contains(&(row / 3))).count().max(1) as f64;
        numbers.iter_mut().enumerate().for_each(|(k, x)| *x /= valence(k / columns));
    }
    Some(Observed { shape: [size, columns], numbers, ..Observed::default() })
}
