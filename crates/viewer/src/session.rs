//! The window's loop: input, latest snapshot, panel, frame.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use fem_scene::simulation::Shape;
use kiss3d::camera::Camera3d;
use kiss3d::egui::pos2;
use kiss3d::event::{Action, Key, Modifiers, MouseButton, WindowEvent};
use kiss3d::glamx::{Vec2, Vec3};
use kiss3d::window::Window;

use crate::camera::OrbitCamera;
use crate::geometry::{Bounds, single};
use crate::interaction::Interaction;
use crate::options::WindowOptions;
use crate::panel::{self, Panel, UserRequest, ViewState};
use crate::pictures::{NotWritten, Picture, Recorder};
use crate::scene_view::{DisplayedSurface, SceneView, prepare};
use crate::worker::{Command, Snapshot, Worker};

const IDLE_INTERVAL: Duration = Duration::from_millis(15); // between polls for input while the picture does not change
const LONGEST_IDLE: Duration = Duration::from_secs(1); // after which a frame is drawn in any case
const WANDERED: f32 = 1.15; // growth of the box around body and view beyond which the camera moves back
const AFTER_INPUT: Duration = Duration::from_millis(500); // during which the panel may be animated

/// An open window with a running simulation.
pub struct Session {
    // The view holds resources of the window's graphics device, so it is dropped first.
    view: SceneView,
    window: Window,
    camera: OrbitCamera,
    /// The box that the camera shows, as long as it moves back with a body that goes far.
    framed: Option<Bounds>,
    up: Vec3,
    worker: Worker,
    snapshot: Snapshot,
    name: String,
    interaction: Interaction,
    panel: Panel,
    cursor: Vec2,
    frame_seconds: f64,
    last_input: Instant,
    last_frame: Instant,
    recorder: Option<Recorder>,
    screenshot: Option<PathBuf>,
    closes_at_the_end: bool,
    not_written: Option<NotWritten>,
    closing: bool,
    close: Arc<AtomicUsize>,
}

impl Session {
    /// A session in a new window, with the body at rest.
    pub fn new(
        mut window: Window,
        worker: Worker,
        name: String,
        shape: &Shape,
        recorder: Option<Recorder>,
        options: &WindowOptions,
    ) -> Self {
        let up = single(&options.up).try_normalize().unwrap_or(Vec3::Y);
        let view = SceneView::new(shape, up);
        prepare(&mut window);
        let camera = OrbitCamera::framing(view.bounds(), up, size(&window), covered(&window));
        Session {
            framed: Some(*view.bounds()),
            up,
            view,
            window,
            camera,
            worker,
            snapshot: Snapshot::default(),
            name,
            interaction: Interaction::default(),
            panel: Panel::default(),
            cursor: Vec2::ZERO,
            frame_seconds: 0.0,
            last_input: Instant::now(),
            last_frame: Instant::now(),
            recorder,
            screenshot: options.screenshot.clone(),
            closes_at_the_end: options.quit_after_steps.is_some(),
            not_written: None,
            closing: false,
            close: Arc::clone(&options.close),
        }
    }

    /// Runs until the window is closed, and returns the simulation's thread.
    pub fn run(mut self) -> (Worker, Option<NotWritten>) {
        while !self.closing && self.close.load(Ordering::Relaxed) == 0 {
            self.read_input();
            let fresh = self.read_snapshot();
            if !fresh && self.is_idle() {
                self.window.canvas_mut().poll_events();
                std::thread::sleep(IDLE_INTERVAL);
                continue;
            }
            let open = self.draw_frame();
            if fresh {
                self.record();
            }
            let ended = self.snapshot.finished || self.snapshot.stop.is_some();
            self.closing |= !open || (fresh && ended && self.closes_at_the_end);
        }
        self.take_screenshot();
        (self.worker, self.not_written)
    }

    /// Whether the next frame would equal the last one.
    fn is_idle(&self) -> bool {
        self.last_input.elapsed() > AFTER_INPUT && self.last_frame.elapsed() < LONGEST_IDLE
    }

    fn read_snapshot(&mut self) -> bool {
        let Some(snapshot) = self.worker.latest() else { return false };
        self.snapshot = snapshot;
        let body = self.view.update(&self.snapshot.positions, &self.snapshot.display);
        self.keep_in_view(&body);
        true
    }

    /// Moves the camera back if the body has left the picture, until the user moves the camera or the body.
    fn keep_in_view(&mut self, body: &Bounds) {
        let Some(framed) = self.framed else { return };
        let joined = framed.joined(body);
        if joined.radius() > WANDERED * framed.radius() {
            self.framed = Some(joined);
            self.camera = OrbitCamera::framing(&joined, self.up, size(&self.window), covered(&self.window));
        }
    }

    fn read_input(&mut self) {
        let events: Vec<WindowEvent> = self.window.events().iter().map(|event| event.value).collect();
        if !events.is_empty() {
            self.last_input = Instant::now();
        }
        for event in events {
            match event {
                WindowEvent::Key(key, Action::Press, _) => self.key(key),
                WindowEvent::MouseButton(button, Action::Press, modifiers) => self.press(button, modifiers),
                WindowEvent::MouseButton(_, Action::Release, _) => self.interaction.release(&self.worker),
                WindowEvent::CursorPos(x, y, _) => self.move_cursor(Vec2::new(x as f32, y as f32)),
                WindowEvent::Scroll(_, amount, _) if !self.is_on_panel() => {
                    self.framed = None;
                    self.camera.zoom(notches(amount));
                }
                _ => {}
            }
        }
        self.interaction.poll_pick(self.cursor, &mut self.camera, &self.worker);
    }

