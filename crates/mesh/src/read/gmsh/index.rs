//! From the tags of nodes, any integers, to their indices.

use std::collections::HashMap;

/// No node has this index: a mesh with 2³² nodes fits into no memory.
const NONE: u32 = u32::MAX;

/// A table for small tags, as most files have them, which is several times as fast as a map, and a map for others.
#[derive(Default)]
pub(super) struct Index {
    table: Vec<u32>,
    map: HashMap<i64, u32>,
    count: usize,
}

impl Index {
    /// Adds a tag. Returns false if it is known.
    pub(super) fn insert(&mut self, tag: i64, index: usize) -> bool {
        if self.get(tag).is_some() {
            return false;
        }
        self.count += 1;
        // Never larger than a few times the nodes so far.
        match usize::try_from(tag).ok().filter(|tag| *tag < 4 * self.count + 1024) {
            Some(tag) => {
                if self.table.len() <= tag {
                    self.table.resize(tag + 1, NONE);
                }
                self.table[tag] = index as u32;
            }
            None => drop(self.map.insert(tag, index as u32)),
        }
        true
    }

    pub(super) fn get(&self, tag: i64) -> Option<usize> {
        let in_table = usize::try_from(tag).ok().and_then(|tag| self.table.get(tag)).filter(|index| **index != NONE);
        in_table.or_else(|| self.map.get(&tag)).map(|index| *index as usize)
    }
}
