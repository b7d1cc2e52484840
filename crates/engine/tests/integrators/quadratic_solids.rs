//! Quadratic tetrahedra.

use fem_mesh::{Mesh, MeshSet, Pattern, box_mesh};
use fem_model::simulation::{Cause, Failure, Simulation};
use fem_model::{BodyMesh, Law};
use fem_output::export;
use fem_scene::{resume, write_state};
use nalgebra::{Matrix3, Vector3};

use crate::quadratic_motion::{masses, momentum};
use crate::{DYNAMIC, block, build, distance, of_law, run, side, soft, symmetry};

/// The box of a scene with quadratic tetrahedra.
fn quadratic(text: &str) -> String {
    text.replace("cells_per_unit = 1 }", "cells_per_unit = 1 }\norder = 2")
}

/// The same with eight times as many.
fn finer(text: &str) -> String {
    text.replace("cells_per_unit = 1 }", "cells_per_unit = 2 }\norder = 2")
}

fn solved(text: &str) -> Box<dyn Simulation> {
    let mut simulation = build(text);
    run(&mut *simulation, 1);
    simulation
}

const WEIGHT: &str = "[gravity]\nacceleration = [1, -3, 0.5]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";

const LUMPED: &str = "[mass]\nlumped = true\n";

/// Prescribes the displacements of all nodes on the boundary of the box of [`finer`]; inner nodes are free.
fn of_boundary(u: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> String {
    let mesh = BodyMesh::solid(box_mesh([2.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap()).of_order(2).unwrap();
    let is_outside = |x: &&Vector3<f64>| (0..3).any(|i| x[i] == 0.0 || x[i] == [2.0, 1.0, 1.0][i]);
    let nodes = mesh.vertices().iter().enumerate().filter(|(_, x)| is_outside(x));
    let table = |(node, x): (usize, &Vector3<f64>)| {
        let u = u(x);
        format!("[[prescribed]]\nnodes = [{node}]\ndisplacement = [{:e}, {:e}, {:e}]\n", u.x, u.y, u.z)
    };
    nodes.map(table).collect()
}

/// The largest distance of a node from where a displacement moves it, m.
fn error(simulation: &dyn Simulation, u: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> f64 {
    let (q, shape) = (simulation.positions(), simulation.shape());
    let of = |(node, x): (usize, &Vector3<f64>)| (q.fixed_rows::<3>(3 * node) - x - u(x)).amax();
    shape.mesh.vertices().iter().enumerate().map(of).fold(0.0, f64::max)
}

#[test]
fn an_affine_state_is_an_equilibrium_of_uniform_stress_for_every_law() {
    let G = Matrix3::new(0.08, 0.05, -0.01, -0.02, -0.03, 0.04, 0.0, 0.02, 0.06);
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        let simulation = solved(&finer(&block(model, &of_boundary(|x| G * x))));
        assert!(error(&*simulation, |x| G * x) < 1e-12, "{model}");
        let stresses = simulation.stresses();
        assert_eq!(stresses.len(), 16 * 6);
        let size = stresses[0].amax();
        assert!(stresses.iter().all(|stress| (stress - stresses[0]).amax() < 1e-9 * size), "{model}");
    }
}

#[test]
fn pure_bending_in_space_is_exact() {
    // About z, with the lateral contraction of both other directions: Timoshenko and Goodier, Theory of Elasticity, section 102.
    let curvature = 0.01;
    let bent = |ratio: f64| {
        move |x: &Vector3<f64>| {
            curvature
                * Vector3::new(x.x * x.y, -0.5 * (x.x * x.x + ratio * (x.y * x.y - x.z * x.z)), -ratio * x.y * x.z)
        }
    };
    let simulation = solved(&finer(&block("linear", &of_boundary(bent(0.3)))));
    assert!(error(&*simulation, bent(0.3)) < 1e-13);
    for (places, stress) in
        (0..96).flat_map(|element| simulation.shape().mesh.points(element)).zip(simulation.stresses_at_points())
    {
        let expected = Matrix3::from_fn(|i, j| if i + j == 0 { 1e5 * curvature * places.y } else { 0.0 });
        assert!((stress - expected).amax() < 1e-9, "{places} {stress}");
    }
    // Another lateral contraction is no equilibrium.
    let simulation = solved(&finer(&block("linear", &of_boundary(bent(0.0)))));
    assert!(error(&*simulation, bent(0.0)) > 1e-5);
}

#[test]
fn reactions_carry_the_weight_with_either_mass() {
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        for mass in ["", LUMPED] {
            let force = solved(&quadratic(&block(model, &format!("{WEIGHT}{mass}")))).reactions()[0].force;
            for (found, weight) in force.iter().zip([2000.0, -6000.0, 1000.0]) {
                assert!((found + weight).abs() < 1e-9 * 6000.0, "{model}: {force:?}");
            }
        }
    }
}

#[test]
fn tractions_and_pressures_on_a_face_leave_a_uniform_stress() {
    let end = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\n";
    for (load, of) in [("force_per_area = [200, 0, 0]\n", 1.0), ("pressure = -200\n", 1.0), ("pressure = 200\n", -1.0)]
    {
        let simulation = solved(&quadratic(&block("linear", &format!("{}{end}{load}", symmetry()))));
        // A pressure acts on the deformed face.
        let accuracy = if load.starts_with("force") { 1e-9 } else { 2e-3 * 200.0 };
        for stress in simulation.stresses() {
            assert!((stress[(0, 0)] - of * 200.0).abs() < accuracy && stress[(1, 1)].abs() < accuracy, "{stress}");
        }
        assert!((simulation.reactions()[0].force[0] + of * 200.0).abs() < accuracy, "{load}");
    }
}

#[test]
fn a_pressure_all_around_is_a_compression_with_an_energy() {
    // Of the neo-Hookean law, so that the area changes by much.
    let tables = "[[traction]]\non = \"all\"\npressure = 4e3\n".to_owned() + &symmetry();
    let [linear, quadratic] = [tables.clone(), quadratic(&tables)].map(|tables| {
        let simulation = solved(&block("neo_hookean", &tables));
        (simulation.stresses()[3], simulation.min_J().0, simulation.energies())
    });
    assert!(linear.1 < 0.98);
    for (stress, J, _) in [&linear, &quadratic] {
        assert!((stress + Matrix3::identity() * 4e3).amax() < 1e-6 * 4e3, "{stress}");
        assert!((J - linear.1).abs() < 1e-9);
    }
    assert!((linear.2.total() - quadratic.2.total()).abs() < 1e-9 * linear.2.total().abs());
}

/// Deflection of the tip of a beam of 6 × 1 × 1 m with `cells` cells per metre under an end load, over Timoshenko's.
fn tip(cells: usize, order: u32, poisson: f64) -> f64 {
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [6, 1, 1], cells_per_unit = {cells}, pattern = \"kuhn\" }}\norder = {order}\n\
         [material]\nmodel = \"linear\"\nyoung = 1e6\npoisson = {poisson}\ndensity = 1000\n\
         [time]\nintegrator = \"static\"\n[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n\
         [[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\nforce_per_area = [0, -10, 0]\n"
    );
    let simulation = solved(&text);
    let expected = fem_engine::cantilever::Cantilever { length: 6.0, height: 1.0, width: 1.0, young: 1e6, poisson };
    fem_engine::cantilever::tip_displacement(&*simulation).y / expected.under_end_load(-10.0)
}

#[test]
fn a_cantilever_of_one_layer_bends_as_timoshenko_says_where_linear_tetrahedra_are_far_too_stiff() {
    let (linear, quadratic, fine) = (tip(2, 1, 0.3), tip(1, 2, 0.3), tip(2, 2, 0.3));
    assert!(linear < 0.65, "{linear}");
    assert!((quadratic - 1.0).abs() < 0.05 && (fine - 1.0).abs() < 0.025, "{quadratic} {fine}");
    let (linear, quadratic) = (tip(2, 1, 0.499), tip(2, 2, 0.499));
    assert!(linear < 0.1 && quadratic > 0.85 && quadratic < 1.0, "{linear} {quadratic}");
}

#[test]
fn every_solver_and_single_precision_find_the_same_equilibrium() {
    let end = |extra: &str, precision: &str| {
        let text = quadratic(&soft("implicit_euler", 0.02, &format!("{WEIGHT}{extra}")));
        let mut simulation = build(&text.replace("dt = 2e-2", &format!("dt = 2e-2\n{precision}")));
        run(&mut *simulation, 10);
        simulation.positions()
    };
    let expected = end("", "");
    let preconditioned = |name: &str| format!("kind = \"pcg\"\npreconditioner = \"{name}\"");
    let mut solvers = vec!["kind = \"cholesky\"".to_owned(), "kind = \"lu\"".to_owned(), "kind = \"cg\"".to_owned()];
    solvers.extend(["block_jacobi", "ssor", "multigrid"].map(preconditioned));
    for solver in solvers {
        let error = distance(&end(&format!("[solver]\n{solver}\n"), ""), &expected);
        assert!(error < 1e-8, "{solver}: {error:e} m");
    }
    let error = distance(&end("", "precision = \"f32\""), &expected);
    assert!(error < 1e-5 * 2.0, "{error:e} m");
}

#[test]
fn parts_of_two_equal_materials_are_one_body() {
    let region = "[[materials]]\nbox = { min = [1, 0, 0], max = [2, 1, 1] }\nmodel = \"neo_hookean\"\nyoung = 1e5\npoisson = 0.3\ndensity = 1000\n";
    let [whole, parts] = ["", region].map(|region| {
        let simulation = solved(&quadratic(&block("neo_hookean", &format!("{WEIGHT}{region}"))));
        (simulation.positions(), simulation.stresses(), simulation.min_J())
    });
    assert!(distance(&whole.0, &parts.0) < 1e-12);
    assert!(whole.1.iter().zip(&parts.1).all(|(a, b)| (a - b).amax() < 1e-6));
    assert!((whole.2.0 - parts.2.0).abs() < 1e-12 && whole.2.1 == parts.2.1 && whole.2.1 < 10);
}

#[test]
fn a_free_body_falls_without_deformation_with_every_method_and_either_mass() {
    for method in DYNAMIC {
        for mass in ["", LUMPED] {
            let (dt, steps) = (5e-4, 20);
            let text = quadratic(&soft(method, dt, &format!("[gravity]\nacceleration = [0.5, -2, 1]\n{mass}")));
            let mut simulation = build(&text);
            run(&mut *simulation, steps);
            let (v, time) = (simulation.velocities(), dt * steps as f64);
            for v in v.as_slice().chunks(3) {
                for (v, a) in v.iter().zip([0.5, -2.0, 1.0]) {
                    assert!((v - a * time).abs() < 1e-10, "{method}: {v:?}");
                }
            }
        }
    }
}

/// Half of a free box that moves off.
const THROWN: &str = "[[initial_velocity]]\nbox = { min = [1, 0, 0], max = [2, 1, 1] }\nvelocity = [1, 2, 0]\n";

#[test]
fn every_method_keeps_the_momentum_of_a_free_body() {
    for method in DYNAMIC {
        for rest in ["", LUMPED, "[damping]\nbeta = 1e-3\n"] {
            let mut simulation = build(&quadratic(&soft(method, 2e-4, &format!("{THROWN}{rest}"))));
            let masses = masses(&*simulation, rest == LUMPED);
            assert!((masses.iter().sum::<f64>() - 2000.0).abs() < 1e-9);
            let (before, scale) = momentum(&*simulation, &masses);
            run(&mut *simulation, 200);
            let change = (momentum(&*simulation, &masses).0 - before).amax() / scale;
            assert!(change < 1e-12, "{method} {rest:?}: {change:e}");
        }
    }
}

#[test]
fn verlet_keeps_the_energy_of_a_vibrating_body_with_either_mass() {
    for mass in ["", LUMPED] {
        let mut simulation = build(&quadratic(&soft("verlet", 2e-4, &format!("{THROWN}{mass}"))));
        let start = simulation.energies().total();
        run(&mut *simulation, 1000);
        let part = simulation.energies().total() / start - 1.0;
        assert!(part.abs() < 2e-3, "{part:e}");
    }
}

#[test]
fn the_critical_time_step_separates_runs_that_last_from_runs_that_end() {
    for mass in ["", LUMPED] {
        let text = |dt: f64| quadratic(&of_law("linear", &soft("verlet", dt, &format!("{THROWN}{mass}"))));
        let critical = build(&text(1e-3)).critical_time_step().unwrap();
        let lasts = |part: f64| {
            let mut simulation = build(&text(part * critical));
            (0..2000).all(|_| simulation.step().is_ok())
        };
        assert!(lasts(0.98) && !lasts(1.03), "{mass:?}: {critical:e} s");
    }
}

#[test]
fn a_bar_vibrates_at_its_frequency_with_either_mass() {
    // Along x alone, in bending-free uniaxial strain: √((K + 4μ/3)/ρ)/(4 L), of 2 m.
    for (mass, accuracy) in [("", 1e-3), (LUMPED, 1.5e-2)] {
        let tables = side("x", "min", 0.0)
            + "[[prescribed]]\non = \"all\"\ncomponents = [\"y\", \"z\"]\ndisplacement = [0, 0, 0]\n\
               [gravity]\nacceleration = [1e-3, 0, 0]\n";
        let mut simulation = build(&finer(&of_law("linear", &soft("verlet", 2e-4, &format!("{tables}{mass}")))));
        let end = simulation.shape().mesh.vertices().iter().position(|x| x.x == 2.0).unwrap();
        // From rest the end swings about its equilibrium: it is back after one period, when its velocity turns positive again.
        let speed = (1e5 / 1.3 / 0.4 * 0.7 * 0.5 * 2.0_f64 / 1000.0).sqrt();
        let period = 8.0 / speed;
        let (mut before, mut crossings) = (0.0, Vec::new());
        while crossings.len() < 4 {
            run(&mut *simulation, 1);
            let v = simulation.velocities()[3 * end];
            if before < 0.0 && v >= 0.0 {
                crossings.push(simulation.time());
            }
            before = v;
        }
        let found = (crossings[3] - crossings[0]) / 3.0;
        assert!((found / period - 1.0).abs() < accuracy, "{mass:?}: {found} {period}");
    }
}

#[test]
fn a_plastic_box_flows_as_one_of_linear_tetrahedra_does_where_the_strain_is_uniform() {
    let stretched = |order: &dyn Fn(&str) -> String| {
        let tables = symmetry() + &side("x", "max", 0.3);
        let flow = "[plasticity]\nmodel = \"j2\"\nyield_stress = 2e3\nhardening = 5e3\n";
        let mut simulation = build(&order(&block("hencky", &(tables + flow))));
        run(&mut *simulation, 1);
        (simulation.plastic_flow().unwrap(), simulation.reactions()[3].force[0])
    };
    let (linear, quadratic) = (stretched(&str::to_owned), stretched(&quadratic));
    assert_eq!(linear.0.strains.len(), quadratic.0.strains.len());
    assert!(linear.0.strains[0] > 0.05);
    for (a, b) in linear.0.strains.iter().zip(&quadratic.0.strains) {
        assert!((a - b).abs() < 1e-10, "{a} {b}");
    }
    assert!((linear.0.dissipated - quadratic.0.dissipated).abs() < 1e-9 * linear.0.dissipated);
    assert!((linear.1 - quadratic.1).abs() < 1e-9 * linear.1, "{} {}", linear.1, quadratic.1);
}

#[test]
fn a_resumed_plastic_run_ends_bit_for_bit_where_the_uninterrupted_one_does() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("state.json");
    let flow = "[plasticity]\nmodel = \"additive\"\nyield_strain = 0.02\ncreep = 5.0\nmaximum = 0.3\n";
    for method in ["verlet", "implicit_euler"] {
        let text = quadratic(&of_law("corotated", &soft(method, 5e-4, &format!("{THROWN}{flow}"))));
        let scene = crate::scene(&text);
        let mut simulation = build(&text);
        run(&mut *simulation, 80);
        write_state(&file, &scene, &*simulation).unwrap();
        run(&mut *simulation, 10);
        let mut resumed = build(&text);
        resume(&file, &scene, &mut *resumed).unwrap();
        run(&mut *resumed, 10);
        assert!(simulation.plastic_flow().unwrap().largest_strain() > 0.0, "{method}");
        assert_eq!(resumed.positions(), simulation.positions(), "{method}");
        assert_eq!(resumed.plastic_flow(), simulation.plastic_flow(), "{method}");
    }
}

