//! The window's loop: input, snapshot, panel, frame.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use fem_scene::simulation::Shape;
use kiss3d::camera::Camera3d;
use kiss3d::egui::pos2;
use kiss3d::event::{Action, Key, Modifiers, MouseButton, WindowEvent};
use kiss3d::glamx::{Vec2, Vec3};
use kiss3d::window::Window;

use crate::camera::OrbitCamera;
use crate::geometry::single;
use crate::hand::Hand;
use crate::panel::{self, Facts, Panel, Wish};
use crate::pictures::{NotWritten, Photograph, Recorder};
use crate::stage::{Shown, Stage, prepare};
use crate::window::WindowOptions;
use crate::worker::{Command, Snapshot, Worker};

const REST: Duration = Duration::from_millis(15); // between looks for input while nothing moves
const LONGEST_REST: Duration = Duration::from_secs(1); // then a frame is drawn all the same
const AFTER_INPUT: Duration = Duration::from_millis(500); // in which the panel may still fade or glide

/// An open window with a running simulation.
pub struct Session {
    // The stage lies on the graphics card that goes with the window: it is dropped first.
    stage: Stage,
    window: Window,
    camera: OrbitCamera,
    worker: Worker,
    snapshot: Snapshot,
    name: String,
    hand: Hand,
    panel: Panel,
    cursor: Vec2,
    frame_seconds: f64,
    last_input: Instant,
    last_frame: Instant,
    recorder: Option<Recorder>,
    screenshot: Option<PathBuf>,
    quits_by_itself: bool,
    not_written: Option<NotWritten>,
    closing: bool,
}

impl Session {
    /// Sets the stage in a new window.
    pub fn new(
        mut window: Window,
        worker: Worker,
        name: String,
        shape: &Shape,
        recorder: Option<Recorder>,
        options: &WindowOptions,
    ) -> Self {
        let up = single(&options.up).try_normalize().unwrap_or(Vec3::Y);
        let stage = Stage::new(shape, up);
        prepare(&mut window);
        let camera = OrbitCamera::framing(stage.bounds(), up, size(&window), covered(&window));
        Session {
            stage,
            window,
            camera,
            worker,
            snapshot: Snapshot::default(),
            name,
            hand: Hand::default(),
            panel: Panel::default(),
            cursor: Vec2::ZERO,
            frame_seconds: 0.0,
            last_input: Instant::now(),
            last_frame: Instant::now(),
            recorder,
            screenshot: options.screenshot.clone(),
            quits_by_itself: options.quit_after_steps.is_some(),
            not_written: None,
            closing: false,
        }
    }

    /// Runs until the window is closed, and gives back the simulation's thread.
    pub fn until_closed(mut self) -> (Worker, Option<NotWritten>) {
        while !self.closing {
            self.read_input();
            let fresh = self.read_snapshot();
            if !fresh && self.may_rest() {
                self.window.canvas_mut().poll_events();
                std::thread::sleep(REST);
                continue;
            }
            let open = self.draw_frame();
            if fresh {
                self.record();
            }
            let done = self.snapshot.finished || self.snapshot.stop.is_some();
            self.closing |= !open || (fresh && done && self.quits_by_itself);
        }
        self.take_screenshot();
        (self.worker, self.not_written)
    }

    /// Whether a frame would look like the last one.
    fn may_rest(&self) -> bool {
        self.last_input.elapsed() > AFTER_INPUT && self.last_frame.elapsed() < LONGEST_REST
    }

