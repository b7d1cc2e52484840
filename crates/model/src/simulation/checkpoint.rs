//! The complete state of a simulation, from which it goes on as if it had not been interrupted.

use std::collections::BTreeMap;
use std::fmt;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The complete state of a simulation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoint {
    /// Seconds since the start.
    pub time: f64,
    /// Steps since the start.
    pub steps: usize,
    /// `q  (3n)` positions of all nodes, m.
    pub positions: Vec<f64>,
    /// `qdot  (3n)` velocities of all nodes, m/s.
    pub velocities: Vec<f64>,
    /// Displacements of all nodes, m, from which the engine computes: positions have lost digits. Empty for a pipeline that computes
    /// from positions.
    pub displacements: Vec<f64>,
    /// Numbers that integrator and solver keep from step to step.
    pub history: History,
}

/// Numbers that integrator and solver keep from step to step, by name.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct History(BTreeMap<String, Packed>);

impl History {
    /// Adds an array.
    pub fn put(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        self.0.insert(name.to_owned(), Packed(values.into_iter().collect()));
    }

    /// An array by its name; an error if it is missing.
    pub fn get(&self, name: &str) -> Result<&[f64], String> {
        let found = self.0.get(name).map(|packed| &packed.0[..]);
        found.ok_or_else(|| format!("its history has no `{name}`"))
    }
}

/// Numbers that a file holds exactly: little-endian bytes in base64, four each where single precision holds all of them.
#[derive(Clone, Debug, PartialEq)]
struct Packed(Vec<f64>);

const SINGLE: &str = "f32:";
const DOUBLE: &str = "f64:";

impl Serialize for Packed {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let is_single = |x: &f64| f64::from(*x as f32).to_bits() == x.to_bits();
        let text = if self.0.iter().all(is_single) {
            let bytes: Vec<u8> = self.0.iter().flat_map(|&x| (x as f32).to_le_bytes()).collect();
            format!("{SINGLE}{}", BASE64.encode(bytes))
        } else {
            let bytes: Vec<u8> = self.0.iter().flat_map(|x| x.to_le_bytes()).collect();
            format!("{DOUBLE}{}", BASE64.encode(bytes))
        };
        serializer.serialize_str(&text)
    }
}

impl<'de> Deserialize<'de> for Packed {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_str(PackedText)
    }
}

/// Reads packed numbers from a text without a copy of it.
struct PackedText;

impl Visitor<'_> for PackedText {
    type Value = Packed;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("an array of the history")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Packed, E> {
        let values = match (text.strip_prefix(SINGLE), text.strip_prefix(DOUBLE)) {
            (Some(single), _) => numbers(single, |bytes| f64::from(f32::from_le_bytes(bytes))),
            (_, Some(double)) => numbers(double, f64::from_le_bytes),
            (None, None) => None,
        };
        let values = values.filter(|values| values.iter().all(|x| x.is_finite()));
        values.map(Packed).ok_or_else(|| E::custom("an array of the history is damaged"))
    }
}

/// The numbers of a text; `None` if it is no base64, or if a number is cut off.
fn numbers<const N: usize>(text: &str, number: impl Fn([u8; N]) -> f64) -> Option<Vec<f64>> {
    let bytes = BASE64.decode(text).ok()?;
    let (whole, rest) = bytes.as_chunks::<N>();
    rest.is_empty().then(|| whole.iter().map(|&bytes| number(bytes)).collect())
}
