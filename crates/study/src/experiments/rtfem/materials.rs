//! Several materials: a block beside its closed form, and the torus beside a finer mesh.

use std::path::Path;

use fem_chart::{Axis, Chart, Series};
use fem_engine::simulator::build;
use fem_mesh::{Pattern, box_mesh};
use fem_model::Axis::{X, Y, Z};
use fem_model::Selector;

use super::setting::{LAWS, POISSON, Setting, TRACTION, YOUNG, equilibrium, squash};
use super::torus::Torus;
use crate::scenes::{displaced, displacements, step};
use crate::study::{Mark, Part, Result, Table, pairs};

/// Young's moduli, Pa, and Poisson's ratios.
const YOUNGS: [f64; 4] = [3500.0, 7000.0, 7e4, 7e6];
const POISSONS: [f64; 5] = [0.0, 0.2, 0.4, 0.45, 0.49];

/// Largest error of the stretches of the block.
const EXACT: f64 = 1e-8;

/// Blocks and tori of several materials.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let (blocks, mut marks) = blocks()?;
    let torus = Torus::of_size(if quick { 182 } else { 1119 })?;
    let (stiffnesses, of_young) = by_young(&torus)?;
    let (ratios, of_poisson) = by_poisson(&torus, if quick { 2.0 } else { 4.0 })?;
    marks.extend(of_young.into_iter().chain(of_poisson));
    let text = format!(
        "The thesis announces several materials and shows one. A block with free sides under {TRACTION} Pa has stretches in closed form for each law. The torus, \
         {} tetrahedra: at {YOUNG} Pa and more the strains are small enough for the linear law; at 3500 Pa they are not. For ν near ½ linear tetrahedra lock, as the \
         error against a finer mesh shows, which locks less.",
        torus.mesh.elements.len()
    );
    let of_numbers = |name: &str, head: &str, rows: &[[f64; 5]], digits: &dyn Fn(f64) -> String| {
        Table::new(name, head, rows.iter().map(|row| row.iter().map(|&x| digits(x)).collect()).collect())
    };
    let of_blocks = "law | >E (Pa) | >ν | >load (Pa) | >stretch along, closed form | >here | >stretch across, closed form | >here | >error";
    let by_young = ">E (Pa) | >approach, linear (m) | >corotated (m) | >neo-Hookean (m) | >E × linear approach (N/m)";
    let by_poisson = ">ν | >approach, linear (m) | >corotated over linear | >neo-Hookean over linear | >error of the flexibility, linear (%)";
    let tables = [
        Table::new("rtfem-block", of_blocks, blocks),
        of_numbers("rtfem-young", by_young, &stiffnesses, &|x| format!("{x:.6e}")),
        of_numbers("rtfem-poisson", by_poisson, &ratios, &|x| format!("{x:.5}")),
    ];
    let caption = "Approach of the loaded sides over that of the linear law.";
    Ok(Part::new(text).marks(marks).tables(tables).chart("rtfem-materials", &chart(&stiffnesses), caption))
}

fn blocks() -> Result<(Vec<Vec<String>>, Vec<Mark>)> {
    let (mut rows, mut marks) = (Vec::new(), Vec::new());
    for law in LAWS {
        let mut largest = 0.0_f64;
        let moduli = YOUNGS.map(|young| (young, POISSON)).into_iter().chain(POISSONS.map(|poisson| (YOUNG, poisson)));
        for ((young, poisson), load) in pairs(moduli, [-TRACTION, TRACTION]) {
            let setting = Setting { young, poisson, ..Setting::of_law(law) };
            let (truth, ours) = (closed_form(&setting, load), computed(&setting, load)?);
            let error = (truth[0] - ours[0]).abs().max((truth[1] - ours[1]).abs());
            largest = largest.max(error);
            let numbers = [truth[0], ours[0], truth[1], ours[1]].map(|x| format!("{x:.10}"));
            let first = [law.to_owned(), format!("{young:e}"), poisson.to_string(), load.to_string()];
            rows.push(first.into_iter().chain(numbers).chain([format!("{error:.1e}")]).collect());
        }
        let statement = format!(
            "{law}: the block's stretches are those of the closed form within {EXACT:e}, whatever E, ν and the sign of the load"
        );
        marks.push(Mark::at_most(statement, largest, EXACT));
    }
    Ok((rows, marks))
}

/// Stretches of a cube of side 1 m with free sides under a dead load (Pa, positive in tension): along the load and across it.
fn computed(setting: &Setting, load: f64) -> Result<[f64; 2]> {
    let mesh = box_mesh([1.0, 1.0, 1.0], 2, Pattern::Kuhn)?;
    let corner = mesh.vertices.iter().position(|x| x.iter().all(|&x| x == 1.0)).ok_or("the cube lacks its corner")?;
    let setting = setting.in_equilibrium();
    let mut body = setting.body(mesh)?.traction(&Selector::most(X), [load, 0.0, 0.0])?;
    for axis in [X, Y, Z] {
        body = displaced(body, &Selector::least(axis), axis, 0.0)?;
    }
    let mut simulation = build(body, &setting.method())?;
    step(&mut *simulation)?;
    let u = displacements(&*simulation)[corner];
    Ok([1.0 + u.x, 1.0 + u.y])
}

