//! The meshes of `[mesh] rectangle` and `[mesh] box`, node by node and element by element.

/// Node positions, m, and the nodes of each element: three of a triangle, four of a tetrahedron.
pub struct Mesh {
    pub nodes: Vec<[f64; 3]>,
    pub elements: Vec<Vec<usize>>,
}

/// The rectangle or box from the origin to `size` (m) in cells of 1/`cells` m.
pub fn mesh(size: &[f64], cells: usize) -> Mesh {
    let counts: Vec<usize> = size.iter().map(|edge| (edge * cells as f64).round() as usize).collect();
    match counts[..] {
        [nx, ny] => Mesh { nodes: nodes([nx, ny, 0], cells), elements: triangles(nx, ny) },
        _ => {
            let counts = [counts[0], counts[1], counts[2]];
            Mesh { nodes: nodes(counts, cells), elements: tetrahedra(counts) }
        }
    }
}

impl Mesh {
    /// Mass of each node, kg: equal parts of its elements' mass, whose volumes or areas × 1 m are positive.
    pub fn lumped_mass(&self, density: f64) -> Vec<f64> {
        let mut masses = vec![0.0; self.nodes.len()];
        for element in &self.elements {
            let share = density * self.measure(element) / element.len() as f64;
            element.iter().for_each(|&node| masses[node] += share);
        }
        masses
    }

    fn measure(&self, element: &[usize]) -> f64 {
        let edge = |corner: usize, axis: usize| self.nodes[element[corner]][axis] - self.nodes[element[0]][axis];
        let minor = |a: usize, b: usize, i: usize, j: usize| edge(a, i) * edge(b, j) - edge(a, j) * edge(b, i);
        if element.len() == 3 {
            return minor(1, 2, 0, 1) / 2.0;
        }
        (edge(1, 0) * minor(2, 3, 1, 2) - edge(1, 1) * minor(2, 3, 0, 2) + edge(1, 2) * minor(2, 3, 0, 1)) / 6.0
    }
}

fn nodes([nx, ny, nz]: [usize; 3], cells: usize) -> Vec<[f64; 3]> {
    let coordinate = |i: usize| i as f64 / cells as f64;
    let row = |j: usize, k: usize| (0..=nx).map(move |i| [i, j, k].map(coordinate));
    (0..=nz).flat_map(|k| (0..=ny).flat_map(move |j| row(j, k))).collect()
}

/// Two triangles in each square, whose diagonal begins at the corner nearest the origin.
fn triangles(nx: usize, ny: usize) -> Vec<Vec<usize>> {
    let square = |i: usize, j: usize| {
        let [a, b] = [i + (nx + 1) * j, i + (nx + 1) * (j + 1)];
        [vec![a, a + 1, b + 1], vec![a, b + 1, b]]
    };
    (0..ny).flat_map(|j| (0..nx).flat_map(move |i| square(i, j))).collect()
}

/// Six tetrahedra in each cube, one for each order of the axes.
fn tetrahedra([nx, ny, nz]: [usize; 3]) -> Vec<Vec<usize>> {
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let index = |p: [usize; 3]| p[0] + (nx + 1) * (p[1] + (ny + 1) * p[2]);
    let cube = |corner: [usize; 3]| {
        ORDERS.map(|order| {
            let mut place = corner;
            let mut element = vec![index(place)];
            for axis in order {
                place[axis] += 1;
                element.push(index(place));
            }
            // An odd permutation has a negative volume.
            if (order[0] + 1) % 3 != order[1] {
                element.swap(2, 3);
            }
            element
        })
    };
    let cubes = (0..nz).flat_map(|k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])));
    cubes.flat_map(cube).collect()
}
