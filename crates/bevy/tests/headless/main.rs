//! The plugin in apps without a window, with a clock that the tests set.

mod app;
mod bad_input;
mod failure;
mod lifetime;
mod positions;
mod pulling;
