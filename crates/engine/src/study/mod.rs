//! Studies of the engine itself: how large an error is for how much time, and what the pages show that tell of it.
//!
//! Charts ([`svg`]) and pages ([`page`]) know nothing of what they show.

pub mod page;
pub mod svg;
