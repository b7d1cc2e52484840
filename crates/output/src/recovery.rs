//! Stresses at nodes by superconvergent patch recovery: Zienkiewicz and Zhu, The Superconvergent Patch Recovery and A Posteriori Error
//! Estimates, Part 1 (1992).
//!
//! Stresses of elements are most exact at their quadrature points, and jump between elements. A patch, the elements around a corner, has a
//! polynomial of the degree of the displacements, fitted to the stresses at its points by least squares: linear for linear elements, quadratic
//! for quadratic ones. Its value at the corner is the corner's stress. A corner on the boundary has too few elements on one side, so it takes the
//! mean of the polynomials of the inner corners beside it, as section 3 recommends; where there is none, its own patch is enlarged.
//! Stresses jump between materials: a patch has elements of one material alone, and a node of several takes the mean of their values.

use nalgebra::{DMatrix, Matrix3, SVector, Vector3};

use fem_model::BodyMesh;

/// The six different entries of a symmetric stress.
type Entries = SVector<f64, 6>;

/// Smallest ratio of the diagonal entries of a Cholesky factor with which a fit is well posed.
const LEAST_PIVOT: f64 = 1e-2;

/// Largest number of rings of elements around a corner.
const RINGS: usize = 4;

/// A polynomial about a point, whose coordinates are in units of a length.
struct Fit {
    centre: Vector3<f64>,
    length: f64,
    coefficients: Vec<Entries>,
}

/// The elements of one material of a body, and the stresses at their points.
struct Part<'a> {
    mesh: &'a BodyMesh,
    stresses: &'a [Matrix3<f64>],
    /// Elements of this material around each corner.
    around: Vec<Vec<usize>>,
    /// True for each corner on the boundary of the material.
    is_outer: Vec<bool>,
}

/// The stress of each node, Pa, from those at the quadrature points of all elements, and the number of each element's material (empty if all
/// have the same).
pub(super) fn stresses_at_nodes(
    mesh: &BodyMesh,
    material_of: &[usize],
    stresses: &[Matrix3<f64>],
) -> Vec<Matrix3<f64>> {
    let mut sums = vec![(Matrix3::zeros(), 0.0); mesh.vertices().len()];
    for (_, found) in stresses_of_materials(mesh, material_of, stresses) {
        for (sum, stress) in sums.iter_mut().zip(&found) {
            if let Some(stress) = stress {
                sum.0 += stress;
                sum.1 += 1.0;
            }
        }
    }
    sums.into_iter().map(|(sum, count)| if count > 0.0 { sum / count } else { sum }).collect()
}

/// The elements of each material, and the stresses of their nodes, Pa; `None` for a node that belongs to other materials.
pub(super) fn stresses_of_materials(
    mesh: &BodyMesh,
    material_of: &[usize],
    stresses: &[Matrix3<f64>],
) -> impl Iterator<Item = (Vec<usize>, Vec<Option<Matrix3<f64>>>)> {
    let material = |element: usize| material_of.get(element).copied().unwrap_or(0);
    (0..=material_of.iter().copied().max().unwrap_or(0)).map(move |number| {
        let elements: Vec<usize> = (0..mesh.elements()).filter(|&element| material(element) == number).collect();
        let part = Part::new(mesh, stresses, &elements);
        let fits: Vec<Option<Fit>> = (0..part.around.len()).map(|corner| part.fit_inside(corner)).collect();
        let mut found: Vec<_> = (0..part.around.len()).map(|node| part.at_corner(node, &fits)).collect();
        part.add_middles(&elements, &fits, &mut found);
        (elements, found)
    })
}

