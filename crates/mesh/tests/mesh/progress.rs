//! Progress of the functions that make and improve meshes: it grows to the whole, and the result is the same with it.

use std::cell::RefCell;

use fem_mesh::generate::delaunay::tetrahedralize;
use fem_mesh::generate::odt::{improve_inside, improve_tetrahedra};
use fem_mesh::generate::{Progress, Solid, stuff_graded};
use fem_mesh::{Pattern, SurfaceMesh, boundary, box_mesh};
use nalgebra::Vector3;

/// Does the work, asserts that the shares rise from 0 towards 1 and are not too many, and returns the result.
fn told<R>(work: impl FnOnce(Progress) -> R) -> R {
    let shares = RefCell::new(Vec::new());
    let result = work(&|share| shares.borrow_mut().push(share));
    let shares = shares.into_inner();
    assert!(shares.first() == Some(&0.0) && (2..=250).contains(&shares.len()), "{shares:?}");
    assert!(shares.windows(2).all(|pair| pair[0] < pair[1]) && shares.iter().all(|share| *share < 1.0), "{shares:?}");
    result
}

#[test]
fn the_share_of_the_work_that_is_done_rises() {
    let digits = |i: usize| (i as f64 * 12.9898).sin();
    let points: Vec<_> = (0..1000).map(|i| Vector3::new(digits(3 * i), digits(3 * i + 1), digits(3 * i + 2))).collect();
    let found = told(|progress| tetrahedralize(&points, progress)).unwrap();
    assert_eq!(found.mesh, tetrahedralize(&points, &|_| ()).unwrap().mesh);

    let solid = box_mesh([1.0, 0.7, 0.5], 10, Pattern::Alternating).unwrap();
    let surface = SurfaceMesh::new(solid.vertices.clone(), boundary(&solid));
    let stuffed = told(|progress| stuff_graded(&surface, 0.1, 1, progress)).unwrap();
    assert_eq!(stuffed, stuff_graded(&surface, 0.1, 1, &|_| ()).unwrap());

    let improved = told(|progress| improve_tetrahedra(&stuffed, 2, progress));
    assert_eq!(improved, improve_tetrahedra(&stuffed, 2, &|_| ()));
    let inside = Solid::new(&surface);
    let improved = told(|progress| improve_inside(&stuffed, 2, &inside, progress));
    assert_eq!(improved, improve_inside(&stuffed, 2, &inside, &|_| ()));
}
