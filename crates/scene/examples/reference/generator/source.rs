//! The structs and enums of scene files, as their sources document them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use syn::{Attribute, Expr, Fields, Item, Lit, LitStr, Meta, Stmt, Token, Type};

/// The types and docs that the sources declare.
#[derive(Default)]
pub struct Source {
    pub tables: BTreeMap<String, Table>,
    pub choices: BTreeMap<String, Choice>,
    /// Functions that return a literal, and that literal.
    literals: BTreeMap<String, String>,
}

/// A struct.
pub struct Table {
    /// Name of the source file without extension.
    pub file: String,
    pub doc: String,
    pub keys: Vec<Key>,
}

/// A field of a struct.
pub struct Key {
    pub name: String,
    pub doc: String,
    pub kind: Type,
    pub default: SerdeDefault,
}

/// The default that serde takes for a field.
pub enum SerdeDefault {
    Missing,
    OfType,
    Literal(String),
}

/// An enum.
pub struct Choice {
    pub file: String,
    pub doc: String,
    /// True if the values are the names of the variants, false if a scene may give something else.
    pub is_named: bool,
    pub values: Vec<Value>,
}

/// A variant of an enum.
pub struct Value {
    pub name: String,
    pub doc: String,
    /// The struct that it holds.
    pub table: Option<String>,
    pub is_default: bool,
}

impl Source {
    /// Reads the sources of this package, and the values of its keys.
    pub fn read() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let folder = fs::read_dir(root.join("src/tables")).expect("the folder of the tables");
        let mut paths: Vec<PathBuf> = folder.flatten().map(|entry| entry.path()).collect();
        paths.extend(
            [
                "model/src/axis",
                "model/src/elastic",
                "model/src/fields",
                "model/src/integrator",
                "model/src/law",
                "model/src/material",
                "model/src/method",
                "model/src/selector",
                "model/src/solver",
                "model/src/viscosity",
                "mesh/src/sides",
                "mesh/src/pattern",
            ]
            .map(|file| root.join(format!("../{file}.rs"))),
        );
        let mut source = Self::default();
        for path in paths {
            let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let text = expanded(&text).unwrap_or(text);
            let file = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            file.items.iter().for_each(|item| source.add(item, &stem));
        }
        source
    }

    fn add(&mut self, item: &Item, file: &str) {
        match item {
            Item::Struct(item) if is_read(&item.attrs) => {
                let fields = item.fields.iter().filter_map(|field| {
                    let serde = Serde::of(&field.attrs);
                    let name = serde.rename.unwrap_or(field.ident.as_ref()?.to_string());
                    let key = Key { name, doc: doc(&field.attrs), kind: field.ty.clone(), default: serde.default };
                    (!serde.is_skipped).then_some(key)
                });
                let table = Table { file: file.to_owned(), doc: doc(&item.attrs), keys: fields.collect() };
                self.tables.insert(item.ident.to_string(), table);
            }
            Item::Enum(item) => {
                let values = item.variants.iter().map(|variant| Value {
                    name: snake_case(&variant.ident.to_string()),
                    doc: doc(&variant.attrs),
                    table: match &variant.fields {
                        Fields::Unnamed(fields) => fields.unnamed.first().and_then(|field| name_of(&field.ty)),
                        _ => None,
                    },
                    is_default: variant.attrs.iter().any(|attribute| attribute.path().is_ident("default")),
                });
                let (doc, is_named) = (doc(&item.attrs), is_read(&item.attrs));
                let choice = Choice { file: file.to_owned(), doc, is_named, values: values.collect() };
                self.choices.insert(item.ident.to_string(), choice);
            }
            Item::Fn(item) => {
                if let [Stmt::Expr(Expr::Lit(literal), None)] = &item.block.stmts[..]
                    && let Some(text) = number(&literal.lit)
                {
                    self.literals.insert(item.sig.ident.to_string(), text);
                }
            }
            _ => {}
        }
    }

    /// The literal that a function of a serde attribute returns.
    pub fn literal(&self, function: &str) -> &str {
        self.literals
            .get(function)
            .unwrap_or_else(|| panic!("{function} returns no literal; write `Default: …` in the doc"))
    }
}

