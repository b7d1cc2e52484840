//! The identity of a run: its scene, mesh, method and parameters. A state file belongs to one identity.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use toml::Value;

use crate::Scene;
use fem_model::simulation::{Shape, Simulation};

/// Keys of a scene, properties of its mesh and parameters of its simulation, with their values as text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Identity(BTreeMap<String, String>);

/// Keys without an effect on a step. Meshes are compared by what is in them.
const IRRELEVANT: [&str; 5] = ["about", "mesh.display", "mesh.file", "mesh.files", "time.steps"];

/// Largest number of differences in a message.
const MOST: usize = 5;

impl Identity {
    /// The identity of a simulation of a scene, with the integrator and the parameters that it has now.
    pub(crate) fn of(scene: &Scene, simulation: &dyn Simulation) -> Self {
        let mut values = BTreeMap::new();
        for (key, value) in &scene.source {
            add(key, value, &mut values);
        }
        values.retain(|key, _| !IRRELEVANT.contains(&key.as_str()));
        let shape = simulation.shape();
        let mut set = |key: &str, value: String| values.insert(key.to_owned(), value);
        set("time.integrator", simulation.integrator().to_owned());
        set("time.dt", number(simulation.dt()));
        set("number of nodes", shape.mesh.vertices().len().to_string());
        set("number of elements", shape.mesh.elements().to_string());
        set("fingerprint of the mesh", format!("{:016x}", fingerprint(&shape)));
        for parameter in simulation.parameters() {
            set(&format!("parameter {}", parameter.key), number(parameter.value));
        }
        Self(values)
    }

    /// The keys whose values differ, with both values; `None` without a difference.
    pub(crate) fn difference(&self, now: &Self) -> Option<String> {
        let keys: BTreeSet<&String> = self.0.keys().chain(now.0.keys()).collect();
        let value = |identity: &Self, key: &String| identity.0.get(key).map_or("not given".to_owned(), String::clone);
        let differences = keys.into_iter().filter(|key| self.0.get(*key) != now.0.get(*key));
        let texts: Vec<_> = differences
            .map(|key| format!("{key} is {} in the file and {} now", value(self, key), value(now, key)))
            .collect();
        let more = texts.len().saturating_sub(MOST);
        let end = if more > 0 { format!(", and {more} more") } else { String::new() };
        (!texts.is_empty()).then(|| texts[..texts.len() - more].join(", ") + &end)
    }
}

/// Adds a value with its key; tables and their arrays key by key.
fn add(key: &str, value: &Value, values: &mut BTreeMap<String, String>) {
    match value {
        Value::Table(table) => table.iter().for_each(|(name, value)| add(&format!("{key}.{name}"), value, values)),
        Value::Array(entries) if entries.iter().any(Value::is_table) => {
            entries.iter().enumerate().for_each(|(place, value)| add(&format!("{key}[{place}]"), value, values));
        }
        value => drop(values.insert(key.to_owned(), text(value))),
    }
}

/// The value as text; an integer as the number that it is read as.
fn text(value: &Value) -> String {
    match value {
        Value::Integer(integer) => number(*integer as f64),
        Value::Float(float) => number(*float),
        Value::String(text) => text.clone(),
        Value::Array(entries) => format!("[{}]", entries.iter().map(text).collect::<Vec<_>>().join(", ")),
        Value::Boolean(_) | Value::Datetime(_) | Value::Table(_) => value.to_string(),
    }
}

fn number(value: f64) -> String {
    format!("{value:?}")
}

/// A hash of nodes, elements and sets: FNV-1a, which no version of Rust changes.
fn fingerprint(shape: &Shape) -> u64 {
    let coordinates = shape.mesh.vertices().iter().flat_map(|x| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>());
    let corners = shape.mesh.corners().flatten().map(|&node| node as u64);
    let sets = shape.mesh.sets().values().flat_map(|set| shape.mesh.nodes_of_set(set)).map(|node| node as u64);
    let bytes = coordinates.chain(corners).chain(sets).flat_map(u64::to_le_bytes);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
