//! Parts of a study that run apart.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// The K-th of N parts of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// From 1 to `of`.
    pub number: usize,
    /// Number of shards.
    pub of: usize,
}

impl Shard {
    /// The whole study.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Returns true if a case belongs to the shard. Neighbouring cases, which often take as long, belong to different ones.
    pub(super) fn has(self, case: usize) -> bool {
        case % self.of == self.number - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((number, of)) if (1..=of).contains(&number) => Ok(Self { number, of }),
            _ => Err("give K/N, the K-th of N shards, such as 2/8".to_owned()),
        }
    }
}