impl<'a> Part<'a> {
    fn new(mesh: &'a BodyMesh, stresses: &'a [Matrix3<f64>], elements: &[usize]) -> Self {
        let mut around = vec![Vec::new(); mesh.vertices().len()];
        let mut sides = Vec::new();
        for &element in elements {
            let corners = mesh.corners_of(element);
            for (place, &corner) in corners.iter().enumerate() {
                around[corner].push(element);
                let mut side: Vec<usize> = corners.iter().copied().filter(|&other| other != corner).collect();
                side.sort_unstable();
                sides.push((side, place));
            }
        }
        sides.sort_unstable();
        let mut is_outer = vec![false; around.len()];
        for same in sides.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1) {
            same[0].0.iter().for_each(|&corner| is_outer[corner] = true);
        }
        Self { mesh, stresses, around, is_outer }
    }

    /// The polynomial of the patch of an inner corner.
    fn fit_inside(&self, corner: usize) -> Option<Fit> {
        let elements = &self.around[corner];
        if elements.is_empty() || self.is_outer[corner] { None } else { self.fit(corner, elements) }
    }

    /// The polynomial of the degree of the displacements; `None` if the points do not determine it.
    fn fit(&self, corner: usize, elements: &[usize]) -> Option<Fit> {
        let centre = self.mesh.vertices()[corner];
        let points: Vec<(Vector3<f64>, usize)> = elements.iter().flat_map(|&element| self.points(element)).collect();
        let length = points.iter().map(|(x, _)| (x - centre).norm()).fold(0.0, f64::max);
        let terms = self.terms(&Vector3::zeros()).len();
        let (mut normal, mut right) = (DMatrix::zeros(terms, terms), DMatrix::zeros(terms, 6));
        for (x, point) in &points {
            let row = self.terms(&((x - centre) / length));
            let stress = entries(&self.stresses[*point]);
            for i in 0..terms {
                (0..terms).for_each(|j| normal[(i, j)] += row[i] * row[j]);
                (0..6).for_each(|k| right[(i, k)] += row[i] * stress[k]);
            }
        }
        let factor = (points.len() >= terms).then(|| normal.cholesky()).flatten()?;
        let pivots = factor.l_dirty().diagonal();
        // NaN fails the comparison.
        if !(pivots.min() > LEAST_PIVOT * pivots.max()) {
            return None;
        }
        let solution = factor.solve(&right);
        let coefficients = (0..terms).map(|i| Entries::from_fn(|k, _| solution[(i, k)])).collect();
        Some(Fit { centre, length, coefficients })
    }

    /// The points of an element, each with the number of its stress.
    fn points(&self, element: usize) -> impl Iterator<Item = (Vector3<f64>, usize)> {
        let points = self.mesh.points(element);
        let first = element * points.len();
        points.into_iter().enumerate().map(move |(k, x)| (x, first + k))
    }

    /// The terms of a polynomial at a point.
    fn terms(&self, point: &Vector3<f64>) -> Vec<f64> {
        let x = &point.as_slice()[..self.mesh.dimension()];
        let mut terms = vec![1.0];
        // Those of each degree, by the last factor that made them.
        let mut last: Vec<(usize, f64)> = vec![(0, 1.0)];
        for _ in 0..self.mesh.element().order {
            let times = |&(first, term): &(usize, f64)| (first..x.len()).map(move |i| (i, term * x[i]));
            last = last.iter().flat_map(times).collect();
            terms.extend(last.iter().map(|(_, term)| term));
        }
        terms
    }

    fn value(&self, fit: &Fit, x: &Vector3<f64>) -> Matrix3<f64> {
        let terms = self.terms(&((x - fit.centre) / fit.length));
        matrix(&terms.iter().zip(&fit.coefficients).map(|(term, coefficients)| *term * coefficients).sum())
    }

    /// The stress at a corner; `None` if it does not belong to the material.
    fn at_corner(&self, corner: usize, fits: &[Option<Fit>]) -> Option<Matrix3<f64>> {
        (!self.around[corner].is_empty()).then(|| self.at(corner, &self.mesh.vertices()[corner], fits))
    }

    /// The stress at a point beside a corner, by the polynomials of that corner or of its neighbours.
    fn at(&self, corner: usize, x: &Vector3<f64>, fits: &[Option<Fit>]) -> Matrix3<f64> {
        if let Some(fit) = &fits[corner] {
            return self.value(fit, x);
        }
        let neighbours = self.neighbours(&[corner]);
        let found: Vec<_> = neighbours.iter().filter_map(|&node| fits[node].as_ref()).collect();
        if !found.is_empty() {
            return found.iter().map(|fit| self.value(fit, x)).sum::<Matrix3<f64>>() / found.len() as f64;
        }
        self.of_rings(corner, x)
    }

    /// The stress by the smallest patch about a corner that determines a polynomial; the mean around the corner if none does.
    fn of_rings(&self, corner: usize, x: &Vector3<f64>) -> Matrix3<f64> {
        let mut corners = vec![corner];
        for _ in 0..RINGS {
            if let Some(fit) = self.fit(corner, &self.elements_around(&corners)) {
                return self.value(&fit, x);
            }
            corners = self.neighbours(&corners);
        }
        let points: Vec<usize> =
            self.around[corner].iter().flat_map(|&e| self.points(e)).map(|(_, point)| point).collect();
        points.iter().map(|&point| self.stresses[point]).sum::<Matrix3<f64>>() / points.len() as f64
    }

    /// The elements around some corners, ascending.
    fn elements_around(&self, of: &[usize]) -> Vec<usize> {
        let mut elements: Vec<usize> = of.iter().flat_map(|&corner| &self.around[corner]).copied().collect();
        elements.sort_unstable();
        elements.dedup();
        elements
    }

    /// The corners of the elements around some corners, ascending.
    fn neighbours(&self, of: &[usize]) -> Vec<usize> {
        let elements = self.elements_around(of);
        let mut nodes: Vec<usize> =
            elements.iter().flat_map(|&element| self.mesh.corners_of(element)).copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Adds the stresses at the middles of sides, each the mean of what the patches of the two ends give there.
    fn add_middles(&self, elements: &[usize], fits: &[Option<Fit>], found: &mut [Option<Matrix3<f64>>]) {
        for ([a, b], middle) in elements.iter().flat_map(|&element| self.mesh.middles_of(element)) {
            let x = &self.mesh.vertices()[middle];
            found[middle].get_or_insert_with(|| 0.5 * (self.at(a, x, fits) + self.at(b, x, fits)));
        }
    }
}

fn entries(stress: &Matrix3<f64>) -> Entries {
    let s = |i, j| stress[(i, j)];
    Entries::from([s(0, 0), s(1, 1), s(2, 2), s(1, 2), s(0, 2), s(0, 1)])
}

fn matrix(e: &Entries) -> Matrix3<f64> {
    Matrix3::new(e[0], e[5], e[4], e[5], e[1], e[3], e[4], e[3], e[2])
}

#[cfg(test)]
mod tests;
