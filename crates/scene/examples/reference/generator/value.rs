//! The cells of a key: the values that it takes, its default, and its meaning.

use syn::{Expr, GenericArgument, Lit, PathArguments, Type};

use super::source::{Choice, Key, SerdeDefault, Source, name_of};

/// Largest number of values that a cell lists; more have a table of their own alone.
const MOST_IN_A_CELL: usize = 4;

/// The values of a key. `link` gives the link to the section of a struct or enum.
pub fn values(kind: &Type, source: &Source, link: impl Fn(&str) -> String) -> String {
    if let Some(inner) = argument(kind, "Option") {
        return values(inner, source, link);
    }
    let Some(name) = struct_or_enum(kind, source) else {
        let word = word(kind);
        return if word.starts_with('[') { format!("`{word}`") } else { word };
    };
    let target = link(&name);
    let of_one = match source.choices.get(&name) {
        None => format!("[table]({target})"),
        Some(choice) if choice.values.len() > MOST_IN_A_CELL => format!("[a name]({target})"),
        Some(choice) => format!("{}: [values]({target})", names(choice).join(", ")),
    };
    if argument(kind, "Vec").is_some() { format!("list of {of_one}") } else { of_one }
}

/// The values of an enum as scenes write them.
pub fn names(choice: &Choice) -> Vec<String> {
    let name = |name: &str| format!("`\"{name}\"`");
    let told = |doc: &str| doc.split_once(": ").map_or(doc, |(value, _)| value).to_owned();
    choice.values.iter().map(|value| if choice.is_named { name(&value.name) } else { told(&value.doc) }).collect()
}

/// A type in the words of scene files: `number`, `[number, number]`, `[path, …]`.
fn word(kind: &Type) -> String {
    if let Some(inner) = argument(kind, "Vec") {
        return format!("[{}, …]", word(inner));
    }
    if let Type::Array(array) = kind {
        return format!("[{}]", vec![word(&array.elem); length(&array.len)].join(", "));
    }
    match name_of(kind).unwrap_or_default().as_str() {
        "f64" => "number".to_owned(),
        "usize" | "u32" => "integer".to_owned(),
        "bool" => "`true`, `false`".to_owned(),
        "String" => "text".to_owned(),
        "PathBuf" => "path".to_owned(),
        other => panic!("`{other}` is in none of the files that `Source::read` reads"),
    }
}

fn length(expression: &Expr) -> usize {
    match expression {
        Expr::Lit(literal) => match &literal.lit {
            Lit::Int(number) => number.base10_parse().unwrap_or_default(),
            _ => 0,
        },
        _ => 0,
    }
}

/// `T` of `Option<T>`.
fn argument<'a>(kind: &'a Type, of: &str) -> Option<&'a Type> {
    let Type::Path(path) = kind else { return None };
    let last = path.path.segments.last().filter(|last| last.ident == of)?;
    let PathArguments::AngleBracketed(arguments) = &last.arguments else { return None };
    arguments.args.iter().find_map(|argument| match argument {
        GenericArgument::Type(inner) => Some(inner),
        _ => None,
    })
}

/// The name of the struct or enum that a key holds, one or a list of them.
pub fn struct_or_enum(kind: &Type, source: &Source) -> Option<String> {
    match argument(kind, "Option").or(argument(kind, "Vec")) {
        Some(inner) => struct_or_enum(inner, source),
        None => name_of(kind).filter(|name| source.tables.contains_key(name) || source.choices.contains_key(name)),
    }
}

/// True if a key or table may be repeated.
pub fn is_list(kind: &Type) -> bool {
    argument(kind, "Vec").is_some()
}

/// True if a scene has to give the key.
pub fn is_required(key: &Key) -> bool {
    argument(&key.kind, "Option").is_none() && matches!(key.default, SerdeDefault::Missing)
}

/// The default of a key: that of its attributes, or of the last sentence of its doc, `Default: …`.
pub fn default(key: &Key, source: &Source) -> String {
    let told = key.doc.split_once("Default: ").map(|(_, default)| default.trim_end_matches('.'));
    let of_type = || match name_of(&key.kind).unwrap_or_default().as_str() {
        "f64" | "usize" | "u32" => "0".to_owned(),
        "bool" => "`false`".to_owned(),
        "String" => "empty".to_owned(),
        other => source.choices.get(other).and_then(default_value).unwrap_or_default(),
    };
    let found = match &key.default {
        SerdeDefault::Literal(function) => source.literal(function).to_owned(),
        SerdeDefault::OfType => of_type(),
        SerdeDefault::Missing => String::new(),
    };
    match told {
        Some(told) if found.is_empty() => told.to_owned(),
        Some(_) => panic!("the doc of `{}` repeats the default of its attribute; remove it from the doc", key.name),
        None if is_required(key) => "required".to_owned(),
        None => found,
    }
}

fn default_value(choice: &Choice) -> Option<String> {
    choice.values.iter().find(|value| value.is_default).map(|value| format!("`\"{}\"`", value.name))
}

/// The doc of a key without its default.
pub fn meaning(key: &Key) -> String {
    let doc = key.doc.replace('\n', " ");
    doc.split_once("Default: ").map_or(doc.as_str(), |(meaning, _)| meaning).trim_end().to_owned()
}
