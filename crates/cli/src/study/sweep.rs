//! `report --sweep KEY=VALUE,VALUE`: a scene with its own method for each combination of values, as a table and a page.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use fem_scene::{Override, Scene, load_with};
use fem_study::sweep::{self, SweptScene, combinations};

use super::Distribution;
use crate::course::Course;
use crate::end::End;

/// A key of a scene and its values.
#[derive(Clone, Debug)]
pub struct Sweep {
    key: String,
    values: Vec<Override>,
    text: String,
}

impl FromStr for Sweep {
    type Err = String;

    /// Reads `KEY=VALUE,VALUE`. Commas within brackets belong to a value.
    fn from_str(text: &str) -> Result<Self, String> {
        let (key, list) = text.split_once('=').ok_or("give KEY=VALUE,VALUE, such as material.young=1e4,1e5")?;
        let mut depth = 0;
        let values = list.split(|c: char| {
            depth += i32::from(c == '[') - i32::from(c == ']');
            c == ',' && depth == 0
        });
        let values = values.map(|value| format!("{key}={}", value.trim()).parse()).collect::<Result<_, _>>()?;
        Ok(Self { key: key.to_owned(), values, text: text.to_owned() })
    }
}

impl fmt::Display for Sweep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// Runs every combination of values, writes `sweep.csv`, `sweep.html` and the states at the ends. Failed runs are rows as well.
///
/// All scenes are read before the first run, so that an error ends the sweep at once.
pub fn run(
    course: &Course,
    names: &[String],
    sweeps: &[Sweep],
    out: PathBuf,
    distribution: Distribution,
    merged: &[PathBuf],
) -> Result<(), End> {
    let lists: Vec<&[Override]> = sweeps.iter().map(|sweep| &sweep.values[..]).collect();
    let mut scenes = Vec::new();
    for name in names {
        for values in combinations(&lists) {
            let scene = load_with(name, &course.data(), &values).map_err(End::unusable)?;
            let values = values.iter().map(|value| value_of(&value.to_string()).to_owned()).collect();
            scenes.push(SweptScene { case: String::new(), scene, values, reference: None, expected: None });
        }
    }
    let keys: Vec<String> = sweeps.iter().map(|sweep| sweep.key.clone()).collect();
    let flags = sweeps.iter().flat_map(|sweep| ["--sweep".to_owned(), sweep.to_string()]);
    let factory = |scene: &Scene| super::simulation(course, scene);
    let study = sweep::Sweep {
        name: "sweep".to_owned(),
        title: format!("Sweep over {}", keys.join(", ")),
        about: String::new(),
        keys,
        scenes,
        measure: None,
        arguments: ["report".to_owned()].into_iter().chain(names.iter().cloned()).chain(flags).collect(),
        out,
        factory: &factory,
    };
    super::end_of(course, &study, &study.out, distribution, merged)
}

/// The value of `KEY=VALUE`.
fn value_of(text: &str) -> &str {
    text.split_once('=').map_or(text, |(_, value)| value)
}