    fn read_snapshot(&mut self) -> bool {
        let Some(snapshot) = self.worker.latest() else { return false };
        self.snapshot = snapshot;
        self.stage.place(&self.snapshot.positions, &self.snapshot.display);
        true
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
                WindowEvent::MouseButton(_, Action::Release, _) => self.hand.release(&self.worker),
                WindowEvent::CursorPos(x, y, _) => self.move_cursor(Vec2::new(x as f32, y as f32)),
                WindowEvent::Scroll(_, amount, _) if !self.is_on_panel() => self.camera.zoom(notches(amount)),
                _ => {}
            }
        }
        self.hand.listen(self.cursor, &mut self.camera, &self.worker);
    }

    fn key(&mut self, key: Key) {
        if self.window.is_egui_capturing_keyboard() {
            return; // somebody types a number
        }
        match key {
            Key::S => self.grant(Wish::NextSurface),
            Key::N => self.grant(Wish::NextIntegrator),
            Key::R => self.grant(Wish::Reset),
            Key::Space => self.grant(Wish::TogglePause),
            Key::Escape => self.closing = true,
            _ => {}
        }
    }

    fn press(&mut self, button: MouseButton, modifiers: Modifiers) {
        if self.is_on_panel() {
            return;
        }
        // A mouse without a middle button moves the camera with shift.
        let button = if modifiers.contains(Modifiers::Shift) { MouseButton::Button3 } else { button };
        let (eye, ray) = (self.camera.eye(), self.camera.ray(self.cursor));
        let hit = self.stage.hit(eye, ray, &self.snapshot.positions, &self.snapshot.display);
        let grip = hit.map(|distance| eye + ray * distance);
        self.hand.press(button, self.cursor, grip, &self.camera, &self.worker);
    }

    fn move_cursor(&mut self, cursor: Vec2) {
        let motion = cursor - self.cursor;
        self.cursor = cursor;
        let scale = self.window.scale_factor() as f32;
        self.hand.moved(cursor, motion, scale, &mut self.camera, &self.worker);
    }

    fn is_on_panel(&self) -> bool {
        let logical = self.cursor / self.window.scale_factor() as f32;
        self.panel.covers(pos2(logical.x, logical.y)) || self.window.is_egui_capturing_mouse()
    }

    fn grant(&mut self, wish: Wish) {
        match wish {
            Wish::TogglePause => self.worker.send(Command::TogglePause),
            Wish::Reset => self.worker.send(Command::Reset),
            Wish::NextIntegrator => self.worker.send(Command::NextIntegrator),
            Wish::Set(key, value) => self.worker.send(Command::Set(key, value)),
            Wish::NextSurface => {
                let other = match self.stage.shown() {
                    Shown::Skinned => Shown::SimulationMesh,
                    Shown::SimulationMesh => Shown::Skinned,
                };
                self.stage.show(other);
                self.stage.place(&self.snapshot.positions, &self.snapshot.display);
            }
        }
    }

    /// Draws one frame; false when the window was closed.
    fn draw_frame(&mut self) -> bool {
        let begun = Instant::now();
        self.camera.resize(size(&self.window), covered(&self.window));
        self.draw_panel();
        let eye = self.camera.eye();
        self.stage.draw_edges(&mut self.window, &self.snapshot.positions, eye);
        self.hand.draw(&mut self.window, &self.snapshot.positions, eye);
        let open = pollster::block_on(self.window.render_3d(&mut self.stage.root, &mut self.camera));
        self.last_frame = Instant::now();
        let seconds = begun.elapsed().as_secs_f64();
        let share = if self.frame_seconds == 0.0 { 1.0 } else { 0.1 }; // a running mean
        self.frame_seconds += share * (seconds - self.frame_seconds);
        open
    }

    fn draw_panel(&mut self) {
        let Session { window, panel, snapshot, stage, name, .. } = self;
        let facts = Facts { name, shown: stage.shown(), has_skin: stage.has_skin(), frame_seconds: self.frame_seconds };
        let mut wishes = Vec::new();
        window.draw_ui(|context| wishes = panel.show(context, snapshot, &facts));
        for wish in wishes {
            self.grant(wish);
        }
    }

    /// Records the frame that was drawn. The simulation waits for this, and then goes on.
    fn record(&mut self) {
        let Some(recorder) = &mut self.recorder else { return };
        if recorder.due(self.snapshot.time) {
            let photograph = Photograph::new(self.window.snap_image());
            if let Err(error) = recorder.frame(&photograph) {
                self.not_written = Some(error);
                self.closing = true;
            }
        }
        self.worker.send(Command::NextFrame);
    }

    fn take_screenshot(&mut self) {
        let Some(path) = &self.screenshot else { return };
        let photograph = Photograph::new(self.window.snap_image());
        self.not_written = photograph.save(path).err().or(self.not_written.take());
    }
}

/// Width and height of the window, physical pixels.
fn size(window: &Window) -> Vec2 {
    Vec2::new(window.width() as f32, window.height() as f32)
}

/// Physical pixels at the left that the panel covers; none where the window is too narrow to make room for it.
fn covered(window: &Window) -> f32 {
    let width = panel::WIDTH * window.scale_factor() as f32;
    if size(window).x > 2.0 * width { width } else { 0.0 }
}

/// Notches of a mouse wheel; touch pads send many small amounts.
fn notches(amount: f64) -> f32 {
    (amount as f32 / 10.0).clamp(-3.0, 3.0)
}
