use fem_elements::sparse::{Pattern, Stored};

#[test]
fn two_triangles_couple_all_nodes_but_the_opposite_ones() {
    let full = Pattern::new(4, &[[0, 1, 2], [1, 3, 2]], Stored::Full);
    assert_eq!(full.blocks(), 14);
    assert_eq!(full.find(0, 3), None);
    assert!(full.find(1, 2).is_some());
    let lower = Pattern::new(4, &[[0, 1, 2], [1, 3, 2]], Stored::Lower);
    assert_eq!(lower.blocks(), 9);
    assert_eq!(lower.find(1, 2), None);
}

#[test]
fn nodes_without_a_row_are_not_coupled() {
    let pattern = Pattern::new(2, &[[0, 1, 2]], Stored::Full);
    assert_eq!(pattern.columns, [0, 1, 0, 1]);
}
