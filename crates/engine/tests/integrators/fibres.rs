//! Families of fibres: bars, derivatives, rotations, symmetry, energies, refusals.

use fem_engine::forces::{HessianKind, Moment};
use fem_engine::simulator::double::System;
use fem_model::simulation::Simulation;
use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::flat::flat;
use crate::nodal_fields::{dot, field, system};
use crate::{SECOND_ORDER, block, build, of_law, run, side, soft, symmetry, try_build};

/// k1 (Pa), k2 and κ.
type Law = [f64; 3];

fn fibres([modulus, exponent, dispersion]: Law, directions: &str) -> String {
    format!("[[fibres]]\nmodulus = {modulus:e}\nexponent = {exponent}\ndispersion = {dispersion}\n{directions}\n")
}

const ALONG_X: &str = "direction = [2, 0, 0]";

/// ψ, J/m³, and ∂ψ/∂E, Pa.
fn energy([k1, k2, _]: Law, strain: f64) -> [f64; 2] {
    let strain = f64::max(strain, 0.0);
    let power = k2 * strain * strain;
    let energy = if k2 > 0.0 { k1 / (2.0 * k2) * power.exp_m1() } else { 0.5 * k1 * strain * strain };
    [energy, k1 * strain * power.exp()]
}

/// ψ of a neo-Hookean bar with E = 1e5 Pa and ν = 0.3 and fibres along it, J/m³, and its slopes by the stretch l and by that of both other
/// axes m, Pa.
fn bar(law: Law, [l, m]: [f64; 2]) -> [f64; 3] {
    let (C, D, kappa) = (1e5 / (4.0 * 1.3), 1e5 / (6.0 * 0.4), law[2]);
    let (J, squares) = (l * m * m, l * l + 2.0 * m * m);
    let g = J.powf(-2.0 / 3.0);
    let by_J = -2.0 / 3.0 * C * g / J * squares + 2.0 * D * (J - 1.0);
    let [of_fibres, slope] = energy(law, kappa * (squares - 3.0) + (1.0 - 3.0 * kappa) * (l * l - 1.0));
    [
        C * (g * squares - 3.0) + D * (J - 1.0).powi(2) + of_fibres,
        2.0 * C * g * l + by_J * m * m + slope * 2.0 * (1.0 - 2.0 * kappa) * l,
        4.0 * C * g * m + by_J * 2.0 * l * m + slope * 4.0 * kappa * m,
    ]
}

/// The stretch of the free sides.
fn lateral(law: Law, l: f64) -> f64 {
    let (mut least, mut most) = (0.3, 2.0);
    for _ in 0..200 {
        let m = 0.5 * (least + most);
        if bar(law, [l, m])[2] < 0.0 { least = m } else { most = m }
    }
    least
}

/// Force along x on the side that is moved, N: its area is 1 m².
fn pull(simulation: &dyn Simulation) -> f64 {
    simulation.reactions().iter().find(|reaction| reaction.name == "prescribed[3]").unwrap().force[0]
}

#[test]
fn a_bar_that_is_pulled_along_its_fibres_has_the_force_the_energy_and_the_stress_of_the_closed_form() {
    for law in [[2e4, 0.0, 0.0], [2e4, 0.7, 0.0], [3e4, 0.5, 0.2], [3e4, 0.5, 1.0 / 3.0]] {
        for stretch in [0.8, 1.1, 1.6] {
            let moved = side("x", "max", 2.0 * (stretch - 1.0));
            let text = block("neo_hookean", &format!("{}{moved}{}", symmetry(), fibres(law, ALONG_X)));
            let text = text + "[static]\nload_steps = 3\n";
            for key in ["", "order = 2\n", "averaged"] {
                let text = match key {
                    "averaged" => text.replace("[material]\n", "[material]\nvolumetric = \"averaged\"\n"),
                    key => text.replace("[material]", &format!("{key}[material]")),
                };
                let mut simulation = build(&text);
                run(&mut *simulation, 3);
                let m = lateral(law, stretch);
                let [energy, force, _] = bar(law, [stretch, m]);
                let found = pull(&*simulation);
                assert!(
                    (found - force).abs() < 1e-10 * (force.abs() + 1e3),
                    "{law:?} {stretch} {key}: {found} {force}"
                );
                let stored = simulation.energies().potential;
                assert!((stored - 2.0 * energy).abs() < 1e-10 * energy, "{law:?} {stretch} {key}: {stored} {energy}");
                let expected = Matrix3::from_diagonal(&Vector3::new(force / (m * m), 0.0, 0.0));
                for stress in simulation.stresses() {
                    assert!((stress - expected).amax() < 1e-9 * (force.abs() + 1e3), "{stress} {expected}");
                }
            }
        }
    }
}

