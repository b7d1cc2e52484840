//! The energy of the volume averaged over patches, or with pressures as unknowns: derivatives, affine states, and bodies that hardly change their
//! volume or do not change it at all.

use std::collections::HashMap;
use std::path::Path;

use fem_engine::cantilever::{expected_tip_displacement, tip_displacement};
use fem_engine::forces::{HessianKind, Moment};
use fem_engine::simulator::double::{self, System};
use fem_mesh::{Pattern, rectangle_mesh};
use fem_model::simulation::Simulation;
use fem_model::{Axis, Body, BodyMesh, Elastic, Integrator, Law, Material, Method, NeoHookean, Selector, Volumetric};

use nalgebra::{DMatrix, DVector, Vector3};

use crate::flat::{affine, flat};
use crate::nodal_fields::{dot, field, sum, system};
use crate::{SECOND_ORDER, block, build, distance, of_law, run, scene, side, soft, symmetry, try_build};

/// The laws that have an energy of the volume.
fn laws() -> impl Iterator<Item = &'static str> {
    Law::FACTS.iter().filter(|facts| facts.volume.is_some()).map(|facts| facts.name)
}

fn averaged(text: &str) -> String {
    with_volume("averaged", text)
}

fn mixed(text: &str) -> String {
    with_volume("mixed", text)
}

fn with_volume(volumetric: &str, text: &str) -> String {
    text.replace("density = 1000.0", &format!("density = 1000.0\nvolumetric = \"{volumetric}\""))
}

fn quadratic(text: &str) -> String {
    text.replace(" }\n[material]", " }\norder = 2\n[material]")
}

/// A scene with each kind of element.
fn with_elements(text: &str) -> [String; 4] {
    [text.to_owned(), quadratic(text), flat(text), quadratic(&flat(text))]
}

#[test]
fn forces_and_stiffness_are_the_derivatives_of_the_energy_with_every_element() {
    for text in laws().flat_map(|model| with_elements(&averaged(&block(model, "")))) {
        let system = system(&text);
        let (u, d, moment, h) = (field(&system, 0.04, 0.3), field(&system, 1.0, 2.0), Moment::at(0.0), 1e-6);
        let gradient = |u: &[[f64; 3]]| {
            let mut gradient = vec![[0.0; 3]; system.nodes()];
            double::gradient(&system, u, moment, &mut gradient);
            gradient
        };
        let [ahead, back] = [h, -h].map(|h| sum(&u, h, &d));
        let [above, below] = [&ahead, &back].map(|u| double::potential(&system, u, moment).value);
        let (slope, by_differences) = (dot(&gradient(&u), &d), (above - below) / (2.0 * h));
        assert!((slope - by_differences).abs() < 1e-6 * slope.abs(), "{slope} {by_differences}\n{text}");
        let mut product = vec![[0.0; 3]; system.nodes()];
        double::add_stiffness_times(&system, &u, &d, &mut product);
        let by_differences = sum(&gradient(&ahead), -1.0, &gradient(&back));
        let largest = product.as_flattened().iter().fold(0.0, |largest, x| f64::max(largest, x.abs()));
        for (x, y) in product.as_flattened().iter().zip(by_differences.as_flattened()) {
            assert!((x - y / (2.0 * h)).abs() < 1e-6 * largest, "{x} {}\n{text}", y / (2.0 * h));
        }
        assert!((dot(&matrix_times(&system, &u, &d), &d) - dot(&product, &d)).abs() < 1e-10 * largest, "{text}");
    }
}

/// The assembled stiffness times a vector.
fn matrix_times(system: &System, u: &[[f64; 3]], d: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
    double::add_stiffness(system, u, &mut values);
    let mut product = vec![[0.0; 3]; system.nodes()];
    for row in 0..system.pattern.rows() {
        for place in system.pattern.row(row) {
            let column = system.pattern.columns[place] as usize;
            for i in 0..3 {
                for j in 0..3 {
                    product[row][i] += values[place][i][j] * d[column][j];
                    if column < row {
                        product[column][j] += values[place][i][j] * d[row][i];
                    }
                }
            }
        }
    }
    product
}

