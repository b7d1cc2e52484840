//! The growing tetrahedralization: Bowyer (1981) and Watson (1981), with ghost tetrahedra between the hull and a vertex at infinity.
//!
//! A point is inserted by removing the tetrahedra whose sphere contains it strictly, and joining it to the faces of the cavity. A face whose
//! plane contains the point is never left over: the sphere of the tetrahedron behind it meets the plane in the same circle, and contains the
//! point as well. So exact signs alone keep every tetrahedron positively oriented.

use nalgebra::Vector3;
use robust::{Coord3D, insphere, orient3d};

/// The vertex at infinity.
pub const INFINITE: u32 = u32::MAX;

/// The three vertices of the face opposite each vertex, so that the four together are positively oriented.
const FACES: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// A tetrahedron: its vertices, and its neighbours opposite each.
#[derive(Clone, Copy, Debug)]
struct Cell {
    vertices: [u32; 4],
    neighbours: [u32; 4],
}

/// Location of a point.
enum Place {
    /// Inside the sphere of this cell.
    InSphereOf(u32),
    /// At a vertex.
    At(u32),
}

/// A tetrahedralization to which points are added.
pub struct Growing<'a> {
    points: &'a [Vector3<f64>],
    cells: Vec<Cell>,
    /// Number of the insertion that has tested a cell last, and whether its sphere contained the point.
    tested: Vec<(u32, bool)>,
    /// Cells that may be used again.
    unused: Vec<u32>,
    insertion: u32,
    /// A cell close to the last point.
    last: u32,
    /// State of the pseudo-random order of the walk.
    random: u32,
    /// Scratch of an insertion.
    conflicts: Vec<u32>,
    edges: Vec<(u64, u32, u8)>,
}

impl<'a> Growing<'a> {
    /// Starts with four points that are not in one plane.
    pub fn new(points: &'a [Vector3<f64>], mut first: [u32; 4]) -> Self {
        let mut new = Self {
            points,
            cells: Vec::with_capacity(7 * points.len() + 5),
            tested: Vec::with_capacity(7 * points.len() + 5),
            unused: Vec::new(),
            insertion: 0,
            last: 0,
            random: 1,
            conflicts: Vec::new(),
            edges: Vec::new(),
        };
        if new.orientation(first) < 0.0 {
            first.swap(2, 3);
        }
        new.cells.push(Cell { vertices: first, neighbours: [1, 2, 3, 4] });
        for opposite in 0..4 {
            let mut vertices = first;
            vertices[opposite] = INFINITE;
            // Seen from infinity the face has the other orientation.
            let [a, b, _] = FACES[opposite];
            vertices.swap(a, b);
            new.cells.push(Cell { vertices, neighbours: [0; 4] });
        }
        for ghost in 1..5 {
            for i in 0..4 {
                let vertex = new.cells[ghost as usize].vertices[i];
                let inner = first.iter().position(|v| *v == vertex);
                new.cells[ghost as usize].neighbours[i] = inner.map_or(0, |inner| inner as u32 + 1);
            }
        }
        new.tested = vec![(0, false); 5];
        new
    }

    /// Adds a point. Returns the vertex at its place if there is one already.
    pub fn insert(&mut self, point: u32) -> Option<u32> {
        let start = match self.locate(point) {
            Place::At(vertex) => return Some(vertex),
            Place::InSphereOf(cell) => cell,
        };
        self.insertion += 1;
        self.find_conflicts(point, start);
        self.fill(point);
        None
    }

    /// The tetrahedra without ghosts, positively oriented.
    pub fn tetrahedra(&self) -> Vec<[u32; 4]> {
        let mut is_used = vec![true; self.cells.len()];
        self.unused.iter().for_each(|&cell| is_used[cell as usize] = false);
        let cells = self.cells.iter().zip(is_used).filter(|(cell, is_used)| *is_used && !is_ghost(cell));
        cells.map(|(cell, _)| cell.vertices).collect()
    }

