//! The book's tables of materials, integrators and solvers agree with the code.

use super::{assert_none, files, read, stem};

/// The text of all pages of the book.
fn book() -> String {
    let pages: String = files("md").iter().filter(|path| path.starts_with("docs/book")).map(read).collect();
    assert!(!pages.is_empty(), "no pages in docs/book");
    pages
}

/// The first cells of the rows of the book.
fn first_cells() -> Vec<String> {
    let text = book();
    text.lines().filter_map(|line| Some(line.strip_prefix("| ")?.split(" |").next()?.to_owned())).collect()
}

/// The text of all files in a folder.
fn sources(folder: &str) -> String {
    files("rs").iter().filter(|path| path.starts_with(folder)).map(read).collect()
}

/// The lines between the braces of an item that starts in the first column.
fn body<'a>(text: &'a str, head: &str) -> Vec<&'a str> {
    let lines = text.lines().skip_while(|line| *line != head).skip(1);
    lines.take_while(|line| !line.starts_with('}')).map(str::trim).collect()
}

#[test]
fn every_law_has_a_file_of_its_name_and_a_row_in_the_book() {
    let cells = first_cells();
    let mut problems = Vec::new();
    for path in files("rs").into_iter().filter(|path| path.starts_with("crates/elements/src/materials")) {
        let text = read(&path);
        let Some(name) = text.split("const NAME: &'static str = \"").nth(1).and_then(|rest| rest.split('"').next())
        else {
            continue;
        };
        if stem(&path) != name {
            problems.push(format!("{}: call this file {name}.rs, like its law", path.display()));
        }
        if !cells.contains(&format!("`{name}`")) {
            problems.push(format!("docs/book/materials.md: add a row for `{name}`"));
        }
    }
    assert_none(problems);
}

#[test]
fn every_integrator_solver_and_preconditioner_has_a_row_in_the_book() {
    let (scene, cells) = (sources("crates/model/src"), first_cells());
    let mut problems = Vec::new();
    for (kind, page) in [("Integrator", "integrators"), ("SolverKind", "solvers"), ("Preconditioner", "solvers")] {
        let lines = body(&scene, &format!("pub enum {kind} {{"));
        let is_variant = |line: &&str| line.starts_with(char::is_uppercase);
        let variants: Vec<_> = lines.into_iter().filter(is_variant).map(snake_case).collect();
        assert!(variants.len() > 1, "no enum {kind} with variants in crates/model/src");
        let missing = variants.into_iter().filter(|name| !cells.contains(&format!("`{name}`")));
        problems.extend(missing.map(|name| format!("docs/book/{page}.md: add a row for `{name}`")));
    }
    assert_none(problems);
}

/// `LinearlyImplicit,` as `linearly_implicit`.
fn snake_case(variant: &str) -> String {
    let mut name = String::new();
    for c in variant.chars().take_while(|c| c.is_alphanumeric()) {
        if c.is_uppercase() && !name.is_empty() {
            name.push('_');
        }
        name.extend(c.to_lowercase());
    }
    name
}