#[test]
fn projected_stiffness_has_no_negative_energy_where_the_exact_one_has() {
    let text = of_law("hencky", &soft("static", 1.0, ""));
    let mut is_indefinite = false;
    let (patches, pressures) = (with_elements(&averaged(&text)), with_elements(&mixed(&text)));
    for (text, size) in
        patches.into_iter().map(|text| (text, 0.12)).chain(pressures.into_iter().map(|text| (text, 0.04)))
    {
        let system = system(&text);
        let u = field(&system, size, 0.3);
        for phase in (0..40).map(f64::from) {
            let d = field(&system, 1.0, phase);
            let [exact, projected] = [HessianKind::Exact, HessianKind::Projected].map(|kind| {
                let mut energy = 0.0;
                for (force, _) in system.forces.active() {
                    force.hessian(&u, Moment::at(0.0), kind, &mut |row, column, block| {
                        for i in 0..3 {
                            energy += d[row][i] * (0..3).map(|j| block[i][j] * d[column][j]).sum::<f64>();
                        }
                    });
                }
                energy
            });
            assert!(projected >= 0.0 && projected >= exact - 1e-9 * projected, "{exact} {projected}\n{text}");
            is_indefinite |= exact < 0.0;
        }
    }
    assert!(is_indefinite, "no state of the test needs a projection");
}

#[test]
fn a_free_body_has_no_motion_without_energy_but_rigid_ones() {
    for text in with_elements(&averaged(&soft("static", 1.0, ""))) {
        let text = text.replace("[2, 1, 1]", "[1, 1, 1]");
        let text = text.replace("[2, 1]", "[1, 1]").replace("cells_per_unit = 3", "cells_per_unit = 1");
        let system = system(&text);
        let (nodes, dimension) = (system.nodes(), system.shape.mesh.dimension());
        let u = vec![[0.0; 3]; nodes];
        let K = DMatrix::from_columns(&Vec::from_iter((0..dimension * nodes).map(|k| {
            let mut unit = u.clone();
            unit[k / dimension][k % dimension] = 1.0;
            let product = matrix_times(&system, &u, &unit);
            DVector::from_fn(dimension * nodes, |row, _| product[row / dimension][row % dimension])
        })));
        let values = K.symmetric_eigenvalues();
        let without_energy = values.iter().filter(|value| **value < 1e-4 * values.max()).count();
        assert_eq!(without_energy, if dimension == 3 { 6 } else { 3 }, "{values}\n{text}");
    }
}

#[test]
fn an_affine_state_has_the_energy_and_the_stress_of_elements_in_the_standard_form() {
    let G = [[0.08, 0.05], [-0.02, -0.03]];
    let linear = rectangle_mesh([2.0, 1.0], 3, Pattern::Alternating).unwrap();
    let mesh = BodyMesh::flat(linear.clone(), 0.3).of_order(2).unwrap().mesh::<6>().unwrap();
    for model in laws() {
        let texts = [flat(&block(model, &affine(&linear, G))), quadratic(&flat(&block(model, &affine(&mesh, G))))];
        for text in texts {
            let [standard, patches, pressures] = [text.clone(), averaged(&text), mixed(&text)].map(|text| {
                let mut simulation = build(&text);
                run(&mut *simulation, 1);
                simulation
            });
            for other in [patches, pressures] {
                assert!(distance(&standard.positions(), &other.positions()) < 1e-11, "{text}");
                let [found, expected] = [&other, &standard].map(|simulation| simulation.energies().potential);
                assert!((found - expected).abs() < 1e-11 * expected, "{found} {expected}\n{text}");
                let [found, expected] = [&other, &standard].map(|simulation| simulation.stresses_at_points()[7]);
                assert!((found - expected).amax() < 1e-9 * expected.amax(), "{found} {expected}\n{text}");
            }
        }
    }
}

