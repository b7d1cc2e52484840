//! Flat bodies: triangles in plane strain.

use fem_mesh::{Mesh, Pattern, rectangle_mesh};
use fem_model::Law;

use crate::{DYNAMIC, block, build, distance, of_law, run, side, soft};

/// A strip of 2 × 1 m and 0.3 m thick in place of the box of a scene.
pub fn flat(text: &str) -> String {
    text.replace("box = { size = [2, 1, 1], cells_per_unit = 1 }", "rectangle = { size = [2, 1], cells_per_unit = 3 }")
        .replace("[material]\n", "[material]\nthickness = 0.3\n")
}

/// Prescribes x and y of all nodes on the edges by the gradient G; inner nodes are free.
pub fn affine<const N: usize>(mesh: &Mesh<3, N>, G: [[f64; 2]; 2]) -> String {
    let (mut tables, size) = (String::new(), [2.0, 1.0]);
    for (node, x) in mesh.vertices.iter().enumerate() {
        if (0..2).any(|i| x[i] == 0.0 || x[i] == size[i]) {
            let u = [0, 1].map(|i| G[i][0] * x.x + G[i][1] * x.y);
            tables += &format!(
                "[[prescribed]]\nnodes = [{node}]\ndisplacement = [{}, {}, 0]\ncomponents = [\"x\", \"y\"]\n",
                u[0], u[1]
            );
        }
    }
    tables
}

#[test]
fn an_affine_state_is_an_equilibrium_with_the_energy_of_a_solid_slab_for_every_law() {
    let G = [[0.08, 0.05], [-0.02, -0.03]];
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        let mesh = rectangle_mesh([2.0, 1.0], 3, Pattern::Alternating).unwrap();
        let mut simulation = build(&flat(&block(model, &affine(&mesh, G))));
        run(&mut *simulation, 1);
        let expected = |node: usize| {
            let x = mesh.vertices[node];
            [x.x + G[0][0] * x.x + G[0][1] * x.y, x.y + G[1][0] * x.x + G[1][1] * x.y, 0.0]
        };
        let q = simulation.positions();
        for node in 0..mesh.vertices.len() {
            for (i, expected) in expected(node).into_iter().enumerate() {
                assert!((q[3 * node + i] - expected).abs() < 1e-12, "{model}, node {node}");
            }
        }
        let mut slab = build(&block(model, &solid_affine(G)));
        run(&mut *slab, 1);
        let (flat, solid) = (simulation.energies().potential, 0.3 * slab.energies().potential);
        assert!((flat - solid).abs() < 1e-12 * solid, "{model}: {flat} {solid}");
        let (flat, solid) = (simulation.stresses()[5], slab.stresses()[2]);
        assert!((flat - solid).amax() < 1e-9 * solid.amax(), "{model}: {flat} {solid}");
    }
}

/// The same for all twelve nodes of the box, none of which moves along z.
fn solid_affine(G: [[f64; 2]; 2]) -> String {
    let mut tables = String::new();
    for node in 0..12 {
        let (x, y) = (f64::from(node % 3), f64::from(node / 3 % 2));
        let u = [0, 1].map(|i| G[i][0] * x + G[i][1] * y);
        tables += &format!("[[prescribed]]\nnodes = [{node}]\ndisplacement = [{}, {}, 0]\n", u[0], u[1]);
    }
    tables
}

#[test]
fn a_strip_stretched_in_plane_strain_contracts_and_resists_as_hooke_says() {
    let tables = side("x", "min", 0.0) + &side("x", "max", 0.002) + &side("y", "min", 0.0);
    let mut simulation = build(&flat(&block("linear", &tables)));
    run(&mut *simulation, 1);
    let (E, nu, strain): (f64, f64, f64) = (1e5, 0.3, 1e-3);
    let q = simulation.positions();
    let last = q.len() - 3;
    assert!((q[last + 1] - (1.0 - nu / (1.0 - nu) * strain)).abs() < 1e-13);
    let force = E / (1.0 - nu * nu) * strain * 0.3;
    let reactions = simulation.reactions();
    assert!((reactions[1].force[0] - force).abs() < 1e-10 * force, "{reactions:?}");
    // σ_zz = ν (σ_xx + σ_yy)
    let stress = simulation.stresses()[0];
    assert!((stress[(2, 2)] - nu * stress[(0, 0)]).abs() < 1e-10 * stress[(0, 0)]);
}

#[test]
fn a_strip_in_plane_stress_pulls_contracts_and_is_stressed_as_a_bar_with_free_sides() {
    for (model, stretch) in [("linear", 0.002), ("corotated", 0.4)] {
        let tables = side("x", "min", 0.0) + &side("x", "max", stretch) + &side("y", "min", 0.0);
        let thin = flat(&block(model, &tables)).replace("[material]\n", "[material]\nplane = \"stress\"\n");
        let (mut strip, mut bar) = (build(&thin), build(&block(model, &(tables + &side("z", "min", 0.0)))));
        run(&mut *strip, 1);
        run(&mut *bar, 1);
        let force = strip.reactions()[1].force[0];
        let expected = 0.3 * bar.reactions()[1].force[0];
        assert!((force - expected).abs() < 1e-9 * expected, "{model}: {force} {expected}");
        let (E, strain) = (1e5, 0.5 * stretch);
        assert!((force - E * strain * 0.3).abs() < 1e-9 * force, "{model}: {force}");
        let (q, of_bar) = (strip.positions(), bar.positions());
        let [width, expected] = [&q, &of_bar].map(|q| q[q.len() - 2]);
        assert!((width - expected).abs() < 1e-10, "{model}: {width} {expected}");
        let (stress, expected) = (strip.stresses()[0], bar.stresses()[0]);
        assert!((stress - expected).amax() < 1e-8 * expected.amax(), "{model}: {stress} {expected}");
        assert_eq!(stress[(2, 2)], 0.0, "{model}");
    }
}

