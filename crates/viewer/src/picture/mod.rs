//! Pictures of a state: the camera, the surfaces and their colours, obstacles and forces, files.

pub mod camera;
pub mod color_scale;
pub mod display;
pub mod files;
pub mod frame;
pub mod geometry;
pub mod legend;
pub mod numbers;
pub mod obstacles;
pub mod offscreen;
mod paint;
pub mod scene_view;
mod shader;
mod surface;
mod texture;
pub mod theme;
