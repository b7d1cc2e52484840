//! Studies of users: scenes, variations, what is measured and what is expected, as a TOML file.

use std::fs;
use std::path::Path;

use fem_scene::{Override, load_with};
use serde::Deserialize;
use toml::{Table, Value};

use super::{DISTANCE, Measure, QUANTITIES, Sweep, SweptScene, combinations, quantity};
use crate::runs::measure::Factory;

/// The file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    /// Title of the page; the name of the file without it.
    title: Option<String>,
    /// First paragraph of the page.
    #[serde(default)]
    about: String,
    /// Names of scenes, or paths from the file's folder.
    scenes: Vec<String>,
    /// Keys that differ from the scenes' in every run.
    #[serde(default)]
    set: Table,
    /// Keys with several values; every combination is a run.
    #[serde(default)]
    vary: Vec<Variation>,
    /// Further sets of keys, each combined with every variation.
    #[serde(default)]
    case: Vec<Named>,
    /// The result that is judged.
    measure: Option<String>,
    /// What it must be.
    expected: Option<f64>,
    /// Its largest error.
    tolerance: Option<f64>,
    /// Keys of the run whose end is the reference.
    reference: Option<Table>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Variation {
    key: String,
    values: Vec<Value>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Named {
    name: String,
    #[serde(default)]
    set: Table,
    expected: Option<f64>,
    /// False if the short study leaves the case out.
    #[serde(default = "yes")]
    quick: bool,
}

fn yes() -> bool {
    true
}

/// Reads a study and its scenes. The short one leaves out the cases that say so.
///
/// # Errors
/// A sentence that names the file, the line or the key, and a remedy.
pub fn read<'a>(
    path: &Path,
    data: &Path,
    quick: bool,
    out: &Path,
    factory: &'a Factory<'a>,
) -> Result<Sweep<'a>, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}; name a .toml file", path.display()))?;
    let file: File = toml::from_str(&text).map_err(|error| {
        let line = error.span().map_or(1, |span| text[..span.start].matches('\n').count() + 1);
        format!("{}, line {line}: {}", path.display(), error.message())
    })?;
    let refuse = |problem: String| format!("{}: {problem}", path.display());
    let measure = measure(&file).map_err(refuse)?;
    let one = Named { name: String::new(), set: Table::new(), expected: None, quick: true };
    let cases = if file.case.is_empty() { vec![one] } else { file.case.clone() };
    let lists: Vec<&[Value]> = file.vary.iter().map(|variation| &variation.values[..]).collect();
    let mut scenes = Vec::new();
    for name in &file.scenes {
        let beside = path.parent().unwrap_or(Path::new("")).join(name);
        let name = if beside.is_file() { beside.to_string_lossy().into_owned() } else { name.clone() };
        for case in cases.iter().filter(|case| case.quick || !quick) {
            for values in combinations(&lists) {
                let varied = file.vary.iter().zip(&values).map(|(variation, value)| (variation.key.as_str(), value));
                let own: Vec<Override> = overrides(&file.set).chain(overrides(&case.set)).collect();
                let own: Vec<Override> =
                    own.into_iter().chain(varied.map(|(key, value)| Override::to(key, value))).collect();
                let load = |keys: &[Override]| load_with(&name, data, keys).map_err(|error| error.to_string());
                let reference = file
                    .reference
                    .as_ref()
                    .map(|keys| load(&own.iter().cloned().chain(overrides(keys)).collect::<Vec<_>>()));
                let expected = case.expected.or(file.expected).or(measure.as_ref().and_then(zero));
                scenes.push(SweptScene {
                    case: case.name.clone(),
                    scene: load(&own)?,
                    values: values.iter().map(written).collect(),
                    reference: reference.transpose()?,
                    expected: measure.as_ref().and(expected),
                });
            }
        }
    }
    if scenes.is_empty() {
        return Err(refuse("has no runs; give scenes, values, and cases that are not all `quick = false`".to_owned()));
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let arguments = ["study".to_owned(), path.display().to_string()];
    Ok(Sweep {
        title: file.title.unwrap_or_else(|| stem.clone()),
        name: stem,
        about: file.about,
        keys: file.vary.into_iter().map(|variation| variation.key).collect(),
        scenes,
        measure,
        arguments: arguments.into_iter().chain(quick.then(|| "--quick".to_owned())).collect(),
        out: out.to_owned(),
        factory,
    })
}

/// The quantity with its tolerance.
fn measure(file: &File) -> Result<Option<Measure>, String> {
    let Some(name) = &file.measure else {
        let keys = [("expected", file.expected.is_some()), ("tolerance", file.tolerance.is_some())];
        return match keys.into_iter().find(|(_, is_given)| *is_given) {
            Some((key, _)) => Err(format!("{key} needs `measure`, the result that is judged")),
            None => Ok(None),
        };
    };
    if quantity(name).is_none() {
        let names: Vec<&str> = QUANTITIES.iter().chain([&DISTANCE]).map(|(name, _)| *name).collect();
        return Err(format!("measure is \"{name}\"; give one of {}", names.join(", ")));
    }
    if name == DISTANCE.0 && file.reference.is_none() {
        return Err(
            "measure is \"distance\", which needs `reference`, the keys of the run it is measured from".to_owned()
        );
    }
    let is_judged = file.expected.is_some() || file.case.iter().any(|case| case.expected.is_some());
    let measure = Measure { quantity: name.clone(), tolerance: file.tolerance.unwrap_or(f64::INFINITY) };
    match file.tolerance {
        Some(tolerance) if !(tolerance >= 0.0) => Err(format!("tolerance is {tolerance}; give 0 or more")),
        None if is_judged => Err("expected needs `tolerance`, its largest error".to_owned()),
        Some(_) if !is_judged && zero(&measure).is_none() => {
            Err("tolerance needs `expected`, what the measured result must be".to_owned())
        }
        _ => Ok(Some(measure)),
    }
}

/// What a distance must be: zero within the tolerance, if there is one.
fn zero(measure: &Measure) -> Option<f64> {
    let is_distance = ["closed_form", DISTANCE.0].contains(&measure.quantity.as_str());
    (is_distance && measure.tolerance.is_finite()).then_some(0.0)
}

fn overrides(keys: &Table) -> impl Iterator<Item = Override> {
    keys.iter().map(|(key, value)| Override::to(key, value))
}

/// A value as tables show it: a text without its quotes.
fn written(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}