#[test]
fn reactions_of_a_flat_body_carry_its_weight_in_the_plane_for_every_law() {
    let rest = "[gravity]\nacceleration = [1, -3, 0]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    for model in Law::FACTS.iter().map(|facts| &facts.name) {
        let mut simulation = build(&flat(&block(model, rest)));
        run(&mut *simulation, 1);
        let force = simulation.reactions()[0].force;
        for (found, weight) in force.iter().zip([600.0, -1800.0, 0.0]) {
            assert!((found + weight).abs() < 1e-9 * 1800.0, "{model}: {force:?}");
        }
    }
}

#[test]
fn a_free_flat_body_falls_in_its_plane_with_every_method() {
    for method in DYNAMIC {
        let (dt, steps) = (1e-3, 20);
        let text = flat(&soft(method, dt, "[gravity]\nacceleration = [0.5, -2, 0]\n"));
        let mut simulation = build(&of_law("neo_hookean", &text));
        run(&mut *simulation, steps);
        let v = simulation.velocities();
        for node in 0..v.len() / 3 {
            let time = dt * steps as f64;
            assert!((v[3 * node] - 0.5 * time).abs() < 1e-10, "{method}: {}", v[3 * node]);
            assert!((v[3 * node + 1] + 2.0 * time).abs() < 1e-10, "{method}: {}", v[3 * node + 1]);
            assert_eq!(v[3 * node + 2], 0.0, "{method}");
            assert_eq!(simulation.positions()[3 * node + 2], 0.0, "{method}");
        }
    }
}

#[test]
fn a_flat_body_bends_alike_with_every_solver_and_in_single_precision() {
    let rest = "[gravity]\nacceleration = [0, -3, 0]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    let end = |extra: &str, precision: &str| {
        let text = flat(&soft("implicit_euler", 0.02, &format!("{rest}{extra}")));
        let mut simulation = build(&text.replace("dt = 2e-2", &format!("dt = 2e-2\n{precision}")));
        run(&mut *simulation, 10);
        simulation.positions()
    };
    let expected = end("", "");
    for solver in ["kind = \"cholesky\"", "kind = \"lu\"", "kind = \"cg\"", "kind = \"pcg\""] {
        let error = distance(&end(&format!("[solver]\n{solver}\n"), ""), &expected);
        assert!(error < 1e-8, "{solver}: {error:e} m");
    }
    let error = distance(&end("", "precision = \"f32\""), &expected);
    assert!(error < 1e-5 * 2.0, "{error:e} m");
}

#[test]
fn a_traction_on_the_end_of_a_strip_is_balanced_and_stretches_it_as_hooke_says() {
    let tables = side("x", "min", 0.0)
        + &side("y", "min", 0.0)
        + "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [200, 0, 0]\n";
    let mut simulation = build(&flat(&block("linear", &tables)));
    run(&mut *simulation, 1);
    let reaction = simulation.reactions()[0].force[0];
    assert!((reaction + 200.0 * 0.3).abs() < 1e-10 * 60.0, "{reaction}");
    let q = simulation.positions();
    let stretch = q[q.len() - 3] / 2.0 - 1.0;
    assert!((stretch - 200.0 * (1.0 - 0.3 * 0.3) / 1e5).abs() < 1e-13, "{stretch:e}");
}

#[test]
fn a_flat_body_from_a_file_is_that_of_the_rectangle() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = rectangle_mesh([2.0, 1.0], 3, Pattern::Alternating).unwrap();
    let rest = "[gravity]\nacceleration = [0, -3, 0]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    let text = flat(&block("neo_hookean", rest));
    let end = |text: &str| {
        let mut simulation = build(text);
        run(&mut *simulation, 1);
        simulation.positions()
    };
    let expected = end(&text);
    for name in ["strip.msh", "strip.vtu", "strip.vtk", "strip.node", "strip.mesh"] {
        let file = folder.path().join(name);
        fem_mesh::write_surface(&file, &mesh).unwrap();
        let of_file = text.replace("rectangle = { size = [2, 1], cells_per_unit = 3 }", &format!("file = {file:?}"));
        assert_eq!(end(&of_file), expected, "{name}");
    }
}

#[test]
fn keys_without_meaning_for_a_flat_body_or_for_a_solid_one_are_refused() {
    let refused = |text: &str| crate::try_build(text).err().expect("it is refused").to_string();
    let of_flat = |rest: &str| refused(&flat(&block("linear", rest)));
    assert!(of_flat("[gravity]\nacceleration = [0, 0, -9.81]\n").contains("give 0 for its third number"));
    assert!(
        of_flat("[[prescribed]]\nnodes = [1]\ndisplacement = [0, 0, 0.1]\n").contains("prescribed[0].displacement")
    );
    let turned = "[[prescribed]]\nnodes = [1]\nrotation = { axis = \"x\", center = [0, 0, 0], turns = 1 }\n";
    assert!(of_flat(turned).contains("give the axis z"));
    let thick = block("linear", "").replace("[material]\n", "[material]\nthickness = 0.3\n");
    assert!(refused(&thick).contains("material.thickness belongs to flat bodies"));
    let out = flat(&block("linear", "")).replace("thickness = 0.3", "thickness = -1");
    let error = fem_scene::parse(&out, "a.toml".as_ref()).unwrap_err().to_string();
    assert!(error.contains("material.thickness is -1"), "{error}");
}
