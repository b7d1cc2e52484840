//! The window's loop: input, latest snapshot, panel, frame.

mod input;
mod tools;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use fem_model::simulation::{Shape, Simulation};
use kiss3d::glamx::{Vec2, Vec3};
use kiss3d::window::Window;

use crate::editing::editor::SceneEditor;
use crate::panel::{self, Panel, ViewState};
use crate::picture::camera::{Camera, View};
use crate::picture::files::{NotWritten, Picture, Recorder};
use crate::picture::frame::{Frame, Wanted};
use crate::picture::geometry::{Bounds, single};
use crate::picture::scene_view::{DisplayedSurface, SceneView, prepare};
use crate::picture::{legend, obstacles};
use crate::setup::Setup;
use crate::window::interaction::Interaction;
use crate::window::options::WindowOptions;
use crate::window::scene_changes::SceneChanges;
use crate::worker::{Command, LoopOptions, Snapshot, Worker};

const IDLE_INTERVAL: Duration = Duration::from_millis(15); // between polls for input while the picture does not change
const LONGEST_IDLE: Duration = Duration::from_secs(1); // after which a frame is drawn in any case
const WANDERED: f32 = 1.15; // growth of the box around body and view beyond which the camera moves back
const AFTER_INPUT: Duration = Duration::from_millis(500); // during which the panel may be animated

