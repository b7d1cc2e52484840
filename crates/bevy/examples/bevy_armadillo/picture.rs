//! A picture without a window, at a fixed time of the motion.

use std::path::PathBuf;
use std::time::Duration;

use bevy::app::ScheduleRunnerPlugin;
use bevy::camera::RenderTarget;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured, save_to_disk};
use bevy::time::TimeUpdateStrategy;
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use fem_bevy::{SoftBodyPhase, SoftBodyPlugin, SoftBodyState};

use crate::stage;

/// Time that the picture shows, s: the ear is pulled, and the donut has hit the plane.
const TIME: f64 = 0.3;

/// Frames in which the renderer compiles its shaders before the picture is taken.
const FRAMES_BEFORE: usize = 40;

/// Frames a second of the clock.
const FRAME_RATE: f64 = 60.0;

const SIZE: [u32; 2] = [800, 500];

#[derive(Resource)]
struct Picture {
    path: PathBuf,
    target: Handle<Image>,
    frames: usize,
    is_taken: bool,
}

/// Makes an app that draws into an image, writes it to `path`, and ends.
pub fn prepare(app: &mut App, path: PathBuf) {
    let window = WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
    app.add_plugins(DefaultPlugins.set(window).disable::<WinitPlugin>())
        .add_plugins(ScheduleRunnerPlugin::run_loop(Duration::from_millis(5)))
        .add_plugins(SoftBodyPlugin { most_lag: Duration::from_secs(60), ..default() })
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::ZERO))
        .add_systems(Startup, move |mut commands: Commands, mut images: ResMut<Assets<Image>>| {
            let target = images.add(Image::new_target_texture(SIZE[0], SIZE[1], TextureFormat::Rgba8UnormSrgb, None));
            commands.spawn((stage::camera(), RenderTarget::Image(target.clone().into())));
            commands.insert_resource(Picture { path: path.clone(), target, frames: 0, is_taken: false });
        })
        .add_systems(Update, (run_clock, take).chain());
}

/// Lets the clock run from when all bodies are built until the time of the picture.
fn run_clock(mut clock: ResMut<TimeUpdateStrategy>, bodies: Query<&SoftBodyState>) {
    let runs = bodies.iter().all(|body| body.phase() != SoftBodyPhase::Building && body.shown_time() < TIME);
    let frame = if runs && !bodies.is_empty() { 1.0 / FRAME_RATE } else { 0.0 };
    *clock = TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(frame));
}

/// Takes the picture when all bodies have come so far.
fn take(mut commands: Commands, mut picture: ResMut<Picture>, bodies: Query<&SoftBodyState>) {
    picture.frames += 1;
    let has_come = |body: &SoftBodyState| body.phase() == SoftBodyPhase::Failed || body.time() > TIME;
    if picture.is_taken || picture.frames < FRAMES_BEFORE || bodies.is_empty() || !bodies.iter().all(has_come) {
        return;
    }
    picture.is_taken = true;
    let mut save = save_to_disk(picture.path.clone());
    commands.spawn(Screenshot::image(picture.target.clone())).observe(
        move |captured: On<ScreenshotCaptured>, mut exit: MessageWriter<AppExit>| {
            save(captured);
            exit.write(AppExit::Success);
        },
    );
}
