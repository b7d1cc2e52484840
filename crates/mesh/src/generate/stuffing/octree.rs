//! The octree of cubes whose corners and centres are the nodes of the lattice: all of one size, or larger ones away from the surface.
//!
//! Labelle and Shewchuk (2007), section on graded meshes. No cube shares an edge with one of less than half its side, so that four kinds of
//! tetrahedra fill the lattice: those of the uniform one, their halves and quarters, and half pyramids. Dihedral angles of the last three lie between
//! 45° and 120°. Every tetrahedron at a node that may move, or at an edge that is cut, is one of the uniform lattice, and keeps its bounds.

use super::lattice::{Lattice, Place, neighbours};

/// A cube of a level, counted in sides of that level.
type Cube = [i32; 3];

/// Cubes, some of which are split into eight.
pub struct Octree {
    /// Number of the smallest cubes in each direction.
    cubes: Cube,
    /// True for each cube that is split; level by level, from the one above the smallest cubes.
    split: Vec<Vec<bool>>,
}

impl Octree {
    /// Cubes of one size.
    pub fn uniform(cubes: Cube) -> Self {
        Self { cubes, split: Vec::new() }
    }

    /// Cubes up to 2 to the power of `levels` times as large as those at the surface of a lattice.
    pub fn graded(lattice: &Lattice, levels: usize) -> Self {
        let cubes = lattice.cubes();
        // A cube that contains the whole lattice is the largest of use.
        let most = (1..=levels).take_while(|level| cubes.iter().any(|&n| n > 1 << (level - 1))).count();
        if most == 0 {
            return Self::uniform(cubes);
        }
        let count = |level: usize| size(cubes, level).iter().map(|&n| n as usize).product();
        let mut octree = Self { cubes, split: (1..=most).map(|level| vec![false; count(level)]).collect() };
        octree.split_at_surface(lattice);
        for level in 1..=most {
            let beyond = all(size(cubes, level)).filter(|cube| (0..3).any(|i| (cube[i] + 1) << level > cubes[i]));
            beyond.for_each(|cube| octree.mark(level, cube));
            if level > 1 {
                octree.balance(level);
            }
        }
        octree
    }

    /// Splits the cubes around all tetrahedra at nodes that have an edge to the other side of the surface.
    fn split_at_surface(&mut self, lattice: &Lattice) {
        for (node, place) in lattice.places().enumerate() {
            let sign = lattice.signs[node];
            let is_close =
                |other: Place| lattice.node(other).is_some_and(|other| lattice.signs[other as usize] != sign);
            if !neighbours(place).any(|(_, other)| is_close(other)) {
                continue;
            }
            // Its tetrahedra lie in the cubes of the node and of its neighbours that are centres.
            let around = neighbours(place).map(|(_, other)| other).chain([place]).filter(|x| x[0].rem_euclid(2) == 1);
            for other in around.filter(|&other| lattice.node(other).is_some()) {
                self.mark(1, other.map(|x| x >> 2));
            }
        }
    }

    /// Splits the cubes that contain or touch, by a face or an edge, one of the level below that is split.
    fn balance(&mut self, level: usize) {
        for cube in all(size(self.cubes, level - 1)) {
            if !self.is_split(level - 1, cube) {
                continue;
            }
            for step in all([3; 3]).map(|step| step.map(|x| x - 1)) {
                if step.iter().filter(|&&x| x != 0).count() < 3 {
                    let other = [0, 1, 2].map(|i| cube[i] + step[i]);
                    self.mark(level, other.map(|x| x >> 1));
                }
            }
        }
    }

    fn mark(&mut self, level: usize, cube: Cube) {
        if let Some(place) = self.place(level, cube) {
            self.split[level - 1][place] = true;
        }
    }

    fn place(&self, level: usize, cube: Cube) -> Option<usize> {
        let [nx, ny, nz] = size(self.cubes, level);
        let is_within = (0..3).all(|i| (0..[nx, ny, nz][i]).contains(&cube[i]));
        (is_within && (1..=self.split.len()).contains(&level))
            .then(|| ((cube[2] * ny + cube[1]) * nx + cube[0]) as usize)
    }