/// Tip displacement over Timoshenko's of a cantilever of 8 × 1 × 1 m under a load at its end.
fn cantilever(order: usize, cells: usize, poisson: f64, volumetric: &str) -> f64 {
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [8, 1, 1], cells_per_unit = {cells}, pattern = \"kuhn\" }}\norder = {order}\n[material]\n\
         model = \"linear\"\nyoung = 1e6\npoisson = {poisson}\ndensity = 1000.0\nvolumetric = \"{volumetric}\"\n[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n\
         [[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\nforce_per_area = [0, 0, -50]\n[time]\nintegrator = \"static\"\nsteps = 1\n"
    );
    let scene = scene(&text);
    let body = fem_scene::body(&scene, Path::new("no data")).unwrap();
    let expected = expected_tip_displacement(&body, &scene.method()).unwrap();
    let mut simulation = fem_engine::simulator::build(body, &scene.method()).unwrap();
    run(&mut *simulation, 1);
    tip_displacement(&*simulation).z / expected.z
}

#[test]
fn a_nearly_incompressible_cantilever_no_longer_locks() {
    let [locked, freed] = ["standard", "averaged"].map(|volumetric| cantilever(1, 3, 0.4999, volumetric));
    assert!(locked < 0.03 && freed > 0.72, "{locked} {freed}");
    let [standard, freed] = ["standard", "averaged"].map(|volumetric| cantilever(2, 3, 0.4999, volumetric));
    assert!(standard < 0.96 && (0.98..1.0).contains(&freed), "{standard} {freed}");
    let [less, more] = [0.49, 0.49999].map(|poisson| cantilever(1, 3, poisson, "averaged"));
    assert!((less - more).abs() < 0.01, "{less} {more}");
}

/// The vertical displacement of the upper corner of Cook's membrane, plane strain, κ/μ = 5000, m: J. C. Simo and F. Armero, Geometrically Non-linear
/// Enhanced Strain Mixed Methods and the Method of Incompatible Modes (1992).
fn cook(order: usize, pattern: Pattern, volumetric: Volumetric) -> f64 {
    let law = Law::NeoHookean(NeoHookean::Moduli { C: 40.0969, D: 200_471.6 });
    cook_of(law, order, pattern, volumetric).0
}

/// The same of a law, and the number of Newton's iterations.
fn cook_of(law: Law, order: usize, pattern: Pattern, volumetric: Volumetric) -> (f64, usize) {
    let (simulation, corner) = bent_membrane(law, 16, order, pattern, volumetric);
    (simulation.positions()[3 * corner + 1] - 60.0, simulation.counters().newton_iterations)
}

/// Cook's membrane under its load, and the node of its upper corner.
fn bent_membrane(
    law: Law,
    cells: usize,
    order: usize,
    pattern: Pattern,
    volumetric: Volumetric,
) -> (Box<dyn Simulation>, usize) {
    let mut mesh = rectangle_mesh([1.0, 1.0], cells, pattern).unwrap();
    for x in &mut mesh.vertices {
        let [s, t] = [x.x, x.y];
        *x = Vector3::new(48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s), 0.0);
    }
    let corner = (0..mesh.vertices.len()).max_by(|a, b| mesh.vertices[*a].y.total_cmp(&mesh.vertices[*b].y)).unwrap();
    let material = Material { volumetric, ..Material::new(law, 1.0) };
    let body = Body::new(BodyMesh::flat(mesh, 1.0).of_order(order).unwrap(), material).unwrap();
    let body = body.fix(&Selector::least(Axis::X)).unwrap();
    let body = body.traction(&Selector::most(Axis::X), [0.0, 6.25, 0.0]).unwrap();
    let method = Method { load_steps: 8, ..Method::new(Integrator::Static, 1.0) };
    let mut simulation = fem_engine::simulator::build(body, &method).unwrap();
    run(&mut *simulation, 8);
    (simulation, corner)
}