#[test]
fn conditions_on_faces_hold_the_nodes_at_the_middles_of_their_edges() {
    let mut mesh = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    let faces = BodyMesh::solid(mesh.clone()).surface().into_iter();
    let faces = faces.filter(|face| face.iter().all(|&node| mesh.vertices[node].x == 0.0)).collect();
    mesh.sets.insert("end".to_owned(), MeshSet { faces, ..MeshSet::default() });
    let by_set = WEIGHT.replace("plane = { axis = \"x\", below = 1e-9 }", "set = \"end\"");
    let [of_set, of_plane] = [&by_set[..], WEIGHT].map(|tables| {
        let scene = crate::scene(&quadratic(&block("linear", tables)));
        let body = fem_scene::body_of(&scene, mesh.clone(), "no data".as_ref()).unwrap();
        assert_eq!(body.dirichlet[0].nodes.len(), 9);
        let mut simulation = fem_engine::simulator::build(body, &scene.method()).unwrap();
        run(&mut *simulation, 1);
        simulation.positions()
    });
    assert_eq!(of_set, of_plane);
}

#[test]
fn methods_in_sweeps_refuse_quadratic_tetrahedra_in_scenes_and_in_programs() {
    for method in ["pbd", "xpbd", "vbd", "projective_dynamics"] {
        let text = of_law("corotated", &soft(method, 1e-3, ""));
        let refused = |error: String| {
            assert!(error.contains("mesh.order makes quadratic elements") && error.contains("write 1"), "{error}");
        };
        let parsed = fem_scene::parse(&quadratic(&text), "a.toml".as_ref());
        refused(parsed.expect_err("it is refused").to_string());
        // A program can give the body its mesh.
        let scene = crate::scene(&text);
        let linear = box_mesh([2.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
        let mesh = BodyMesh::solid(linear).of_order(2).unwrap();
        let body = fem_scene::body_of(&scene, mesh, "no data".as_ref()).unwrap();
        refused(fem_engine::simulator::build(body, &scene.method()).err().expect("it is refused").to_string());
    }
}

#[test]
fn exports_have_quadratic_tetrahedra_in_vtu_and_four_triangles_for_each_face_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let mut simulation = build(&quadratic(&soft("verlet", 1e-3, THROWN)));
    run(&mut *simulation, 3);
    let mesh = simulation.shape().mesh.clone();
    let path = |name: &str| folder.path().join(name);
    for name in ["a.vtu", "a.obj", "a.glb"] {
        export(&path(name), &*simulation, &[]).unwrap();
    }
    let surface = fem_mesh::read_surface(&path("a.obj")).unwrap();
    // 20 faces of cells of two triangles each.
    assert_eq!((surface.vertices.len(), surface.elements.len()), (mesh.vertices().len(), 4 * mesh.faces().len()));
    let text = std::fs::read_to_string(path("a.vtu")).unwrap();
    let (points, cells) = (mesh.vertices().len(), mesh.elements());
    assert!(text.contains(&format!("NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\"")));
}

#[test]
fn one_tetrahedron_by_itself_is_a_body() {
    let x = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    let mesh = BodyMesh::solid(Mesh::new(x.to_vec(), vec![[0, 1, 2, 3]])).of_order(2).unwrap();
    let scene = crate::scene(&soft("implicit_euler", 0.01, "[gravity]\nacceleration = [0, -9.81, 0]\n"));
    let body = fem_scene::body_of(&scene, mesh, "no data".as_ref()).unwrap();
    let mut simulation = fem_engine::simulator::build(body, &scene.method()).unwrap();
    run(&mut *simulation, 20);
    assert!((simulation.velocities()[28] + 0.2 * 9.81).abs() < 1e-9);
}

/// A quadratic tetrahedron whose middle of an edge moves along it while all other nodes rest; `motion` is the key of its table. From a quarter
/// of the length on, 1 m, it inverts the first corner.
fn with_a_moving_middle(motion: &str, scene: impl Fn(&str) -> String) -> Box<dyn Simulation> {
    let x = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    let mesh = BodyMesh::solid(Mesh::new(x.to_vec(), vec![[0, 1, 2, 3]])).of_order(2).unwrap();
    let middle = (0..10).find(|&node| mesh.vertices()[node] == Vector3::new(0.5, 0.0, 0.0)).unwrap();
    let tables = format!(
        "[[prescribed]]\nnodes = {:?}\ndisplacement = [0, 0, 0]\n[[prescribed]]\nnodes = [{middle}]\n{motion}\n",
        (0..10).filter(|&node| node != middle).collect::<Vec<_>>()
    );
    let scene = crate::scene(&scene(&tables));
    let body = fem_scene::body_of(&scene, mesh, "no data".as_ref()).unwrap();
    fem_engine::simulator::build(body, &scene.method()).unwrap()
}

/// The same in equilibrium, moved by so much, m: the simulation, and how its step has ended.
fn with_a_middle_moved(law: &str, moved: f64) -> (Box<dyn Simulation>, Result<(), Failure>) {
    let motion = format!("displacement = [-{moved}, 0, 0]");
    let mut simulation = with_a_moving_middle(&motion, |tables| block(law, tables));
    let ended = simulation.step();
    (simulation, ended)
}

#[test]
fn an_inversion_at_a_corner_ends_the_run_of_a_law_with_a_barrier_though_no_quadrature_point_sees_it() {
    let (simulation, ended) = with_a_middle_moved("neo_hookean", 0.2);
    ended.unwrap();
    assert!(simulation.warnings().is_empty());
    let (_, ended) = with_a_middle_moved("neo_hookean", 0.3);
    let Err(failure) = ended else { panic!("{ended:?}") };
    let Cause::InvertedAtCorner { element: 0, J } = failure.cause else { panic!("{failure}") };
    assert!((J + 0.2).abs() < 1e-12, "{J}");
}

#[test]
fn a_run_that_ends_between_two_checks_of_the_corners_fails_at_its_end() {
    // 0.16 m a step, and corners are looked at in every eighth step of an explicit method, the first among them.
    let of_steps = |steps| {
        let scene = |tables: &str| soft("verlet", 1e-4, tables);
        let mut simulation = with_a_moving_middle("velocity = [-1600, 0, 0]", scene);
        run(&mut *simulation, steps);
        simulation.failure_at_end().map(|failure| failure.cause)
    };
    assert_eq!(of_steps(1), None);
    assert!(matches!(of_steps(2), Some(Cause::InvertedAtCorner { element: 0, J }) if (J + 0.28).abs() < 1e-12));
}

#[test]
fn an_inversion_at_a_corner_is_warned_of_for_a_law_that_allows_it() {
    let (simulation, ended) = with_a_middle_moved("stable_neo_hookean", 0.3);
    ended.unwrap();
    assert_eq!(simulation.inverted_elements(), 0);
    let warnings = simulation.warnings();
    assert!(
        warnings.iter().all(|text| text.contains("1 elements may be inverted between their quadrature points"))
            && warnings.len() == 1,
        "{warnings:?}"
    );
}
