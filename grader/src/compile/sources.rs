//! The source text around a submission's files: the crate's root, the calls, and bodies for what is not there.

use std::path::Path;
use std::{fs, io};

use grader_child::plain_functions;

use super::Plan;

macro_rules! signatures {
    ($($number:literal $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// Name, arguments and result of the functions that take no closure.
        const PLAIN: &[(&str, &[(&str, &str)], &str)] =
            &[$((stringify!($name), &[$((stringify!($argument), stringify!($type))),*], stringify!($result))),*];
    };
}
plain_functions!(signatures);

/// The functions with closures: name, generic parameters, arguments, result, and how they are called with `&dyn Fn`.
const WITH_CLOSURES: [(&str, &str, &str, &str, &str); 4] = [
    (
        "quadrature_single_point",
        "<R: std::ops::Mul<f64, Output = R>>",
        "V: &[Vector3<f64>], element: &[usize; 4], volume: f64, integrand: impl Fn(&Vector3<f64>) -> R",
        "R",
        "pub const NUMBER: fn(&[Vector3<f64>], &[usize; 4], f64, &dyn Fn(&Vector3<f64>) -> f64) -> f64 =\n    \
         |V, element, volume, integrand| crate::quadrature_single_point(V, element, volume, integrand);\n\
         pub const VECTOR: fn(&[Vector3<f64>], &[usize; 4], f64, &dyn Fn(&Vector3<f64>) -> DVector<f64>) -> DVector<f64> =\n    \
         |V, element, volume, integrand| crate::quadrature_single_point(V, element, volume, integrand);\n",
    ),
    (
        "linearly_implicit_euler",
        "",
        "q: &mut DVector<f64>, qdot: &mut DVector<f64>, dt: f64, mass: &CsrMatrix<f64>, \
         force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>, \
         stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>, \
         solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>",
        "()",
        "pub const CALL: fn(&mut DVector<f64>, &mut DVector<f64>, f64, &CsrMatrix<f64>, Force, Stiffness, Solve) =\n    \
         |q, qdot, dt, mass, force, stiffness, solve| crate::linearly_implicit_euler(q, qdot, dt, mass, force, stiffness, solve);\n",
    ),
    (
        "newtons_method",
        "",
        "x0: &mut DVector<f64>, f: impl Fn(&DVector<f64>) -> f64, g: impl Fn(&DVector<f64>) -> DVector<f64>, \
         H: impl Fn(&DVector<f64>) -> CsrMatrix<f64>, \
         solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>, max_steps: usize",
        "f64",
        "pub const CALL: fn(&mut DVector<f64>, Objective, Gradient, Hessian, Solve, usize) -> f64 =\n    \
         |x0, f, g, H, solve, max_steps| crate::newtons_method(x0, f, g, H, solve, max_steps);\n",
    ),
    (
        "implicit_euler",
        "",
        "q: &mut DVector<f64>, qdot: &mut DVector<f64>, dt: f64, mass: &CsrMatrix<f64>, \
         energy: impl Fn(&DVector<f64>) -> f64, force: impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>, \
         stiffness: impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>, \
         solve: impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>",
        "()",
        "pub const CALL: fn(&mut DVector<f64>, &mut DVector<f64>, f64, &CsrMatrix<f64>, Objective, Force, Stiffness, Solve) =\n    \
         |q, qdot, dt, mass, energy, force, stiffness, solve| \
         crate::implicit_euler(q, qdot, dt, mass, energy, force, stiffness, solve);\n",
    ),
];

/// Types that signatures are made of.
const IMPORTS: &str = "use nalgebra::{DVector, Matrix3, Matrix4, Matrix4x3, SMatrix, SVector, Vector3, Vector4};\n\
     use nalgebra_sparse::CsrMatrix;\nuse grader_child::{Force, Gradient, Hessian, Objective, Solve, Stiffness};\n";

/// Names of the 22 functions, in no particular order.
pub fn names() -> impl Iterator<Item = &'static str> {
    PLAIN.iter().map(|(name, ..)| *name).chain(WITH_CLOSURES.iter().map(|(name, ..)| *name))
}

/// The course's signature of a function.
pub fn signature(name: &str) -> String {
    let with_closures = WITH_CLOSURES.iter().find(|(found, ..)| *found == name);
    if let Some((name, generics, arguments, result, _)) = with_closures {
        return format!("pub fn {name}{generics}({arguments}) -> {result}");
    }
    let plain = PLAIN.iter().find(|(found, ..)| *found == name);
    plain.map_or_else(String::new, |(name, arguments, result)| {
        let arguments: Vec<_> = arguments.iter().map(|(argument, kind)| format!("{argument}: {kind}")).collect();
        format!("pub fn {name}({}) -> {result}", arguments.join(", "))
    })
}

/// Writes the sources of a program, and removes those of an earlier one.
pub fn write(plan: &Plan, folder: &Path) -> io::Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    fs::create_dir_all(folder.join("calls"))?;
    let from_reference = |name: &str| plan.reference.as_ref().is_some_and(|(_, names)| names.contains(name));
    let mut root = String::from(
        "#![allow(warnings)]\nextern crate self as finite_elements_3d;\npub extern crate course_given as given;\nmod calls;\n",
    );
    let mut calls = String::new();
    let mut entries = String::new();
    for name in names() {
        if plan.own.contains_key(name) || !from_reference(name) {
            root.push_str(&format!("pub mod {name};\npub use {name}::{name};\n"));
            let absent = || format!("{IMPORTS}\n{} {{\n    panic!(\"not yet implemented\")\n}}\n", signature(name));
            fs::write(folder.join(format!("{name}.rs")), plan.own.get(name).cloned().unwrap_or_else(absent))?;
        } else if let Some(text) = plan.helpers.get(name) {
            // The function is a value and the module is not, so the two can stand side by side under one name.
            root.push_str(&format!("pub mod {name};\npub use course_below::{name}::{name};\n"));
            fs::write(folder.join(format!("{name}.rs")), text)?;
        } else {
            root.push_str(&format!("pub use course_below::{name};\n"));
        }
        if plan.own.contains_key(name) {
            calls.push_str(&format!("mod {name};\n"));
            entries.push_str(&entry(name));
            fs::write(folder.join(format!("calls/{name}.rs")), format!("{IMPORTS}\n{}", call(name)))?;
        }
    }
    root.push_str("fn main() {\n    grader_child::serve(&calls::FUNCTIONS, given::solve)\n}\n");
    calls.push_str(&format!(
        "pub const FUNCTIONS: grader_child::Functions = grader_child::Functions {{\n{entries}    ..grader_child::NOTHING\n}};\n"
    ));
    fs::write(folder.join("calls.rs"), calls)?;
    fs::write(folder.join("main.rs"), root)
}

fn entry(name: &str) -> String {
    if name == "quadrature_single_point" {
        return format!("    quadrature_of_number: {name}::NUMBER,\n    quadrature_of_vector: {name}::VECTOR,\n");
    }
    format!("    {name}: {name}::CALL,\n")
}

/// The text that calls a function, with the course's signature and nothing else in it.
fn call(name: &str) -> String {
    if let Some((.., text)) = WITH_CLOSURES.iter().find(|(found, ..)| *found == name) {
        return (*text).to_owned();
    }
    let plain = PLAIN.iter().find(|(found, ..)| *found == name);
    plain.map_or_else(String::new, |(_, arguments, result)| {
        let types: Vec<_> = arguments.iter().map(|(_, kind)| *kind).collect();
        format!("pub const CALL: fn({}) -> {result} = crate::{name};\n", types.join(", "))
    })
}
