//! Elements and meshes to check with. Vertices of no element lie far away, so that an answer which uses them is wrong.

use nalgebra::{DVector, Matrix3, Vector3};

/// One element among nine vertices.
#[derive(Clone, Debug)]
pub struct Tetrahedron {
    /// Undeformed positions, m.
    pub V: Vec<Vector3<f64>>,
    /// Its vertices.
    pub element: [usize; 4],
    /// Undeformed volume, m³.
    pub volume: f64,
}

impl Tetrahedron {
    /// The unit tetrahedron (vertices 0, e_x, e_y, e_z), mapped by X → `shape` X + `offset`.
    pub fn new(element: [usize; 4], shape: &Matrix3<f64>, offset: &Vector3<f64>) -> Self {
        let mut V: Vec<_> = (0..9).map(far_away).collect();
        let corners = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
        for (vertex, corner) in element.into_iter().zip(corners) {
            V[vertex] = shape * corner + offset;
        }
        Self { V, element, volume: shape.determinant() / 6.0 }
    }

    /// Vertices 0 to 3 at the origin and at one metre along each axis.
    pub fn unit() -> Self {
        Self::new([0, 1, 2, 3], &Matrix3::identity(), &Vector3::zeros())
    }

    /// Undeformed positions of its vertices.
    pub fn X(&self) -> [Vector3<f64>; 4] {
        self.element.map(|vertex| self.V[vertex])
    }

    /// Characteristic length of the element: the side of the cube with its volume.
    pub fn size(&self) -> f64 {
        self.volume.cbrt()
    }

    /// The smallest height over a face, the shortest length over which a shape function varies by one.
    pub fn height(&self) -> f64 {
        let X = self.X();
        let area = |a: usize, b: usize, c: usize| (X[b] - X[a]).cross(&(X[c] - X[a])).norm() / 2.0;
        let largest = [area(0, 1, 2), area(0, 1, 3), area(0, 2, 3), area(1, 2, 3)].into_iter().fold(0.0, f64::max);
        3.0 * self.volume / largest
    }

    /// Positions `q` of all vertices after X → F X + shift.
    pub fn moved(&self, F: &Matrix3<f64>, shift: &Vector3<f64>) -> DVector<f64> {
        stacked(&self.V.iter().map(|X| F * X + shift).collect::<Vec<_>>())
    }

    /// The twelve entries of `q` that belong to the element, in its order.
    pub fn gather(&self, q: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(12, |row, _| q[3 * self.element[row / 3] + row % 3])
    }

    /// `q` with the element's twelve entries in place, and large numbers elsewhere.
    pub fn scatter(&self, entries: &DVector<f64>) -> DVector<f64> {
        let mut q = stacked(&(0..self.V.len()).map(far_away).collect::<Vec<_>>());
        for row in 0..12 {
            q[3 * self.element[row / 3] + row % 3] = entries[row];
        }
        q
    }

    /// The same element with its vertices named in another order.
    pub fn reordered(&self, order: [usize; 4]) -> Self {
        Self { element: order.map(|a| self.element[a]), ..self.clone() }
    }
}

/// A position that no element has. It is finite: a solution may multiply by a matrix of zeros and ones that selects an element's.
fn far_away(vertex: usize) -> Vector3<f64> {
    let x = vertex as f64;
    Vector3::new(3e7 + 1e6 * x, -2e7 + 3e5 * x * x, 1e7 - 7e5 * x)
}

/// All 24 orders of four things.
pub fn orders() -> Vec<[usize; 4]> {
    let all = (0..256).map(|code| [code / 64, code / 16 % 4, code / 4 % 4, code % 4]);
    all.filter(|order| (0..4).all(|a| order.contains(&a))).collect()
}

/// A body of elements.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Undeformed positions, m.
    pub V: Vec<Vector3<f64>>,
    /// Vertices of each element.
    pub T: Vec<[usize; 4]>,
    /// Undeformed volumes, m³.
    pub v0: Vec<f64>,
}

impl Mesh {
    /// A box of cells, six elements each, uneven enough that no two elements have the same shape or volume.
    /// Elements name their vertices in different orders, and neighbours in the box are not neighbours in `V`.
    pub fn uneven_box(cells: [usize; 3], size: f64) -> Self {
        let [nx, ny, nz] = cells;
        let vertices = (nx + 1) * (ny + 1) * (nz + 1);
        // Multiplying by a number without a common factor renumbers the vertices; 97 is prime.
        let index = |p: [usize; 3]| (p[0] + (nx + 1) * (p[1] + (ny + 1) * p[2])) * 97 % vertices;
        assert!(vertices % 97 != 0);

        let mut V = vec![Vector3::zeros(); vertices];
        let mut T = Vec::new();
        for (i, j, k) in (0..=nx).flat_map(|i| (0..=ny).flat_map(move |j| (0..=nz).map(move |k| (i, j, k)))) {
            let (x, y, z) = (i as f64, j as f64, k as f64);
            let bump = Vector3::new((1.7 * y + z + 0.3).sin(), (1.3 * z + 2.1 * x).cos(), (x * 0.9 - y * 1.9).sin());
            V[index([i, j, k])] = (Vector3::new(x, y, z) + bump * 0.12) * size;
            if i < nx && j < ny && k < nz {
                T.extend(cell([i, j, k]).map(|element| element.map(index)));
            }
        }
        for (number, element) in T.iter_mut().enumerate() {
            element[1..].rotate_left(number % 3); // an even permutation
        }
        let v0 = T.iter().map(|element| volume(&V, element)).collect();
        Self { V, T, v0 }
    }

    /// Positions `q` where every vertex stands at `position(X)`.
    pub fn placed(&self, position: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> DVector<f64> {
        stacked(&self.V.iter().map(position).collect::<Vec<_>>())
    }
}

/// The six elements of a cell, all of which share its long diagonal.
fn cell([i, j, k]: [usize; 3]) -> [[[usize; 3]; 4]; 6] {
    [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]].map(|axes| {
        let mut path = [[i, j, k]; 4];
        for step in 0..3 {
            path[step + 1] = path[step];
            path[step + 1][axes[step]] += 1;
        }
        let is_even = (axes[0] + 1) % 3 == axes[1];
        if is_even { path } else { [path[0], path[1], path[3], path[2]] }
    })
}

/// Volume of one element, m³.
pub fn volume(V: &[Vector3<f64>], element: &[usize; 4]) -> f64 {
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    Matrix3::from_columns(&[b - a, c - a, d - a]).determinant() / 6.0
}

/// `[x0 y0 z0 x1 …]`.
pub fn stacked(positions: &[Vector3<f64>]) -> DVector<f64> {
    DVector::from_iterator(3 * positions.len(), positions.iter().flat_map(|x| [x.x, x.y, x.z]))
}
