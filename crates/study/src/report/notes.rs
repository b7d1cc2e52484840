//! What words mean, how it was measured, and what anyone can compute again.

use super::Report;
use crate::report::text::number;
use fem_chart::escape;
use fem_chart::page::table;

/// The top of the page.
pub fn head(report: &Report) -> String {
    let quick =
        if report.is_quick { " This is the short version: small meshes, few steps; times mean little." } else { "" };
    let busy = if report.machine.is_busy() {
        " Other work kept this machine busy: times by the clock are longer than they need to be, and processor times tell more."
    } else {
        ""
    };
    format!("<h1>Error against run time</h1>\n<p class=\"soft\">{}.{quick}{busy}</p>\n", escape(&report.machine.line()))
}

/// The end of the page.
pub fn method(report: &Report) -> String {
    let studies = std::iter::once(&report.orders).chain(&report.scenes);
    let rows: Vec<_> = studies
        .flat_map(|study| &study.references)
        .map(|(file, (u, v), evaluations)| {
            vec![file.clone(), number(Some(*u)), number(Some(*v)), evaluations.to_string()]
        })
        .collect();
    format!(
        "{METHOD}{}{DEFINITIONS}",
        table(&["reference in time", ">self-check", ">of velocities", ">force evaluations"], &rows)
    )
}

const METHOD: &str = "<h2 id=\"how\">How it was done</h2>\n\
<p><b>References in time</b> come from no method that is studied: extrapolation of the modified midpoint rule (Gragg, Bulirsch, Stoer; Hairer, \
Nørsett, Wanner 1993, II.9) of order 16 on the same mesh, with the consistent mass factorised exactly, computed twice, the second time with half \
the step; their distance, relative to the displacements, must be at most 10⁻¹⁰ (of velocities, which carry the round-off of the fastest vibrations, 10⁻⁸).</p>\n\
<p><b>Runs</b> are a star, not a product of all choices: every method goes down a ladder of halved time steps; explicit ones start above their \
limit of stability, so that the failure is seen. Tolerance, solver, projection, precision and mesh are varied one at a time around implicit \
Euler at a quarter of the scene's step. <b>course</b> is the pipeline of the 22 functions, the rest is the engine.</p>\n\
<p><b>Times</b> are wall clock, of the steps alone; set-up is told apart in runs.csv. The first run of each is looked at and warms up; then all runs \
are timed in turn, round after round, three to nine times each (at least 30 steps; a run of more than 2 s warms up by its own first steps). \
Told are the median and the quartiles, and the processor time of all threads, which other work on the machine lengthens less.</p>\n";

const DEFINITIONS: &str = "<h3>What the columns of runs.csv mean</h3>\n<ul>\n\
<li><code>err_time_L2</code> √(Σ wᵢ |xᵢ − x*ᵢ|² / Σ wᵢ) / length at the end, x* the reference on the same mesh; weights and length are in the file \
<code>reference_state</code>; <code>err_Linf</code> is the largest |xᵢ − x*ᵢ| / length.</li>\n\
<li><code>err_space_L2</code>, <code>err_space_H1</code> belong to the mesh: by nested meshes and Richardson (displacement as a part of the length; gradient \
relative), or against the manufactured solution (both relative).</li>\n\
<li><code>err_analytic</code> distance from the closed form: a cantilever's tip from Timoshenko's, relative; a stretched bar's nodes as a part of \
its length.</li>\n\
<li><code>dE</code> (E − E*) / max(|T*|, |V*|); <code>dp</code> |p − p*| / √(2 m T*); <code>dL</code> |L − L*| / (√(2 m T*) · length), with lumped masses; all at the \
end. For a free body under no load p* and L* are what is conserved.</li>\n\
<li><code>lin_solves</code> systems solved for steps and Newton directions; <code>solver_it</code> iterations of \
iterative solvers in them; <code>force_evals</code> passes over all elements; these counts do not depend on \
the machine.</li>\n\
<li><code>peak_MB</code> largest memory of the whole process while the run was looked at. <code>tol</code> is relative to the body's length and the step's \
last update.</li>\n</ul>\n";

/// For those who find the folder without the page.
pub const README: &str = "\
Error against run time. Open report.html; it needs no network.

runs.csv, runs.json   one row for each run: what was run, errors, times, counts of work, files of its state and of its reference
orders.csv            observed orders of convergence with the half width of their 95 % confidence interval
locking.csv           tip displacement of a cantilever over Timoshenko's, by Poisson's ratio and cells
states/               the state at the end of each run, and the references
*.svg                 the pictures of the page

Any error in time can be computed again. Let s be the JSON of the column `state` and r that of `reference_state`:
  err_time_L2 = sqrt(sum_i w_i |s.q_i - r.q_i|^2 / sum_i w_i) / r.length     w = r.weights (m^3), q_i = three numbers of node i (m)
  err_Linf    = max_i |s.q_i - r.q_i| / r.length
  T = s.kinetic, V = s.potential (J); E = T + V; * marks those of r
  dE          = (E - E*) / max(|T*|, |V*|)
  m_i         = r.density w_i;  m = sum_i m_i;  p = sum_i m_i qdot_i;  c = sum_i m_i X_i / m, X = r.rest
  dp          = |p - p*| / sqrt(2 m T*)
  dL          = |L - L*| / (sqrt(2 m T*) r.length),  L = sum_i m_i (q_i - c) x qdot_i
Errors in space of `manufactured-*`: u_i = a_i sin(pi x) sin(pi y) sin(pi z) on the unit cube, a = (0.06, -0.05, 0.04) m, against the linear
interpolation of s.q - r.rest over r.elements, integrated exactly enough, over the norm of u (L2) or of its gradient (H1).
Errors in space of boxes: three meshes of which each halves the cells of the one before. At the nodes of the coarsest, with its weights w,
  p = log2(|u1 - u2| / |u2 - u3|),  u* = u3 + (u3 - u2) / (2^p - 1),  err_space_L2 = |u - u*| / length    (p held between 0.5 and 3)
  err_space_H1 of mesh l = |grad(u_(l+1) - u_l)| / sqrt(1 - 4^-p') / |grad u3|,  p' = log2 of the ratio of the two differences
where u1 and u2 are those of the references and u3 that of the finest mesh.
Times are seconds or milliseconds as the column says; total_s is the median, total_s_q1 and total_s_q3 are the quartiles;
processor_s is the processor time of all threads.
";