    fn key(&mut self, key: Key) {
        if self.window.is_egui_capturing_keyboard() {
            return; // a number is being typed
        }
        match key {
            Key::S => self.apply(UserRequest::NextSurface),
            Key::N => self.apply(UserRequest::NextIntegrator),
            Key::R => self.apply(UserRequest::Reset),
            Key::Space => self.apply(UserRequest::TogglePause),
            Key::Escape => self.closing = true,
            _ => {}
        }
    }

    fn press(&mut self, button: MouseButton, modifiers: Modifiers) {
        if self.is_on_panel() {
            return;
        }
        self.framed = None;
        // A mouse without a middle button moves the camera with shift.
        let button = if modifiers.contains(Modifiers::Shift) { MouseButton::Button3 } else { button };
        let (eye, ray) = (self.camera.eye(), self.camera.ray(self.cursor));
        let hit = self.view.hit(eye, ray, &self.snapshot.positions, &self.snapshot.display);
        let grip = hit.map(|distance| eye + ray * distance);
        self.interaction.press(button, self.cursor, grip, &self.camera, &self.worker);
    }

    fn move_cursor(&mut self, cursor: Vec2) {
        let motion = cursor - self.cursor;
        self.cursor = cursor;
        let scale = self.window.scale_factor() as f32;
        self.interaction.moved(cursor, motion, scale, &mut self.camera, &self.worker);
    }

    fn is_on_panel(&self) -> bool {
        let logical = self.cursor / self.window.scale_factor() as f32;
        self.panel.covers(pos2(logical.x, logical.y)) || self.window.is_egui_capturing_mouse()
    }

    fn apply(&mut self, request: UserRequest) {
        match request {
            UserRequest::TogglePause => self.worker.send(Command::TogglePause),
            UserRequest::Reset => self.worker.send(Command::Reset),
            UserRequest::NextIntegrator => self.worker.send(Command::NextIntegrator),
            UserRequest::Set(key, value) => self.worker.send(Command::Set(key, value)),
            UserRequest::NextSurface => {
                let other = match self.view.shown() {
                    DisplayedSurface::Skinned => DisplayedSurface::SimulationMesh,
                    DisplayedSurface::SimulationMesh => DisplayedSurface::Skinned,
                };
                self.view.show(other);
                self.view.update(&self.snapshot.positions, &self.snapshot.display);
            }
        }
    }

    /// Draws one frame; returns false if the window was closed.
    fn draw_frame(&mut self) -> bool {
        let begun = Instant::now();
        self.camera.resize(size(&self.window), covered(&self.window));
        self.draw_panel();
        let eye = self.camera.eye();
        self.view.draw_edges(&mut self.window, &self.snapshot.positions, eye);
        self.interaction.draw(&mut self.window, &self.snapshot.positions, eye);
        let open = pollster::block_on(self.window.render_3d(&mut self.view.root, &mut self.camera));
        self.last_frame = Instant::now();
        let seconds = begun.elapsed().as_secs_f64();
        let share = if self.frame_seconds == 0.0 { 1.0 } else { 0.1 }; // a running mean
        self.frame_seconds += share * (seconds - self.frame_seconds);
        open
    }

    fn draw_panel(&mut self) {
        let Session { window, panel, snapshot, view, name, .. } = self;
        let state =
            ViewState { name, shown: view.shown(), has_skin: view.has_skin(), frame_seconds: self.frame_seconds };
        let mut requests = Vec::new();
        window.draw_ui(|context| requests = panel.show(context, snapshot, &state));
        for request in requests {
            self.apply(request);
        }
    }

    /// Records the frame that was drawn and lets the simulation, which waits for this, go on.
    fn record(&mut self) {
        let Some(recorder) = &mut self.recorder else { return };
        if recorder.due(self.snapshot.time) {
            let picture = Picture::new(self.window.snap_image());
            if let Err(error) = recorder.frame(&picture) {
                self.not_written = Some(error);
                self.closing = true;
            }
        }
        self.worker.send(Command::NextFrame);
    }

    fn take_screenshot(&mut self) {
        let Some(path) = &self.screenshot else { return };
        let picture = Picture::new(self.window.snap_image());
        self.not_written = picture.save(path).err().or(self.not_written.take());
    }
}

/// Width and height of the window in physical pixels.
fn size(window: &Window) -> Vec2 {
    Vec2::new(window.width() as f32, window.height() as f32)
}

/// Width that the panel covers at the left, physical pixels; zero if the window is too narrow to centre the body beside it.
fn covered(window: &Window) -> f32 {
    let width = panel::WIDTH * window.scale_factor() as f32;
    if size(window).x > 2.0 * width { width } else { 0.0 }
}

/// Notches of a mouse wheel; touch pads send many small amounts.
fn notches(amount: f64) -> f32 {
    (amount as f32 / 10.0).clamp(-3.0, 3.0)
}
