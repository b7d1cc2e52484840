//! The parts of loads and masses that nodes carry.

use fem_model::element::Element;
use fem_model::element::shares::{face_shares, load_shares, lumped_mass_shares, mass_shares};

/// Points and weights of the Gauss–Legendre rule of four points on [0, 1], exact for degree 7.
fn gauss() -> [(f64, f64); 4] {
    let [near, far] = [-1.0, 1.0].map(|sign: f64| (3.0 / 7.0 + sign * 2.0 / 7.0 * 1.2_f64.sqrt()).sqrt());
    let [of_near, of_far] = [1.0, -1.0].map(|sign| (18.0 + sign * 30_f64.sqrt()) / 36.0);
    [(-far, of_far), (-near, of_near), (near, of_near), (far, of_far)].map(|(x, w)| (0.5 + 0.5 * x, 0.5 * w))
}

/// ∫ f(L) over a simplex of unit volume, whose barycentric coordinates are products of those of a cube.
fn integral(dimension: usize, f: &dyn Fn(&[f64]) -> f64) -> f64 {
    let mut points = vec![(Vec::new(), 1.0, 1.0)];
    for left in (1..=dimension).rev() {
        let next = |(L, rest, weight): &(Vec<f64>, f64, f64)| {
            let (L, rest, weight) = (L.clone(), *rest, *weight);
            gauss().map(|(x, w)| {
                let volume = left as f64 * (1.0 - x).powi(left as i32 - 1);
                ([L.clone(), vec![rest * x]].concat(), rest * (1.0 - x), weight * w * volume)
            })
        };
        points = points.iter().flat_map(next).collect();
    }
    points.into_iter().map(|(L, rest, weight)| weight * f(&[L, vec![rest]].concat())).sum()
}

fn check_mass<const N: usize>(element: &Element) {
    let mass = mass_shares::<N>(element);
    for i in 0..N {
        for j in 0..N {
            let expected = integral(element.dimension, &|L| element.values(L)[i] * element.values(L)[j]);
            assert!((mass[i][j] - expected).abs() < 1e-14, "{} {i} {j}: {} {expected}", element.name, mass[i][j]);
        }
    }
    let trace: f64 = (0..N).map(|i| mass[i][i]).sum();
    for (i, lumped) in lumped_mass_shares(element).into_iter().enumerate() {
        assert!((lumped - mass[i][i] / trace).abs() < 1e-15 && lumped > 0.0, "{}", element.name);
    }
}

#[test]
fn shares_are_integrals_of_products_of_shape_functions_and_add_up_to_one() {
    for element in Element::ALL {
        let (loads, faces) = (load_shares(element), face_shares(element));
        for shares in [&loads, &faces, &lumped_mass_shares(element)] {
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{}: {shares:?}", element.name);
        }
        for (node, share) in loads.iter().enumerate() {
            assert!((share - integral(element.dimension, &|L| element.values(L)[node])).abs() < 1e-15);
        }
        // Barycentric coordinates on the face, which are zero at the corners beside it.
        let on_face = |L: &[f64]| {
            let mut all = vec![0.0; element.corners()];
            element.faces[0].iter().zip(L).for_each(|(&corner, L)| all[corner] = *L);
            element.values(&all)
        };
        for (&node, share) in element.faces[0].iter().zip(&faces) {
            let expected = integral(element.dimension - 1, &|L| on_face(L)[node]);
            assert!((share - expected).abs() < 1e-15, "{}: {share} {expected}", element.name);
        }
        match element.nodes() {
            3 => check_mass::<3>(element),
            4 => check_mass::<4>(element),
            6 => check_mass::<6>(element),
            10 => check_mass::<10>(element),
            nodes => panic!("an element with {nodes} nodes"),
        }
    }
}

#[test]
fn known_shares_have_all_their_digits() {
    let [tetrahedron, linear, quadratic, _] = Element::ALL;
    assert_eq!(load_shares(linear), [1.0 / 3.0; 3]);
    assert_eq!(load_shares(tetrahedron), [0.25; 4]);
    assert_eq!(load_shares(quadratic), [0.0, 0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0]);
    assert_eq!(face_shares(linear), [0.5; 2]);
    assert_eq!(face_shares(tetrahedron), [1.0 / 3.0; 3]);
    assert_eq!(face_shares(quadratic), [1.0 / 6.0, 1.0 / 6.0, 4.0 / 6.0]);
    assert_eq!(lumped_mass_shares(linear), [1.0 / 3.0; 3]);
    assert_eq!(lumped_mass_shares(tetrahedron), [0.25; 4]);
    let [corner, middle] = [1.0 / 19.0, 16.0 / 57.0];
    assert_eq!(lumped_mass_shares(quadratic), [corner, corner, corner, middle, middle, middle]);
    assert_eq!(mass_shares::<4>(tetrahedron)[1], [0.05, 0.1, 0.05, 0.05]);
    // Zienkiewicz and Taylor, The Finite Element Method 1, section 17.2.
    let entries = [
        [6.0, -1.0, -1.0, 0.0, -4.0, 0.0],
        [-1.0, 6.0, -1.0, 0.0, 0.0, -4.0],
        [-1.0, -1.0, 6.0, -4.0, 0.0, 0.0],
        [0.0, 0.0, -4.0, 32.0, 16.0, 16.0],
        [-4.0, 0.0, 0.0, 16.0, 32.0, 16.0],
        [0.0, -4.0, 0.0, 16.0, 16.0, 32.0],
    ];
    assert_eq!(mass_shares::<6>(quadratic), entries.map(|row| row.map(|entry| entry / 180.0)));
}

#[test]
fn a_quadratic_tetrahedron_has_the_shares_that_are_derived_by_hand() {
    let [.., solid] = Element::ALL;
    let of = |corner: f64, middle: f64| [[corner; 4].to_vec(), vec![middle; 6]].concat();
    assert_eq!(load_shares(solid), of(-1.0 / 20.0, 1.0 / 5.0));
    assert_eq!(face_shares(solid), [0.0, 0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0]);
    assert_eq!(lumped_mass_shares(solid), of(1.0 / 36.0, 4.0 / 27.0));
    // 1/420 of: corners 6, 1 beside each other; −4 to the middles of their own edges, −6 to others; middles 32, 16 where edges meet, 8 else.
    let ends = |node: usize| if node < 4 { vec![node] } else { solid.edges[node - 4].to_vec() };
    let mass = mass_shares::<10>(solid);
    for (i, row) in mass.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            let common = ends(i).iter().filter(|end| ends(j).contains(end)).count();
            let expected = match (ends(i).len() + ends(j).len(), common) {
                (2, 1) => 6.0,
                (2, _) => 1.0,
                (3, 1) => -4.0,
                (3, _) => -6.0,
                (_, 2) => 32.0,
                (_, 1) => 16.0,
                _ => 8.0,
            };
            assert_eq!(*entry, expected / 420.0, "{i} {j}");
        }
    }
}
