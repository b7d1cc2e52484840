//! The page: a section for each table of a scene, one for selectors, one for load curves, and one for what several tables share.

use std::collections::BTreeMap;

use super::COMMAND;
use super::source::{Choice, Key, Source, Table};
use super::value::{default, is_list, is_required, meaning, names, struct_or_enum, values};

/// Pages on the matter of a table.
const PAGES: [(&str, &str); 14] = [
    ("mesh", "[Flat bodies](scenes.md#flat-bodies)"),
    ("material", "[Materials](materials.md)"),
    ("fibres", "[Fibres](materials.md#fibres)"),
    ("plasticity", "[Plasticity](plasticity.md)"),
    ("planes", "[Contact](contact.md)"),
    ("contact", "[Contact](contact.md)"),
    ("time", "[Integrators](integrators.md)"),
    ("static", "[Limit points](integrators.md#limit-points)"),
    ("newmark", "[Integrators](integrators.md)"),
    ("generalized_alpha", "[Integrators](integrators.md)"),
    ("iterations", "[Integrators](integrators.md)"),
    ("newton", "[Integrators](integrators.md)"),
    ("solver", "[Linear solvers](solvers.md)"),
    ("batch", "[Graphics devices and batches](devices.md)"),
];

/// The sections of what several tables use, with the source file of its structs and enums; the last one has the rest.
const SHARED: [(&str, &str); 3] = [("Selectors", "selector"), ("Load curves", "curve"), ("Shared values", "")];

/// The text of the page.
pub fn page() -> String {
    let reference = Reference::new(Source::read());
    let mut text = format!(
        "# Reference of scene files\n\n\
         A scene is a [TOML](https://toml.io) file in SI units, of 1 MiB at most; [Scene files](scenes.md) explains it with an example. An \
         unknown key is an error. `--set TABLE.KEY=VALUE` replaces a value in a run without a change of the file, such as `--set \
         time.dt=0.01` or `--set traction.0.pressure=5`.\n\n\
         Tables are optional unless their section says otherwise, and double brackets mark those that may be repeated. Keys that are `required` must be there if their table is; the others may be left \
         out. Keys and tables marked *Engine only* belong to `pipeline = \"engine\"`. A table without effect on the integrator, such as \
         `[newton]` with `verlet`, is refused.\n\n\
         This page is generated from the documentation of the structs in `crates/scene/src` by `{COMMAND}`.\n"
    );
    text += "\n## Keys outside tables\n\n";
    let outside = || reference.root().keys.iter().filter(|key| reference.table_of(key).is_none());
    text += &reference.keys(outside());
    for name in outside().filter_map(|key| struct_or_enum(&key.kind, &reference.source)) {
        text += &reference.subsection(&name);
    }
    for key in &reference.root().keys {
        if let Some(table) = reference.table_of(key) {
            text += &reference.section(key, table);
        }
    }
    for (title, file) in SHARED {
        text += &format!("\n## {title}\n");
        if let Some(choice) = reference.source.choices.get("Selector").filter(|_| file == "selector") {
            text += &format!("\n{}\n\n{}", paragraphs(&choice.doc), listed(choice, "key", "selects"));
        }
        let own = reference.places.iter().filter(|(_, place)| place.shared == Some(title));
        let mut own: Vec<_> = own.collect();
        own.sort_by_key(|(_, place)| place.number);
        own.iter().for_each(|(name, _)| text += &reference.subsection(name));
    }
    text
}

/// The place of a struct or enum on the page.
struct Place {
    heading: String,
    /// Section of [`SHARED`]; `None` for one under the only table that uses it.
    shared: Option<&'static str>,
    /// Number in the order of first use.
    number: usize,
}

struct Reference {
    source: Source,
    places: BTreeMap<String, Place>,
}

impl Reference {
    fn new(source: Source) -> Self {
        let mut uses = Vec::new();
        for key in &source.tables["Scene"].keys {
            match struct_or_enum(&key.kind, &source) {
                Some(name) if source.tables.contains_key(&name) => add_uses(&name, &key.name, &source, &mut uses),
                Some(name) => uses.push((name, key.name.clone())),
                None => {}
            }
        }
        let mut places = BTreeMap::new();
        for (number, (name, _)) in uses.iter().enumerate() {
            let keys: Vec<&str> = uses.iter().filter(|(used, _)| used == name).map(|(_, key)| key.as_str()).collect();
            places.entry(name.clone()).or_insert_with(|| place(name, &keys, number, &source));
        }
        Self { source, places }
    }

    fn root(&self) -> &Table {
        &self.source.tables["Scene"]
    }

    /// The struct of a key of `Scene` that is a table.
    fn table_of(&self, key: &Key) -> Option<&Table> {
        self.source.tables.get(&struct_or_enum(&key.kind, &self.source)?)
    }

    /// The section of a table: its keys, and the structs and enums that it alone uses.
    fn section(&self, key: &Key, table: &Table) -> String {
        let name = &key.name;
        let heading = if is_list(&key.kind) { format!("[[{name}]]") } else { format!("[{name}]") };
        let mut text =
            format!("\n## {heading}\n\n{}", paragraphs(&table.doc).replacen("selector", "[selector](#selectors)", 1));
        text += if is_required(key) { " Every scene has this table.\n" } else { "\n" };
        if let Some((_, page)) = PAGES.iter().find(|(table, _)| table == name) {
            text += &format!("\nSee also {page}.\n");
        }
        text += &format!("\n{}", self.keys(table.keys.iter()));
        if name == "material" {
            text += "\n### Laws\n\nA table gives the parameters of its law and no others; several sets are alternatives.\n\n| model | parameters |\n|---|---|\n";
            for fem_model::LawFacts { name: law, parameters, .. } in fem_model::Law::all_facts() {
                let sets: Vec<String> = parameters.iter().map(|set| format!("`{}`", set.join("`, `"))).collect();
                text += &format!("| `\"{law}\"` | {} |\n", sets.join("; or "));
            }
        }
        let mut uses = Vec::new();
        add_uses(&struct_or_enum(&key.kind, &self.source).unwrap_or_default(), name, &self.source, &mut uses);
        let mut written = Vec::new();
        for (used, _) in uses {
            if self.places[&used].shared.is_none() && !written.contains(&used) {
                text += &self.subsection(&used);
                written.push(used);
            }
        }
        text
    }