/// The same in closed form. Linear and corotated: ε = P/E and −ν P/E, since the stretches of the corotated law are the eigenvalues of S in
/// P = 2μ (S − 1) + λ tr(S − 1). Neo-Hookean: the stretches at which the stress of ψ = C (J^(−2/3) I₁ − 3) + D (J − 1)² is P along the
/// load and zero across it, by Newton's method on two equations.
fn closed_form(setting: &Setting, load: f64) -> [f64; 2] {
    let Setting { law, young, poisson, .. } = *setting;
    let strain = load / young;
    let small = [1.0 + strain, 1.0 - poisson * strain];
    if law != "neo_hookean" {
        return small;
    }
    let mu = young / (2.0 * (1.0 + poisson));
    let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let (c, d) = (0.5 * mu, 0.5 * lambda + mu / 3.0);
    let residual = |[a, b]: [f64; 2]| {
        let (J, squares) = (a * b * b, a * a + 2.0 * b * b);
        let stress =
            |s: f64| c * J.powf(-2.0 / 3.0) * (2.0 * s - 2.0 / 3.0 * squares / s) + 2.0 * d * (J - 1.0) * J / s;
        [stress(a) - load, stress(b)]
    };
    let mut stretches = small;
    for _ in 0..50 {
        let r = residual(stretches);
        let h = 1e-7;
        let [p, q] = [0, 1].map(|k| {
            let moved =
                |sign: f64| residual(std::array::from_fn(|i| stretches[i] + if i == k { sign * h } else { 0.0 }));
            let (plus, minus) = (moved(1.0), moved(-1.0));
            [0, 1].map(|i| (plus[i] - minus[i]) / (2.0 * h))
        });
        let determinant = p[0] * q[1] - p[1] * q[0];
        stretches[0] -= (r[0] * q[1] - r[1] * q[0]) / determinant;
        stretches[1] -= (p[0] * r[1] - p[1] * r[0]) / determinant;
    }
    stretches
}

/// Rows, one per modulus: E, the approach of the loaded sides by each law (m), E times that of the linear law.
fn by_young(torus: &Torus) -> Result<(Vec<[f64; 5]>, Vec<Mark>)> {
    let mut rows = Vec::new();
    for young in YOUNGS {
        let [a, b, c] = approaches(torus, young, POISSON)?;
        rows.push([young, a, b, c, young * a]);
    }
    let spread = rows.iter().map(|row| (row[4] / rows[0][4] - 1.0).abs()).fold(0.0, f64::max);
    let [.., stiff] = rows[..] else { return Ok((rows, Vec::new())) };
    let apart = [stiff[2], stiff[3]].map(|x| (x / stiff[1] - 1.0).abs()).into_iter().fold(0.0, f64::max);
    let soft = [rows[0][2], rows[0][3]].map(|x| (x / rows[0][1] - 1.0).abs()).into_iter().fold(f64::INFINITY, f64::min);
    let marks = vec![
        Mark::at_most("linear law: the deflection is proportional to 1/E within 1e-9", spread, 1e-9),
        Mark::at_most("at E = 7e6 Pa the three laws agree within 1e-3", apart, 1e-3),
        Mark::new(
            "at E = 3500 Pa the linear law is wrong by more than a hundred times its error at 7e6 Pa",
            format!("{:.1} %", 100.0 * soft),
            soft > 100.0 * apart,
        ),
    ];
    Ok((rows, marks))
}

/// Rows, one per ratio: ν, the linear approach (m), those of the other laws over it, and the error of the linear flexibility against a mesh
/// whose edges are `finer` times shorter, %.
fn by_poisson(torus: &Torus, finer: f64) -> Result<(Vec<[f64; 5]>, Vec<Mark>)> {
    let reference = Torus::of_edge(torus.edge / finer)?;
    let mut rows = Vec::new();
    for poisson in POISSONS {
        let [a, b, c] = approaches(torus, YOUNG, poisson)?;
        let linear = Setting { poisson, ..Setting::default() };
        let (approach, load) = squash(&reference.mesh, &equilibrium(&linear, &reference.mesh)?);
        let own_load = squash(&torus.mesh, &equilibrium(&linear, &torus.mesh)?).1;
        rows.push([poisson, a, b / a, c / a, 100.0 * (a / own_load / (approach / load) - 1.0)]);
    }
    let (least, most) = (rows[0][4], rows[rows.len() - 1][4]);
    let statement = "linear tetrahedra lock: the flexibility lacks more at ν = 0.49 than at 0";
    let mark = Mark::new(statement, format!("{least:+.1} % → {most:+.1} %"), most < least && least < 0.0);
    // A mesh that is only twice as fine has another surface, whose effect is larger than that of locking.
    Ok((rows, vec![mark.unless(finer < 4.0)]))
}

fn approaches(torus: &Torus, young: f64, poisson: f64) -> Result<[f64; 3]> {
    let mut found = [0.0; 3];
    for (found, law) in found.iter_mut().zip(LAWS) {
        let setting = Setting { young, poisson, ..Setting::of_law(law) };
        *found = squash(&torus.mesh, &equilibrium(&setting, &torus.mesh)?).0;
    }
    Ok(found)
}

fn chart(rows: &[[f64; 5]]) -> Chart {
    let mut chart =
        Chart::new("laws beside the linear one", Axis::log("load over E (%)"), Axis::linear("approach over linear"));
    chart.series = (1..=3)
        .map(|law| {
            let dots = rows.iter().map(|row| (100.0 * TRACTION / row[0], row[law] / row[1]));
            Series::joined(LAWS[law - 1], (law, law), dots)
        })
        .collect();
    chart
}