/// Jump of the pressure from element to element, relative to the pressure, both as means of squares.
fn oscillation(cells: usize, volumetric: Volumetric) -> f64 {
    let law = Law::NeoHookean(NeoHookean::Moduli { C: 40.0969, D: 200_471.6 });
    let (simulation, _) = bent_membrane(law, cells, 1, Pattern::Alternating, volumetric);
    let pressures: Vec<f64> = simulation.stresses().iter().map(|stress| stress.trace() / 3.0).collect();
    let mut at_edge = HashMap::new();
    let mut jumps = Vec::new();
    for (element, corners) in simulation.shape().mesh.corners().enumerate() {
        for [a, b] in [[0, 1], [1, 2], [2, 0]].map(|edge| edge.map(|k: usize| corners[k])) {
            if let Some(other) = at_edge.insert([a.min(b), a.max(b)], element) {
                jumps.push(pressures[element] - pressures[other]);
            }
        }
    }
    let size = |of: &[f64]| (of.iter().map(|x| x * x).sum::<f64>() / of.len() as f64).sqrt();
    size(&jumps) / size(&pressures)
}

#[test]
fn pressures_oscillate_from_element_to_element_in_the_standard_form_alone() {
    let locked = oscillation(16, Volumetric::Standard);
    assert!(locked > 1.0, "{locked}");
    for volumetric in [Volumetric::Averaged, Volumetric::Mixed] {
        let [coarse, fine] = [8, 16].map(|cells| oscillation(cells, volumetric));
        assert!(fine < 0.75 * coarse && fine < 0.4, "{volumetric:?}: {coarse} {fine}");
    }
}

#[test]
fn cooks_membrane_reaches_its_published_deflection_whichever_way_the_cells_are_cut() {
    let reference = 6.93;
    for pattern in [Pattern::Kuhn, Pattern::Alternating] {
        let quadratic = cook(2, pattern, Volumetric::Averaged);
        assert!((quadratic - reference).abs() < 0.01 * reference, "{pattern:?}: {quadratic}");
        let linear = cook(1, pattern, Volumetric::Averaged);
        assert!((linear - reference).abs() < 0.05 * reference, "{pattern:?}: {linear}");
    }
    let locked = cook(1, Pattern::Kuhn, Volumetric::Standard);
    assert!(locked < 0.6 * reference, "{locked}");
}

#[test]
fn bodies_whose_volume_stands_apart_keep_their_energy_and_their_angular_momentum_in_motion() {
    let moving = "[[initial_velocity]]\nvelocity = [0, 0, 0]\nangular = { axis = [0, 0, 1], rate = 2.0 }\n";
    for integrator in SECOND_ORDER.into_iter().chain(["verlet", "implicit_euler", "linearly_implicit_euler"]) {
        let text = of_law("neo_hookean", &soft(integrator, 2e-3, moving));
        let kinds = if integrator == "verlet" || integrator == "linearly_implicit_euler" { 1 } else { 2 };
        for text in
            [averaged(&text), mixed(&text)].into_iter().take(kinds).flat_map(|text| [text.clone(), quadratic(&text)])
        {
            let mut simulation = build(&text);
            let (start, spin) = (simulation.energies().total(), angular_momentum(&*simulation));
            run(&mut *simulation, 50);
            let (energy, now) = (simulation.energies().total(), angular_momentum(&*simulation));
            assert!(energy < start * (1.0 + 1e-3), "{integrator}: {start} {energy}");
            assert!((now - spin).abs() < 2e-2 * spin.abs(), "{integrator}: {spin} {now}");
            assert!(simulation.failure_at_end().is_none(), "{integrator}");
        }
    }
}

/// About the z axis, kg m²/s, with a mass that is the same at every node.
fn angular_momentum(simulation: &dyn Simulation) -> f64 {
    let (q, v) = (simulation.positions(), simulation.velocities());
    let nodes = q.len() / 3;
    let middle = (0..nodes).map(|node| q.fixed_rows::<3>(3 * node).into_owned()).sum::<Vector3<f64>>() / nodes as f64;
    (0..nodes)
        .map(|node| (q.fixed_rows::<3>(3 * node) - middle).cross(&v.fixed_rows::<3>(3 * node).into_owned()).z)
        .sum()
}