    /// The subsection of a struct or an enum.
    fn subsection(&self, name: &str) -> String {
        let heading = format!("\n### {}\n\n", self.places[name].heading);
        if let Some(table) = self.source.tables.get(name) {
            return format!("{heading}{}\n\n{}", paragraphs(&table.doc), self.keys(table.keys.iter()));
        }
        let choice = &self.source.choices[name];
        let mut text = format!("{heading}{}\n\n{}", paragraphs(&choice.doc), listed(choice, "value", "meaning"));
        for table in choice.values.iter().filter_map(|value| self.source.tables.get(value.table.as_ref()?)) {
            text += &format!("\n{}\n\n{}", paragraphs(&table.doc), self.keys(table.keys.iter()));
        }
        text
    }

    /// The table of some keys.
    fn keys<'a>(&self, keys: impl Iterator<Item = &'a Key>) -> String {
        let link = |name: &str| format!("#{}", anchor(&self.places[name].heading));
        let mut text = "| key | type or values | default | meaning |\n|---|---|---|---|\n".to_owned();
        for key in keys {
            let is_law = key.name == "model" && struct_or_enum(&key.kind, &self.source).is_none();
            let values = if is_law { "[a law](#laws)".to_owned() } else { values(&key.kind, &self.source, link) };
            let cells = [format!("`{}`", key.name), values, default(key, &self.source), meaning(key)];
            text += &format!("| {} |\n", cells.map(|cell| cell.replace('|', "\\|")).join(" | "));
        }
        text
    }
}

/// Adds the structs and enums that a struct holds, each with the key, such as `mesh.box`.
fn add_uses(table: &str, path: &str, source: &Source, uses: &mut Vec<(String, String)>) {
    for key in &source.tables[table].keys {
        let Some(name) = struct_or_enum(&key.kind, source) else { continue };
        let path = format!("{path}.{}", key.name);
        uses.push((name.clone(), path.clone()));
        let values = source.choices.get(&name).into_iter().flat_map(|choice| &choice.values);
        let nested = values.filter_map(|value| value.table.as_ref());
        for table in nested.chain([&name]).filter(|table| source.tables.contains_key(*table)) {
            add_uses(table, &path, source, uses);
        }
    }
}

fn place(name: &str, keys: &[&str], number: usize, source: &Source) -> Place {
    let (doc, file) = match (source.tables.get(name), source.choices.get(name)) {
        (Some(table), _) => (&table.doc, &table.file),
        (None, choice) => choice.map(|choice| (&choice.doc, &choice.file)).expect("a struct or an enum"),
    };
    let top = |key: &str| key.split('.').next().unwrap_or_default().to_owned();
    let parent = keys[0].rsplit_once('.').map_or(keys[0], |(parent, _)| parent);
    let last = |key: &str| key.rsplit('.').next().unwrap_or_default().to_owned();
    let is_table = source.tables.contains_key(name);
    let of_a_file = SHARED.iter().find(|(_, shared)| shared == file).map(|(title, _)| *title);
    let is_used_twice = keys.iter().any(|key| top(key) != top(keys[0]));
    let (heading, shared) = match of_a_file {
        Some(title) => (title_of(doc).unwrap_or_else(|| name.to_owned()), Some(title)),
        None if is_used_twice => (name.to_owned(), Some(SHARED[2].0)),
        None if keys.len() > 1 && keys.iter().all(|key| last(key) == last(keys[0])) => {
            (format!("Values of {}", last(keys[0])), None)
        }
        None if keys.len() > 1 => (format!("Tables in [{parent}]"), None),
        None if is_table => (format!("[{}]", keys[0]), None),
        None => (format!("Values of {}", keys[0]), None),
    };
    Place { heading, shared, number }
}

/// The key before the colon of a doc such as `` `box`: a box ``.
fn title_of(doc: &str) -> Option<String> {
    let (key, _) = doc.split_once("`: ")?;
    key.strip_prefix('`').filter(|key| !key.contains('`')).map(str::to_owned)
}

/// A doc as paragraphs, without the key before its colon.
fn paragraphs(doc: &str) -> String {
    let rest = title_of(doc).map_or(doc, |key| &doc[key.len() + 4..]);
    let mut letters = rest.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    (first + letters.as_str()).replace('\n', "\n\n")
}

/// The table of an enum's values. Docs of values without a name of their own begin with it.
fn listed(choice: &Choice, key: &str, meaning: &str) -> String {
    let mut text = format!("| {key} | {meaning} |\n|---|---|\n");
    for (value, name) in choice.values.iter().zip(names(choice)) {
        let doc =
            if choice.is_named { value.doc.as_str() } else { value.doc.split_once(": ").map_or("", |(_, doc)| doc) };
        text += &format!("| {name} | {} |\n", paragraphs(doc).replace('|', "\\|"));
    }
    text
}

/// The anchor of a heading, as GitHub and mdBook make it.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}