#[test]
fn compressed_fibres_have_no_force() {
    let rest = |fibres: &str| format!("{}{}{fibres}", symmetry(), side("x", "max", -0.3));
    let [mut with, mut without] =
        [fibres([1e6, 3.0, 0.0], ALONG_X), String::new()].map(|fibres| build(&block("neo_hookean", &rest(&fibres))));
    run(&mut *with, 1);
    run(&mut *without, 1);
    assert!((pull(&*with) - pull(&*without)).abs() < 1e-12 * pull(&*without).abs());
}

#[test]
fn two_symmetric_families_have_no_shear_stress_and_one_has() {
    let helix = |angle: f64| fibres([5e4, 0.4, 0.1], &format!("direction = [{}, {}, 0]", angle.cos(), angle.sin()));
    let shear = |families: &str| {
        let mut simulation =
            build(&block("neo_hookean", &format!("{}{}{families}", symmetry(), side("x", "max", 0.4))));
        run(&mut *simulation, 1);
        let stresses = simulation.stresses();
        let largest = |entry: (usize, usize)| stresses.iter().map(|stress| stress[entry].abs()).fold(0.0, f64::max);
        largest((0, 1)) / largest((0, 0))
    };
    let [two, one] = [helix(0.5) + &helix(-0.5), helix(0.5)].map(|families| shear(&families));
    assert!(two < 1e-10 && one > 1e-2, "{two:e} {one:e}");
}

/// Three bodies with two families: of linear and of quadratic tetrahedra, and of triangles.
fn bodies() -> [String; 3] {
    let families =
        fibres([2e4, 0.6, 0.15], "direction = [1, -0.5, 0]") + &fibres([5e3, 0.0, 0.0], "direction = [0, 1, 0]");
    let text = soft("static", 1.0, &families);
    [text.clone(), text.replace(" }\n[material]", " }\norder = 2\n[material]"), flat(&text)]
}

/// The gradient of the energy of all forces, N.
fn gradient(system: &System, u: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut gradient = vec![[0.0; 3]; system.nodes()];
    system.add_gradient_of_forces(u, Moment::at(0.0), &mut gradient);
    gradient
}

#[test]
fn forces_and_stiffness_are_the_derivatives_of_the_energy_and_the_stiffness_has_no_negative_energy() {
    for text in bodies() {
        let system = system(&text);
        let (moment, h) = (Moment::at(0.0), 1e-6);
        for phase in 0..6 {
            let of = |size: f64, phase: f64| field(&system, size, phase);
            let (u, d) = (of(0.05, f64::from(phase)), of(1.0, 2.0 + 0.7 * f64::from(phase)));
            let ahead = |h: f64| -> Vec<[f64; 3]> {
                u.iter().zip(&d).map(|(u, d)| std::array::from_fn(|i| u[i] + h * d[i])).collect()
            };
            let [above, below] = [h, -h].map(|h| system.energy_of_forces(&ahead(h), moment).value);
            let (slope, expected) = (dot(&gradient(&system, &u), &d), (above - below) / (2.0 * h));
            assert!(slope.abs() > 1.0 && (slope - expected).abs() < 1e-6 * slope.abs(), "{slope} {expected}");
            let mut curvature = 0.0;
            for (force, _) in system.forces.active() {
                force.hessian(&u, moment, HessianKind::Exact, &mut |row, column, block| {
                    for i in 0..3 {
                        curvature += d[row][i] * (0..3).map(|j| block[i][j] * d[column][j]).sum::<f64>();
                    }
                });
            }
            let [above, below] = [h, -h].map(|h| dot(&gradient(&system, &ahead(h)), &d));
            let expected = (above - below) / (2.0 * h);
            assert!(curvature > 0.0 && (curvature - expected).abs() < 1e-6 * curvature, "{curvature} {expected}");
        }
    }
}