#[test]
fn laws_without_an_energy_of_the_volume_and_methods_in_sweeps_are_refused_with_the_remedy() {
    for model in Law::FACTS.iter().filter(|facts| facts.volume.is_none()).map(|facts| facts.name) {
        let message = try_build_error(&averaged(&block(model, "")));
        assert!(message.contains("material.volumetric is \"averaged\", and `"), "{message}");
        assert!(message.contains("take linear, neo_hookean, hencky"), "{message}");
    }
    for integrator in Integrator::ALL.into_iter().filter(|integrator| integrator.is_iterated()) {
        let message = try_build_error(&averaged(&soft(integrator.name(), 1e-3, "")));
        assert!(message.contains("material.volumetric") && message.contains("implicit_euler"), "{message}");
    }
    let sheet = averaged(&flat(&block("linear", ""))).replace("thickness", "plane = \"stress\"\nthickness");
    let message = try_build_error(&sheet);
    assert!(message.contains("in plane stress"), "{message}");
    let course = averaged(&soft("implicit_euler", 1e-3, "")).replace("\"engine\"", "\"course\"");
    let message = try_build_error(&course);
    assert!(message.contains("belongs to the engine"), "{message}");
}

fn try_build_error(text: &str) -> String {
    let parsed = fem_scene::parse(text, Path::new("folder/name.toml")).map(|_| ());
    parsed.and_then(|()| try_build(text).map(|_| ())).expect_err(text).to_string()
}

#[test]
fn forces_of_pressures_are_the_derivative_of_the_energy_with_every_element() {
    for text in laws().flat_map(|model| with_elements(&mixed(&block(model, "")))) {
        let system = system(&text);
        let (u, d, moment, h) = (field(&system, 0.04, 0.3), field(&system, 1.0, 2.0), Moment::at(0.0), 1e-6);
        let mut gradient = vec![[0.0; 3]; system.nodes()];
        double::gradient(&system, &u, moment, &mut gradient);
        let [above, below] = [h, -h].map(|h| double::potential(&system, &sum(&u, h, &d), moment).value);
        let (slope, by_differences) = (dot(&gradient, &d), (above - below) / (2.0 * h));
        assert!((slope - by_differences).abs() < 1e-6 * slope.abs(), "{slope} {by_differences}\n{text}");
    }
}

#[test]
fn an_incompressible_bar_has_the_stress_and_the_volume_of_the_closed_form() {
    let stretch = 1.8;
    let pull = symmetry() + &side("x", "max", 2.0 * (stretch - 1.0));
    let text = format!("[static]\nload_steps = 4\n[newton]\ntolerance = 1e-12\n{pull}");
    let text = mixed(&of_law("neo_hookean", &soft("static", 1.0, &text))).replace("poisson = 0.3", "poisson = 0.5");
    for text in [text.clone(), quadratic(&text)] {
        let mut simulation = build(&text);
        run(&mut *simulation, 4);
        // Cauchy stress μ (λ² − 1/λ) with μ = E/3: Ogden, Non-Linear Elastic Deformations (1984), section 4.3.
        let expected = 1e5 / 3.0 * (stretch * stretch - 1.0 / stretch);
        for stress in simulation.stresses_at_points() {
            assert!((stress[(0, 0)] - expected).abs() < 1e-6 * expected, "{stress} {expected}");
            assert!(stress[(1, 1)].abs() < 1e-6 * expected && stress[(2, 2)].abs() < 1e-6 * expected, "{stress}");
        }
        let q = simulation.positions();
        let width = (0..q.len() / 3).map(|node| q[3 * node + 1]).fold(0.0, f64::max);
        assert!((width - 1.0 / f64::sqrt(stretch)).abs() < 1e-7, "{width}");
    }
}

