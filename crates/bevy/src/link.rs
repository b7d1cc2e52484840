//! The way from an entity to its body on a worker thread.

/// Number of a body; a body that is built anew gets a new one, so that late news of the old one find no one.
pub type BodyId = u64;

/// A body on a worker thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Link {
    /// Number of the body.
    pub id: BodyId,
    /// Number of its thread.
    pub thread: usize,
}
