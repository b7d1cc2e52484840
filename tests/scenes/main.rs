//! The scenes: each shipped one runs, moves by the laws of mechanics, and writes files that other programs can read; unusable
//! arguments, scenes and meshes are refused with one message.
//!
//! `cargo test --no-default-features --features engine --test scenes` runs them without the window.

#![allow(non_snake_case)] // V, T, F, J, C and D are the names that the mathematics and the course use

mod agreement;
mod bad_arguments;
mod bad_meshes;
mod bad_scenes;
mod batch;
mod driving;
mod energies;
mod experiments;
mod exports;
mod flags;
mod freedom;
mod lesson;
mod mesh_command;
mod mesh_files;
mod mesh_refusals;
mod mesh_shapes;
mod momentum;
mod one_step;
mod own_studies;
mod plasticity;
mod probes;
mod program;
mod pulling;
mod reference;
mod resumed;
mod scene_text;
#[cfg(feature = "viewer")]
mod set_up;
mod shipped;
#[cfg(unix)]
mod signals;
mod skinning;
mod statistics;
mod untrusted;
mod unusual;
