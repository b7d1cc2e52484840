//! The checks whose inputs are edge cases: limits of the formula, of the line search and of floating-point numbers, points on a boundary,
//! empty lists. A function that is right elsewhere and wrong there is nearly right.

/// Each function that has such checks, and these.
pub const EDGE_CASES: &[(&str, &[&str])] = &[
    (
        "phi_linear_tetrahedron",
        &["far_from_the_origin_no_digits_are_lost", "millimetres_and_kilometres_give_the_same_values"],
    ),
    ("dphi_linear_tetrahedron_dX", &["far_from_the_origin_no_digits_are_lost"]),
    (
        "psi_neo_hookean",
        &[
            "flat_and_inverted_states_have_infinite_energy",
            "strong_but_possible_states_have_a_finite_energy",
            "near_rest_the_error_is_round_off_of_the_terms",
        ],
    ),
    (
        "V_linear_tetrahedron",
        &["an_inverted_element_has_infinite_energy", "an_element_far_from_the_origin_stores_the_same_energy"],
    ),
    ("dV_linear_tetrahedron_dq", &["an_element_far_from_the_origin_has_the_same_force"]),
    ("V_spring_particle_particle", &["a_spring_of_zero_length_stores_the_energy_of_its_rest_length"]),
    (
        "dV_spring_particle_particle_dq",
        &["a_spring_of_zero_length_has_a_zero_gradient", "a_very_short_spring_still_pushes"],
    ),
    ("mass_matrix_mesh", &["vertices_without_elements_have_no_mass_and_the_matrix_keeps_its_size"]),
    ("assemble_stiffness", &["vertices_without_elements_have_no_stiffness_and_the_matrix_keeps_its_size"]),
    (
        "build_skinning_matrix",
        &[
            "vertices_edges_and_faces_belong_to_the_elements_that_they_bound",
            "a_point_just_outside_an_element_belongs_to_the_neighbour_that_holds_it",
            "a_point_in_no_element_goes_to_the_one_with_the_largest_smallest_weight",
            "no_display_vertices_give_a_matrix_without_rows",
            "far_from_the_origin_the_display_still_follows",
        ],
    ),
    (
        "fixed_point_constraints",
        &[
            "no_fixed_vertices_give_the_identity",
            "repeats_count_once_and_order_does_not_matter",
            "all_vertices_fixed_give_a_matrix_without_rows",
        ],
    ),
    (
        "pick_nearest_vertices",
        &[
            "vertices_in_front_of_the_near_plane_are_not_picked",
            "no_ray_slips_through_between_two_triangles",
            "just_outside_an_edge_is_a_miss",
            "a_triangle_seen_edge_on_is_not_hit",
        ],
    ),
    (
        "newtons_method",
        &[
            "states_without_an_energy_are_refused",
            "zero_steps_leave_the_start_and_return_f_there",
            "a_start_at_the_minimum_needs_no_hessian",
            "the_decrease_is_at_least_1e_8_of_that_of_the_linear_model",
            "the_smallest_step_above_1e_8_is_still_tried",
            "infinite_and_undefined_values_are_never_accepted",
            "an_infinite_start_takes_the_first_finite_step_and_no_other",
            "a_direction_without_an_answer_leaves_x_as_it_was",
        ],
    ),
    ("implicit_euler", &["a_body_at_rest_stays_without_a_solve"]),
];