    fn is_split(&self, level: usize, cube: Cube) -> bool {
        self.place(level, cube).is_some_and(|place| self.split[level - 1][place])
    }

    /// Returns true if a cube is in the octree and not split.
    fn is_leaf(&self, level: usize, cube: Cube) -> bool {
        let is_within = (0..3).all(|i| (0..size(self.cubes, level)[i]).contains(&cube[i]));
        let is_there = level == self.split.len() || self.is_split(level + 1, cube.map(|x| x >> 1));
        is_within && is_there && !self.is_split(level, cube)
    }

    /// The tetrahedra of the lattice: two neighbouring centres and an edge of the square between them, and what becomes of them between
    /// cubes of different sizes.
    pub fn tetrahedra(&self, mut add: impl FnMut([Place; 4])) {
        for level in 0..=self.split.len() {
            for cube in all(size(self.cubes, level)).filter(|&cube| self.is_leaf(level, cube)) {
                for (axis, sign) in [(0, 1), (0, -1), (1, 1), (1, -1), (2, 1), (2, -1)] {
                    let mut other = cube;
                    other[axis] += sign;
                    if self.is_split(level, other) {
                        towards_smaller(level, cube, axis, sign, &mut add);
                    } else if sign == 1 && self.is_leaf(level, other) {
                        self.between_equal(level, cube, axis, &mut add);
                    }
                }
            }
        }
    }

    /// The tetrahedra of two cubes of a level, the second beyond the first along an axis.
    fn between_equal(&self, level: usize, cube: Cube, axis: usize, add: &mut impl FnMut([Place; 4])) {
        let first = centre(level, cube);
        let mut second = first;
        second[axis] += 2 << level;
        for turn in 0..4 {
            let [a, b] = [turn, turn + 1].map(|turn| corner(level, first, axis, 1, turn));
            let (beside, sign) = ([2, 1, 2, 1][turn], [1, -1, -1, 1][turn]);
            let is_halved = [0, 1].into_iter().any(|along| {
                let mut other = cube;
                other[axis] += along;
                other[(axis + beside) % 3] += sign;
                self.is_split(level, other)
            });
            if is_halved {
                let middle = [0, 1, 2].map(|i| (a[i] + b[i]) / 2);
                add([first, second, a, middle]);
                add([first, second, middle, b]);
            } else {
                add([first, second, a, b]);
            }
        }
    }
}

/// The tetrahedra of a cube and the four of half its side beyond a face.
fn towards_smaller(level: usize, cube: Cube, axis: usize, sign: i32, add: &mut impl FnMut([Place; 4])) {
    let first = centre(level, cube);
    let mut square = first;
    square[axis] += sign << level;
    for turn in 0..4 {
        let [a, b] = [turn, turn + 1].map(|turn| corner(level, first, axis, sign, turn));
        let middle = [0, 1, 2].map(|i| (a[i] + b[i]) / 2);
        for end in [a, b] {
            // Centre of the smaller cube at this corner.
            let mut small = [0, 1, 2].map(|i| (square[i] + end[i]) / 2);
            small[axis] += sign << (level - 1);
            add([first, square, end, middle]);
            add([small, square, end, middle]);
        }
    }
}

/// Number of cubes of a level in each direction; those at the end may stand out.
fn size(cubes: Cube, level: usize) -> Cube {
    cubes.map(|n| (n + (1 << level) - 1) >> level)
}

/// Place of a cube's centre, in half sides of the smallest cubes.
fn centre(level: usize, cube: Cube) -> Place {
    cube.map(|x| (2 * x + 1) << level)
}

/// A corner of the face of a cube, by its centre and the turn around the axis.
fn corner(level: usize, centre: Place, axis: usize, sign: i32, turn: usize) -> Place {
    let (u, v) = [(1, 1), (-1, 1), (-1, -1), (1, -1)][turn % 4];
    let mut corner = centre;
    corner[axis] += sign << level;
    corner[(axis + 1) % 3] += u << level;
    corner[(axis + 2) % 3] += v << level;
    corner
}

/// All cubes of a box, the first coordinate fastest.
fn all([nx, ny, nz]: Cube) -> impl Iterator<Item = Cube> {
    (0..nz).flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])))
}