#[test]
fn an_incompressible_body_that_bends_keeps_its_volume_and_its_reactions_carry_the_load() {
    let tables = "[static]\nload_steps = 3\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n\
                  [[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [0, 0, -2e3]\n";
    let text = mixed(&of_law("neo_hookean", &soft("static", 1.0, tables))).replace("poisson = 0.3", "poisson = 0.5");
    for text in [text.clone(), quadratic(&text)] {
        let text = text.replace("cells_per_unit = 1", "cells_per_unit = 2");
        let mut simulation = build(&text);
        run(&mut *simulation, 3);
        let reaction = simulation.reactions()[0].force;
        assert!((reaction[2] - 2e3).abs() < 1e-6 * 2e3, "{reaction:?}");
        let (mesh, q) = (&simulation.shape().mesh, simulation.positions());
        let at = |node: usize| q.fixed_rows::<3>(3 * node).into_owned();
        let drop = (0..q.len() / 3).map(|node| 1.0 - at(node).z).fold(0.0, f64::max);
        assert!(drop > 0.1, "{drop}");
        if mesh.element().order == 1 {
            let of = |x: &[usize]| {
                let [a, b, c] = [1, 2, 3].map(|k| at(x[k]) - at(x[0]));
                a.dot(&b.cross(&c)) / 6.0
            };
            let volume: f64 = mesh.corners().map(of).sum();
            assert!((volume - 2.0).abs() < 1e-7, "{volume}");
        }
    }
}

#[test]
fn cooks_membrane_with_pressures_takes_a_few_iterations_a_step_also_where_it_is_incompressible() {
    let reference = 6.93;
    let incompressible = |order, pattern| {
        let law = Law::NeoHookean(NeoHookean::Elastic(Elastic::new(3.0 * 80.1938, 0.5)));
        cook_of(law, order, pattern, Volumetric::Mixed)
    };
    for pattern in [Pattern::Kuhn, Pattern::Alternating] {
        let (tip, iterations) = incompressible(2, pattern);
        assert!((tip - reference).abs() < 0.01 * reference && iterations <= 48, "{pattern:?}: {tip} {iterations}");
        let (tip, iterations) = incompressible(1, pattern);
        assert!((tip - reference).abs() < 0.09 * reference && iterations <= 48, "{pattern:?}: {tip} {iterations}");
    }
}

#[test]
fn an_incompressible_cantilever_bends_as_one_that_is_nearly_so() {
    let [nearly, exactly] = [0.4999, 0.5].map(|poisson| cantilever(2, 3, poisson, "mixed"));
    assert!((nearly - exactly).abs() < 1e-3 && (0.96..0.98).contains(&exactly), "{nearly} {exactly}");
    let [nearly, exactly] = [0.4999, 0.5].map(|poisson| cantilever(1, 3, poisson, "mixed"));
    assert!((nearly - exactly).abs() < 1e-3 && exactly > 0.72, "{nearly} {exactly}");
}

#[test]
fn pressures_refuse_methods_and_solvers_that_do_not_know_them_with_the_remedy() {
    let text = mixed(&of_law("neo_hookean", &soft("verlet", 1e-4, "")));
    let message = try_build_error(&text);
    assert!(message.contains("material.volumetric is \"mixed\"") && message.contains("implicit_euler"), "{message}");
    let message = try_build_error(&mixed(&soft("implicit_euler", 1e-3, "[solver]\nkind = \"pcg\"\n")));
    assert!(message.contains("solver.kind") && message.contains("give \"cholesky\""), "{message}");
    let single = soft("implicit_euler", 1e-3, "").replace("dt =", "precision = \"f32\"\ndt =");
    let message = try_build_error(&mixed(&single));
    assert!(message.contains("time.precision"), "{message}");
    for form in ["standard", "averaged"] {
        let text = of_law("neo_hookean", &soft("static", 1.0, "")).replace("poisson = 0.3", "poisson = 0.5");
        let message = try_build_error(&with_volume(form, &text));
        assert!(message.contains("or is that with material.volumetric = \"mixed\""), "{message}");
    }
}
