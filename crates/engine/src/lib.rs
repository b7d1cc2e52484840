//! Deformable solids by the finite element method: scene files, meshes, the loop and its counters.
//!
//! A scene file becomes a [`Scene`](scene::Scene), a pipeline turns that into a [`Simulation`](simulation::Simulation),
//! and whoever drives it (window, headless loop) sees nothing but that trait. A [`run`](simulate::run) ends in the files of
//! [`output`].

#![deny(missing_docs)]
#![allow(non_snake_case)] // J, F, C and D are the names that the mathematics and the course use

pub mod mesh;
pub mod output;
pub mod scene;
pub mod simulate;
pub mod simulation;
