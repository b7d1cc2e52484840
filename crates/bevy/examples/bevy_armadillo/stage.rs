//! Camera and light.

use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::prelude::*;

/// The camera, whatever it draws on.
pub fn camera() -> impl Bundle {
    (
        Camera3d::default(),
        // The default needs tables that this example is built without.
        Tonemapping::Reinhard,
        // Dithered pictures hardly pack.
        DebandDither::Disabled,
        Transform::from_xyz(0.7, 0.95, 2.1).looking_at(Vec3::new(0.42, 0.5, 0.0), Vec3::Y),
        AmbientLight { brightness: 300.0, ..default() },
    )
}

/// Spawns the camera of the window.
pub fn open_window(mut commands: Commands) {
    commands.spawn(camera());
}

/// Spawns the sun, and the colour of the sky.
pub fn light(mut commands: Commands) {
    let sun = DirectionalLight { illuminance: 9000.0, shadow_maps_enabled: true, ..default() };
    commands.insert_resource(ClearColor(Color::srgb(0.75, 0.82, 0.9)));
    commands.spawn((sun, Transform::from_xyz(1.5, 4.0, 2.5).looking_at(Vec3::ZERO, Vec3::Y)));
}
