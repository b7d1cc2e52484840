//! The positive semi-definite projection raises negative eigenvalues to zero and keeps the others.

use super::*;

fn transposed(H: &Tensor4<f64>) -> Tensor4<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| H[j][i]))
}

/// The same by eigenvalues of the whole 9×9 matrix.
fn projected_by_eigenvectors(H: &Tensor4<f64>) -> Tensor4<f64> {
    let eigen = nalgebra::SMatrix::<f64, 9, 9>::from_fn(|i, j| H[i][j]).symmetric_eigen();
    let raised = eigen.eigenvalues.map(|value| value.max(0.0));
    let H = eigen.eigenvectors * nalgebra::SMatrix::from_diagonal(&raised) * eigen.eigenvectors.transpose();
    std::array::from_fn(|i| std::array::from_fn(|j| H[(i, j)]))
}

fn check(name: &str, law: &dyn Law<f64>, G: &Tensor<f64>) {
    let (H, raised) = (law.derivative(G), law.projected_derivative(G));
    let size = largest(&H);
    assert!(distance(&H, &transposed(&H)) <= 1e-14 * size, "{name}: {G:?}");
    assert!(distance(&raised, &transposed(&raised)) <= 1e-14 * size, "{name}: {G:?}");
    assert!(eigenvalues(&raised)[0] >= -1e-13 * size, "{name}: {:?} at {G:?}", eigenvalues(&raised));
    let expected = projected_by_eigenvectors(&H);
    assert!(distance(&raised, &expected) <= 1e-12 * size, "{name}: {:e} at {G:?}", distance(&raised, &expected) / size);
    if eigenvalues(&H)[0] > 0.0 {
        assert!(distance(&raised, &H) <= 1e-12 * size, "{name}: positive, but changed at {G:?}");
    }
}

fn check_upright(name: &str, law: &dyn Law<f64>) {
    let gradients = upright();
    gradients.iter().for_each(|G| check(name, law, G));
    let positive = gradients.iter().filter(|G| eigenvalues(&law.derivative(G))[0] > 0.0).count();
    let negative = gradients.iter().filter(|G| eigenvalues(&law.derivative(G))[0] < -1e-6).count();
    assert!(name == "linear" || positive > 10 && negative > 10, "{name}: {positive} positive, {negative} negative");
}

#[test]
fn negative_eigenvalues_become_zero_and_the_others_stay() {
    for_all_laws(check_upright);
}

#[test]
fn the_projection_also_holds_for_inverted_and_flat_elements() {
    for G in any() {
        for_all_laws_with_inversion(|name, law| check(name, law, &G));
    }
}
