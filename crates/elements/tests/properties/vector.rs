use fem_elements::vector::{axpy, dot, max_norm, norm, subtract_from, xpby};

#[test]
fn inner_products_count_every_entry_once() {
    for nodes in 0..20 {
        let x: Vec<[f64; 3]> = (0..nodes).map(|i| [f64::from(i), 1.0, -2.0]).collect();
        let direct: f64 = x.as_flattened().iter().map(|x| x * x).sum();
        assert_eq!(dot(&x, &x), direct);
        assert_eq!(norm(&x), direct.sqrt());
    }
}

#[test]
fn updates_write_their_last_argument() {
    let (x, mut y) = ([[1.0, -2.0, 3.0]], [[10.0, 20.0, 30.0]]);
    axpy(2.0, &x, &mut y);
    assert_eq!(y, [[12.0, 16.0, 36.0]]);
    xpby(&x, 0.5, &mut y);
    assert_eq!(y, [[7.0, 6.0, 21.0]]);
    subtract_from(&x, &mut y);
    assert_eq!(y, [[-6.0, -8.0, -18.0]]);
    assert_eq!(max_norm(&y), 18.0);
}