/// An open window with a running simulation.
pub struct Session {
    // The view holds resources of the window's graphics device, so it is dropped first.
    view: SceneView,
    window: Window,
    camera: Camera,
    view_kind: View,
    /// The box that the camera shows, as long as it moves back with a body that goes far.
    framed: Option<Bounds>,
    up: Vec3,
    shape: Arc<Shape>,
    worker: Worker,
    snapshot: Snapshot,
    wanted: Wanted,
    /// The picture that the body was made from is shown on it.
    shows_picture: bool,
    /// Pictures that the body can be made from.
    objects: Vec<PathBuf>,
    changes: SceneChanges,
    name: String,
    interaction: Interaction,
    setup: Setup,
    /// The surface that is shown again when the body is pulled.
    shown_before: DisplayedSurface,
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
    /// A session in a new window, with the body at rest, and the thread of its simulation.
    pub fn new(
        mut window: Window,
        simulation: Box<dyn Simulation>,
        loop_options: LoopOptions,
        recorder: Option<Recorder>,
        options: &WindowOptions,
    ) -> Self {
        let up = single(&options.up).try_normalize().unwrap_or(Vec3::Y);
        let (name, shape) = (simulation.name().to_owned(), simulation.shape());
        let frame = Frame::of(&*simulation, Wanted::default());
        let view_kind = View::of(&shape);
        prepare(&mut window, view_kind);
        let view = SceneView::new(&shape, &frame.planes, up);
        let framed = obstacles::arena(view.bounds(), &frame.planes);
        let camera = Camera::framing(view_kind, &framed, up, size(&window), covered(&window));
        let wanted = Wanted { field: options.color, contact_forces: true };
        let editor = options.editing.clone().map(|editing| SceneEditor::new(editing, options.up));
        let worker = Worker::start(simulation, loop_options, editor);
        worker.send(Command::Want(wanted));
        Session {
            framed: Some(framed),
            up,
            view,
            window,
            camera,
            view_kind,
            worker,
            snapshot: Snapshot { frame, ..Snapshot::default() },
            wanted,
            shows_picture: false,
            objects: options.editing.as_ref().map_or_else(Vec::new, |editing| editing.objects.clone()),
            changes: SceneChanges::default(),
            shape,
            name,
            interaction: Interaction::default(),
            setup: Setup::default(),
            shown_before: DisplayedSurface::default(),
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
            self.send_changes();
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

    /// Returns true if the next frame would equal the last one.
    fn is_idle(&self) -> bool {
        let is_building = self.changes.is_under_way(self.snapshot.changes);
        !is_building && self.last_input.elapsed() > AFTER_INPUT && self.last_frame.elapsed() < LONGEST_IDLE
    }

    fn read_snapshot(&mut self) -> bool {
        let Some(snapshot) = self.worker.latest() else { return false };
        let planes_before = self.snapshot.frame.planes.len();
        self.snapshot = snapshot;
        self.show_shape(planes_before);
        if let Some(scene) = self.snapshot.setup.as_ref().filter(|_| self.changes.is_done(self.snapshot.changes)) {
            self.setup.settle(&self.shape, scene);
        }
        let body = self.view.update(&self.snapshot.frame);
        self.keep_in_view(&body);
        true
    }

    /// Shows another body or other obstacles than before, if the user has changed the mesh or the planes.
    fn show_shape(&mut self, planes_before: usize) {
        let Some(shape) = &self.snapshot.shape else { return };
        if Arc::ptr_eq(shape, &self.shape) {
            return;
        }
        let is_same = **shape == *self.shape; // built anew on the same mesh
        self.shape = Arc::clone(shape);
        let (planes, shown) = (&self.snapshot.frame.planes, self.view.shown());
        if is_same && planes_before == planes.len() {
            return;
        }
        self.view = SceneView::new(&self.shape, planes, self.up);
        self.view.show(shown);
        self.view.show_picture(self.shows_picture);
        if is_same {
            return;
        }
        self.interaction.release(&self.worker);
        self.setup.forget_body();
        let framed = obstacles::arena(self.view.bounds(), planes);
        self.framed = Some(framed);
        self.camera = Camera::framing(self.view_kind, &framed, self.up, size(&self.window), covered(&self.window));
    }

    fn send_changes(&mut self) {
        if let Some(changes) = self.changes.take(self.snapshot.changes) {
            self.worker.send(Command::Change(changes));
        }
    }

    /// Moves the camera back if the body has left the picture, until the user moves the camera or the body.
    fn keep_in_view(&mut self, body: &Bounds) {
        let Some(framed) = self.framed else { return };
        let joined = framed.joined(body);
        if joined.radius() > WANDERED * framed.radius() {
            self.framed = Some(joined);
            let (size, covered) = (size(&self.window), covered(&self.window));
            self.camera = Camera::framing(self.view_kind, &joined, self.up, size, covered);
        }
    }

    /// Draws one frame; returns false if the window was closed.
    fn draw_frame(&mut self) -> bool {
        let begun = Instant::now();
        self.camera.resize(size(&self.window), covered(&self.window));
        self.draw_panel();
        self.draw_setup();
        self.view.draw_lines(&mut self.window, &self.snapshot.frame, &self.camera);
        self.interaction.draw(&mut self.window, &self.snapshot.frame.positions, &self.camera);
        let open = pollster::block_on(self.window.render_3d(&mut self.view.root, &mut self.camera));
        self.last_frame = Instant::now();
        let seconds = begun.elapsed().as_secs_f64();
        let share = if self.frame_seconds == 0.0 { 1.0 } else { 0.1 }; // a running mean
        self.frame_seconds += share * (seconds - self.frame_seconds);
        open
    }

    /// Draws what is set up by hand: painted nodes, picked faces, loads.
    fn draw_setup(&mut self) {
        let Session { window, setup, snapshot, shape, camera, view, .. } = self;
        let Some(scene) = &snapshot.setup else { return };
        let positions = &snapshot.frame.positions;
        view.highlight(setup.picked_triangles(shape), positions, camera);
        setup.draw(window, shape, scene, positions, camera);
    }

    fn draw_panel(&mut self) {
        let Session { window, panel, setup, snapshot, view, name, objects, shape, .. } = self;
        let state = ViewState {
            snapshot,
            name,
            objects,
            shown: view.shown(),
            has_skin: view.has_skin(),
            turns: self.camera.turns(),
            frame_seconds: self.frame_seconds,
            shape,
        };
        let scale = view.scale().copied();
        let mut requests = Vec::new();
        window.draw_ui(|context| {
            requests = panel.show(context, &state, setup);
            scale.iter().for_each(|scale| legend::show(context, scale));
        });
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
