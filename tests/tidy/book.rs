//! The book's tables of scene keys, materials, integrators and solvers agree with the code.

use std::collections::{BTreeMap, BTreeSet};

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

/// The keys of a table of scene files, each with its type.
fn keys(scene: &str, table: &str) -> BTreeMap<String, String> {
    let (mut keys, mut attribute) = (BTreeMap::new(), "");
    for line in body(scene, &format!("pub struct {table} {{")) {
        if line.starts_with("#[serde") {
            attribute = line;
        } else if let Some((name, kind)) = line.strip_prefix("pub ").and_then(|field| field.split_once(": ")) {
            let renamed = attribute.split("rename = \"").nth(1).and_then(|rest| rest.split('"').next());
            if !attribute.contains("skip") {
                let kind = kind.trim_start_matches("Option<").trim_start_matches("Vec<").trim_end_matches([',', '>']);
                keys.insert(renamed.unwrap_or(name).to_owned(), kind.to_owned());
            }
            attribute = "";
        }
    }
    keys
}

#[test]
fn every_scene_key_is_in_the_book_and_every_key_there_is_one() {
    let scene = sources("crates/scene/src");
    let cells = first_cells();
    // A cell names a table and one key or several: `[fixed]` `plane` or `nodes`.
    let words = |cell: &String| -> Vec<String> { cell.split('`').skip(1).step_by(2).map(str::to_owned).collect() };
    let is_table = |word: &str, table: &str| word == format!("[{table}]") || word == format!("[[{table}]]");
    let told = |table: &str| -> BTreeSet<String> {
        let rows = cells.iter().filter(|cell| words(cell).first().is_some_and(|word| is_table(word, table)));
        rows.flat_map(|cell| if cell.ends_with('…') { vec!["…".to_owned()] } else { words(cell)[1..].to_vec() })
            .collect()
    };
    let mut problems = Vec::new();
    let tables = keys(&scene, "Scene");
    assert!(tables.contains_key("mesh"), "no struct Scene with a table mesh in crates/scene/src");
    for (table, kind) in tables {
        let (known, told) = (keys(&scene, &kind), told(&table));
        if told.contains("…") {
            // The laws' own keys.
        } else if known.is_empty() {
            // A key without a table.
            if !cells.contains(&format!("`{table}`")) {
                problems.push(format!("docs/book/scene-keys.md: add a row for the key `{table}` of scene files"));
            }
        } else {
            let missing = known.keys().filter(|key| !told.contains(*key));
            problems
                .extend(missing.map(|key| {
                    format!("docs/book/scene-keys.md: add a row `[{table}]` `{key}` to the keys of scenes")
                }));
            let unknown = told.iter().filter(|key| !known.contains_key(*key));
            problems.extend(
                unknown.map(|key| format!("docs/book/scene-keys.md: scene files have no key `{key}` in [{table}]")),
            );
        }
    }
    assert_none(problems);
}

/// The words in code of the book.
fn words_of_the_book() -> BTreeSet<String> {
    let text = book();
    let code = text.split('`').skip(1).step_by(2);
    let words = code.flat_map(|code| code.split(|c: char| !c.is_alphanumeric() && c != '_'));
    words.map(str::to_owned).collect()
}

#[test]
fn every_key_of_every_table_and_every_parameter_of_a_law_is_named_in_the_scene_format() {
    let words = words_of_the_book();
    let (mut problems, mut count) = (Vec::new(), 0);
    let folder = "crates/scene/src";
    let is_table = |path: &std::path::PathBuf| {
        path.starts_with(format!("{folder}/tables")) || path.ends_with(format!("{folder}/curve.rs"))
    };
    for path in files("rs").into_iter().filter(is_table) {
        let text = read(&path);
        let structs = text.lines().filter_map(|line| line.strip_prefix("pub struct ")?.strip_suffix(" {"));
        let is_read = |name: &&str| {
            text.split(&format!("pub struct {name} {{")).next().is_some_and(|before| {
                before.rsplit("\n\n").next().is_some_and(|attributes| attributes.contains("Deserialize"))
            })
        };
        let of_tables = structs.filter(is_read).flat_map(|name| keys(&text, name).into_keys());
        let parameters = body(&text, "material! {").into_iter().filter(|line| !line.starts_with("///"));
        let parameters = parameters.filter_map(|line| Some(line.split_once(':')?.0.to_owned()));
        for key in of_tables.chain(parameters) {
            count += 1;
            if !words.contains(&key) {
                problems.push(format!("{}: name its key `{key}` in docs/book/scene-keys.md", path.display()));
            }
        }
    }
    assert!(count > 80, "only {count} keys are found in {folder}");
    assert_none(problems);
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
    let (scene, cells) = (sources("crates/scene/src"), first_cells());
    let mut problems = Vec::new();
    for (kind, page) in [("Integrator", "integrators"), ("SolverKind", "solvers"), ("Preconditioner", "solvers")] {
        let lines = body(&scene, &format!("pub enum {kind} {{"));
        let is_variant = |line: &&str| line.starts_with(char::is_uppercase);
        let variants: Vec<_> = lines.into_iter().filter(is_variant).map(snake_case).collect();
        assert!(variants.len() > 1, "no enum {kind} with variants in crates/scene/src");
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