#[test]
fn a_rotation_keeps_the_energy_and_turns_the_forces() {
    for text in bodies() {
        let system = system(&text);
        let is_flat = system.shape.mesh.dimension() == 2;
        let axis = if is_flat { Vector3::z_axis() } else { Vector3::y_axis() };
        let R = Rotation3::from_axis_angle(&axis, 1.2);
        let u = field(&system, 0.05, 0.4);
        let turned: Vec<[f64; 3]> =
            u.iter().zip(&system.rest).map(|(u, x)| (R * (Vector3::from(*u) + x) - x).into()).collect();
        let [before, after] = [&u, &turned].map(|u| system.energy_of_forces(u, Moment::at(0.0)).value);
        assert!(before > 1.0 && (after - before).abs() < 1e-12 * before, "{before} {after}");
        for (before, after) in gradient(&system, &u).into_iter().zip(gradient(&system, &turned)) {
            assert!((R * Vector3::from(before) - Vector3::from(after)).norm() < 1e-10 * 2e4, "{before:?} {after:?}");
        }
    }
}

#[test]
fn vibrations_keep_their_energy_and_the_account_closes() {
    let rest = "[[initial_velocity]]\nvelocity = [0, 0, 0]\nangular = { axis = [0, 0, 1], rate = 3.0 }\n\
                [fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    let families = fibres([2e4, 0.8, 0.1], "direction = [1, 0.3, 0]");
    for integrator in SECOND_ORDER.into_iter().chain(["verlet", "semi_implicit_euler", "implicit_euler", "rk4"]) {
        let mut simulation = build(&soft(integrator, 1e-3, &format!("{rest}{families}")));
        let start = simulation.energies().total();
        run(&mut *simulation, 500);
        assert!(simulation.failure_at_end().is_none(), "{integrator}");
        let ledger = simulation.energy_ledger().unwrap();
        assert!((ledger.start - start).abs() < 1e-12 * start, "{integrator}: {ledger:?} {start}");
        if !["implicit_euler", "bdf2", "bathe", "generalized_alpha"].contains(&integrator) {
            assert!((simulation.energies().total() / start - 1.0).abs() < 1e-2, "{integrator}");
            assert!(ledger.numerical().abs() < 1e-2 * ledger.start, "{integrator}: {ledger:?}");
        }
    }
}

#[test]
fn in_single_precision_a_bar_has_the_same_force() {
    let law = [2e4, 0.7, 0.1];
    let text = soft("static", 1.0, &format!("{}{}{}", symmetry(), side("x", "max", 0.6), fibres(law, ALONG_X)));
    let text = of_law("neo_hookean", &text).replace("[time]", "[time]\nprecision = \"f32\"");
    let mut simulation = build(&text);
    run(&mut *simulation, 1);
    let expected = bar(law, [1.3, lateral(law, 1.3)])[1];
    assert!((pull(&*simulation) / expected - 1.0).abs() < 1e-4, "{} {expected}", pull(&*simulation));
}

#[test]
fn an_energy_beyond_the_range_of_numbers_is_never_a_state() {
    for (precision, exponent) in [("f32", 1e3), ("f64", 1e5)] {
        let tables = format!("{}{}{}", symmetry(), side("x", "max", 1.0), fibres([2e4, exponent, 0.0], ALONG_X));
        let text = soft("static", 1.0, &tables).replace("[time]", &format!("[time]\nprecision = \"{precision}\""));
        let mut simulation = build(&text);
        let outcome = simulation.step().map_err(|failure| failure.to_string());
        assert!(outcome.is_err_and(|text| text.len() > 20), "the stretch of 1.5 has no finite energy");
        assert!(simulation.positions().iter().all(|x| x.is_finite()));
        assert!(simulation.energies().total().is_finite());
    }
}

#[test]
fn fibres_that_a_method_or_a_body_cannot_have_are_refused_with_the_remedy() {
    let message = |text: &str| try_build(text).map(|_| ()).expect_err(text).to_string();
    let family = fibres([1e4, 1.0, 0.0], ALONG_X);
    for integrator in ["pbd", "xpbd", "vbd", "projective_dynamics"] {
        let text = message(&soft(integrator, 0.01, &family));
        assert!(text.contains("`fibres`") && text.contains("use implicit_euler"), "{integrator}: {text}");
    }
    let flow = "[plasticity]\nmodel = \"j2\"\nyield_stress = 1e4\n";
    let text = message(&(of_law("hencky", &soft("static", 1.0, &family)) + flow));
    assert!(text.contains("remove the tables, or [plasticity]"), "{text}");
    let sheet =
        flat(&of_law("linear", &soft("static", 1.0, &family))).replace("thickness", "plane = \"stress\"\nthickness");
    assert!(message(&sheet).contains("fibres are not known in plane stress"), "{}", message(&sheet));
}