    /// Walks towards a point through faces that separate it from a tetrahedron, in random order: Devillers, Pion and Teillaud, Walking
    /// in a Triangulation (2002).
    fn locate(&mut self, point: u32) -> Place {
        let mut at = self.last;
        if let Some(infinite) = ghost_corner(&self.cells[at as usize]) {
            at = self.cells[at as usize].neighbours[infinite];
        }
        'walk: loop {
            let Cell { vertices, neighbours } = self.cells[at as usize];
            self.random = self.random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let from = (self.random >> 16) as usize;
            let mut on_faces = [false; 4];
            for turn in 0..4 {
                let i = (from + turn) % 4;
                let mut replaced = vertices;
                replaced[i] = point;
                let side = self.orientation(replaced);
                on_faces[i] = side == 0.0;
                if side < 0.0 {
                    at = neighbours[i];
                    if is_ghost(&self.cells[at as usize]) {
                        return Place::InSphereOf(at);
                    }
                    continue 'walk;
                }
            }
            // Three faces meet in a vertex.
            return match (0..4).find(|&i| !on_faces[i]) {
                Some(i) if on_faces.iter().filter(|on| **on).count() == 3 => Place::At(vertices[i]),
                _ => Place::InSphereOf(at),
            };
        }
    }

    /// Collects the cells whose sphere contains a point; they are connected.
    fn find_conflicts(&mut self, point: u32, start: u32) {
        self.conflicts.clear();
        self.conflicts.push(start);
        self.tested[start as usize] = (self.insertion, true);
        let mut next = 0;
        while next < self.conflicts.len() {
            for neighbour in self.cells[self.conflicts[next] as usize].neighbours {
                if self.tested[neighbour as usize].0 != self.insertion {
                    let conflicts = self.is_in_sphere(neighbour, point);
                    self.tested[neighbour as usize] = (self.insertion, conflicts);
                    if conflicts {
                        self.conflicts.push(neighbour);
                    }
                }
            }
            next += 1;
        }
    }

    /// Replaces the cells of the cavity by those that join the point to its faces.
    fn fill(&mut self, point: u32) {
        let conflicts = std::mem::take(&mut self.conflicts);
        let mut edges = std::mem::take(&mut self.edges);
        edges.clear();
        for &cell in &conflicts {
            let Cell { vertices, neighbours } = self.cells[cell as usize];
            for i in 0..4 {
                let outside = neighbours[i];
                if self.tested[outside as usize] == (self.insertion, true) {
                    continue;
                }
                let mut joined = vertices;
                joined[i] = point;
                let new = self.add(Cell { vertices: joined, neighbours: [u32::MAX; 4] });
                self.cells[new as usize].neighbours[i] = outside;
                let behind = self.cells[outside as usize].neighbours.iter().position(|&back| back == cell);
                if let Some(behind) = behind {
                    self.cells[outside as usize].neighbours[behind] = new;
                }
                for j in (0..4).filter(|&j| j != i) {
                    let mut ends = (0..4).filter(|&k| k != i && k != j).map(|k| u64::from(vertices[k]));
                    let (a, b) = (ends.next().unwrap_or(0), ends.next().unwrap_or(0));
                    edges.push((a.min(b) << 32 | a.max(b), new, j as u8));
                }
                self.last = new;
            }
        }
        // Two new cells meet at each edge of the cavity's surface.
        edges.sort_unstable();
        for pair in edges.chunks_exact(2) {
            let ((_, a, i), (_, b, j)) = (pair[0], pair[1]);
            self.cells[a as usize].neighbours[usize::from(i)] = b;
            self.cells[b as usize].neighbours[usize::from(j)] = a;
        }
        self.unused.extend(&conflicts);
        (self.conflicts, self.edges) = (conflicts, edges);
    }

    fn add(&mut self, cell: Cell) -> u32 {
        if let Some(place) = self.unused.pop() {
            self.cells[place as usize] = cell;
            self.tested[place as usize] = (0, false);
            return place;
        }
        self.cells.push(cell);
        self.tested.push((0, false));
        self.cells.len() as u32 - 1
    }

    /// Returns true if the sphere of a cell contains a point strictly. That of a ghost is the half-space beyond its face, and within
    /// the face's plane the disc of its circle.
    fn is_in_sphere(&self, cell: u32, point: u32) -> bool {
        let Cell { vertices, neighbours } = self.cells[cell as usize];
        let Some(infinite) = ghost_corner(&self.cells[cell as usize]) else { return self.in_sphere(vertices, point) };
        let mut beyond = vertices;
        beyond[infinite] = point;
        match self.orientation(beyond) {
            side if side != 0.0 => side > 0.0,
            _ => self.in_sphere(self.cells[neighbours[infinite] as usize].vertices, point),
        }
    }

    fn in_sphere(&self, vertices: [u32; 4], point: u32) -> bool {
        let [a, b, c, d] = vertices.map(|vertex| self.coordinates(vertex));
        // Shewchuk's sign is for the opposite orientation.
        insphere(b, a, c, d, self.coordinates(point)) > 0.0
    }

    /// Positive if the four vertices are positively oriented.
    fn orientation(&self, vertices: [u32; 4]) -> f64 {
        let [a, b, c, d] = vertices.map(|vertex| self.coordinates(vertex));
        -orient3d(a, b, c, d)
    }

    fn coordinates(&self, vertex: u32) -> Coord3D<f64> {
        let [x, y, z] = self.points[vertex as usize].into();
        Coord3D { x, y, z }
    }
}

fn is_ghost(cell: &Cell) -> bool {
    ghost_corner(cell).is_some()
}

fn ghost_corner(cell: &Cell) -> Option<usize> {
    cell.vertices.iter().position(|&vertex| vertex == INFINITE)
}
