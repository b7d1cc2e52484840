//! The source text around a submission's files: the crate's root, the calls, and bodies for missing functions.

use std::path::Path;
use std::{fs, io};

use grader_child::{Exercise, course_functions};

use super::Plan;

/// A row of the list of functions as text.
struct Row {
    takes_closures: bool,
    arguments: &'static [(&'static str, &'static str)],
    result: &'static str,
}

macro_rules! rows {
    ($($kind:ident $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        const ROWS: [Row; 22] = [$(Row {
            takes_closures: $kind!(),
            arguments: &[$((stringify!($argument), stringify!($type))),*],
            result: stringify!($result),
        }),*];
    };
}
macro_rules! plain {
    () => {
        false
    };
}
macro_rules! with_closures {
    () => {
        true
    };
}
course_functions!(rows);

/// Types that signatures are made of.
const IMPORTS: &str = "use nalgebra::{DVector, Matrix3, Matrix4, Matrix4x3, SMatrix, SVector, Vector3, Vector4};\n\
     use nalgebra_sparse::CsrMatrix;\nuse grader_child::{Force, Gradient, Hessian, Integrand, Objective, Solve, Stiffness};\n";

/// A function that takes a vector and returns this.
const OF_ONE: &str = "impl Fn(&DVector<f64>) -> ";

/// The course's signature of a function.
pub fn signature(function: Exercise) -> String {
    let Row { arguments, result, .. } = &ROWS[function as usize];
    // The list holds the types that a call has: references to closures, and vectors in place of the generic R.
    let (generics, result) = match function {
        Exercise::quadrature_single_point => ("<R: std::ops::Mul<f64, Output = R>>", "R"),
        _ => ("", *result),
    };
    let written = |kind: &str| match kind {
        "Integrand" => "impl Fn(&Vector3<f64>) -> R".to_owned(),
        "Objective" => format!("{OF_ONE}f64"),
        "Gradient" => format!("{OF_ONE}DVector<f64>"),
        "Hessian" => format!("{OF_ONE}CsrMatrix<f64>"),
        "Force" => "impl Fn(&DVector<f64>, &DVector<f64>) -> DVector<f64>".to_owned(),
        "Stiffness" => "impl Fn(&DVector<f64>, &DVector<f64>) -> CsrMatrix<f64>".to_owned(),
        "Solve" => "impl Fn(&CsrMatrix<f64>, &DVector<f64>) -> DVector<f64>".to_owned(),
        plain => plain.to_owned(),
    };
    let arguments: Vec<_> = arguments.iter().map(|(argument, kind)| format!("{argument}: {}", written(kind))).collect();
    let signature = format!("pub fn {}{generics}({}) -> {result}", function.name(), arguments.join(", "));
    // The macro puts spaces between all tokens.
    [(" < ", "<"), (" >", ">"), ("& ", "&"), (" ;", ";")]
        .iter()
        .fold(signature, |text, (from, to)| text.replace(from, to))
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
    for function in Exercise::ALL {
        let name = function.name();
        if plan.own.contains_key(name) || !from_reference(name) {
            root.push_str(&format!("pub mod {name};\npub use {name}::{name};\n"));
            let absent = || format!("{IMPORTS}\n{} {{\n    panic!(\"not yet implemented\")\n}}\n", signature(function));
            fs::write(folder.join(format!("{name}.rs")), plan.own.get(name).cloned().unwrap_or_else(absent))?;
        } else if let Some(text) = plan.helpers.get(name) {
            // Functions and modules have different namespaces, so both can have the same name.
            root.push_str(&format!("pub mod {name};\npub use course_below::{name}::{name};\n"));
            fs::write(folder.join(format!("{name}.rs")), text)?;
        } else {
            root.push_str(&format!("pub use course_below::{name};\n"));
        }
        if plan.own.contains_key(name) {
            calls.push_str(&format!("mod {name};\n"));
            entries.push_str(&format!("    {name}: {name}::CALL,\n"));
            fs::write(folder.join(format!("calls/{name}.rs")), format!("{IMPORTS}\n{}", call(function)))?;
        }
    }
    root.push_str("fn main() {\n    grader_child::serve(&calls::FUNCTIONS, given::solve)\n}\n");
    calls.push_str(&format!(
        "pub const FUNCTIONS: grader_child::Functions = grader_child::Functions {{\n{entries}    ..grader_child::UNWRITTEN\n}};\n"
    ));
    fs::write(folder.join("calls.rs"), calls)?;
    fs::write(folder.join("main.rs"), root)
}

/// An argument of a call. A closure is passed by value, as the course's programs do, so that a function that asks for a reference to one
/// does not compile here either.
fn passed(argument: &str, kind: &str) -> String {
    let takes = match kind {
        "Integrand" => "x: &Vector3<f64>",
        "Objective" | "Gradient" | "Hessian" => "x: &DVector<f64>",
        "Force" | "Stiffness" => "x: &DVector<f64>, y: &DVector<f64>",
        "Solve" => "x: &CsrMatrix<f64>, y: &DVector<f64>",
        _ => return argument.to_owned(),
    };
    let given = if takes.contains("y:") { "x, y" } else { "x" };
    format!("|{takes}| {argument}({given})")
}

/// The text that calls a function, with the course's signature and nothing else in it.
fn call(function: Exercise) -> String {
    let (name, Row { takes_closures, arguments, result }) = (function.name(), &ROWS[function as usize]);
    let (names, types): (Vec<_>, Vec<_>) = arguments.iter().copied().unzip();
    let (names, types) = (names.join(", "), types.join(", "));
    if !takes_closures {
        return format!("pub const CALL: fn({types}) -> {result} = crate::{name};\n");
    }
    let passed: Vec<_> = arguments.iter().map(|(argument, kind)| passed(argument, kind)).collect();
    let call = format!("|{names}| crate::{name}({});\n", passed.join(", "));
    // Generic, so a call with numbers must compile as well.
    let of_numbers = "const _: fn(&[Vector3<f64>], &[usize; 4], f64, &dyn Fn(&Vector3<f64>) -> f64) -> f64 =\n    ";
    let also = if types.contains("Integrand") { format!("{of_numbers}{call}") } else { String::new() };
    format!("pub const CALL: fn({types}) -> {result} =\n    {call}{also}")
}
