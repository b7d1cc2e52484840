//! Changes of the scene on their way to the simulation's thread.

use crate::editing::change::Change;

/// Changes that wait until those before are done: a slider gives more values than scenes can be built.
#[derive(Default)]
pub struct SceneChanges {
    waiting: Vec<Change>,
    /// Number of times that changes were sent.
    sent: usize,
}

impl SceneChanges {
    /// Adds a change, in place of an earlier one of the same parameter.
    pub fn add(&mut self, change: Change) {
        self.waiting.retain(|earlier| !earlier.is_replaced_by(&change));
        self.waiting.push(change);
    }

    /// The changes to send now, if some wait and those that were sent before are done; `done` is how often the simulation has answered.
    pub fn take(&mut self, done: usize) -> Option<Vec<Change>> {
        if self.waiting.is_empty() || self.is_under_way(done) {
            return None;
        }
        self.sent += 1;
        Some(std::mem::take(&mut self.waiting))
    }

    /// Returns true if no change waits or is under way.
    pub fn is_done(&self, done: usize) -> bool {
        self.waiting.is_empty() && !self.is_under_way(done)
    }

    /// Returns true if changes that were sent are not yet done.
    pub fn is_under_way(&self, done: usize) -> bool {
        self.sent != done
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_latest_value_of_each_parameter_waits_until_earlier_changes_are_done() {
        let mut changes = SceneChanges::default();
        changes.add(Change::Number("mu", 1.0));
        assert_eq!(changes.take(0), Some(vec![Change::Number("mu", 1.0)]));
        for value in [2.0, 3.0] {
            changes.add(Change::Number("mu", value));
            changes.add(Change::Number("density", value));
        }
        changes.add(Change::Object("bunny.png".into()));
        changes.add(Change::Object("donut.png".into()));
        assert!(changes.is_under_way(0) && changes.take(0).is_none());
        let all =
            [Change::Number("mu", 3.0), Change::Number("density", 3.0), Change::Object("donut.png".into())].to_vec();
        assert_eq!(changes.take(1), Some(all));
        assert_eq!(changes.take(2), None);
    }
}