/// A macro that writes structs with a list: its name, the file of fem-model with the list, the fields in its text, and one of them.
type Listed = (&'static str, &'static str, &'static str, fn(&str) -> String);

const MACROS: [Listed; 2] = [
    ("material", "law", "$($(#[$doc])* pub $name: Option<f64>,)*", |name| format!("pub {name}: Option<f64>,")),
    ("scene", "fields", "$($(#[$doc])* pub $table: Option<fem_model::$Field>,)*", |entry| {
        let (table, field) = entry.split_once(": ").unwrap_or((entry, ""));
        format!("pub {table}: Option<{field}>,")
    }),
];

/// The text of a file with the structs of one of [`MACROS`] written out after it.
fn expanded(text: &str) -> Option<String> {
    fn between<'a>(text: &'a str, start: &str, end: &str) -> Option<&'a str> {
        Some(text.split_once(start)?.1.split_once(end)?.0)
    }
    MACROS.into_iter().find_map(|(name, file, fields, field)| {
        let body = between(text, &format!("macro_rules! {name} {{"), "\n}\n")?;
        let model = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../model/src/{file}.rs"));
        let model = fs::read_to_string(&model).unwrap_or_else(|error| panic!("{}: {error}", model.display()));
        let list = between(&model, "$callback! {\n", "\n        }\n")?;
        let line = |line: &str| match line.trim().strip_suffix(',') {
            Some(entry) if !entry.starts_with("///") => field(entry),
            _ => line.to_owned(),
        };
        let body = body.replace(fields, &list.lines().map(line).collect::<Vec<_>>().join("\n"));
        let (_, body) = body.split_once("=> {\n")?;
        let structs: Vec<&str> = body.split("\n\n").filter(|item| item.contains("pub struct ")).collect();
        Some([&[text], &structs[..]].concat().join("\n"))
    })
}

/// A field's attributes of serde.
struct Serde {
    rename: Option<String>,
    default: SerdeDefault,
    is_skipped: bool,
}

impl Serde {
    fn of(attributes: &[Attribute]) -> Self {
        let mut serde = Self { rename: None, default: SerdeDefault::Missing, is_skipped: false };
        for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("serde")) {
            let parsed = attribute.parse_nested_meta(|meta| {
                let value = match meta.input.peek(Token![=]) {
                    true => Some(meta.value()?.parse::<LitStr>()?.value()),
                    false => None,
                };
                let key = meta.path.get_ident().map(ToString::to_string).unwrap_or_default();
                match (key.as_str(), value) {
                    ("rename", value) => serde.rename = value,
                    ("skip", _) => serde.is_skipped = true,
                    ("default", None) => serde.default = SerdeDefault::OfType,
                    ("default", Some(function)) => serde.default = SerdeDefault::Literal(function),
                    _ => {}
                }
                Ok(())
            });
            parsed.expect("attributes of serde are words and words with a text");
        }
        serde
    }
}

fn is_read(attributes: &[Attribute]) -> bool {
    let mut is_read = false;
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("derive")) {
        let parsed = attribute.parse_nested_meta(|meta| {
            is_read |= meta.path.segments.last().is_some_and(|last| last.ident == "Deserialize");
            Ok(())
        });
        parsed.expect("derive lists paths");
    }
    is_read
}

/// The doc comment: a paragraph on each line.
fn doc(attributes: &[Attribute]) -> String {
    let mut paragraphs = vec![String::new()];
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("doc")) {
        if let Meta::NameValue(meta) = &attribute.meta
            && let Expr::Lit(literal) = &meta.value
            && let Lit::Str(line) = &literal.lit
        {
            match (line.value().trim(), paragraphs.last_mut()) {
                ("", _) => paragraphs.push(String::new()),
                (line, Some(last)) if !last.is_empty() => *last += &format!(" {line}"),
                (line, Some(last)) => *last += line,
                (_, None) => {}
            }
        }
    }
    paragraphs.join("\n")
}

/// The last word of a type's path.
pub fn name_of(kind: &Type) -> Option<String> {
    match kind {
        Type::Path(path) => path.path.segments.last().map(|last| last.ident.to_string()),
        _ => None,
    }
}

fn number(literal: &Lit) -> Option<String> {
    match literal {
        Lit::Int(number) => Some(number.to_string()),
        Lit::Float(number) => Some(number.to_string().trim_end_matches(".0").to_owned()),
        _ => None,
    }
}

/// `LinearlyImplicit` as `linearly_implicit`.
fn snake_case(variant: &str) -> String {
    let mut name = String::new();
    for c in variant.chars() {
        if c.is_uppercase() && !name.is_empty() {
            name.push('_');
        }
        name.extend(c.to_lowercase());
    }
    name
}
