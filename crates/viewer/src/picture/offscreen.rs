//! Offscreen rendering: pictures without a window or a display server.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

use fem_model::simulation::{Shape, Simulation};
use fem_output::ElementField;
use kiss3d::glamx::{Vec2, Vec3};
use kiss3d::window::{CanvasSetup, NumSamples, OffscreenSurface};
use nalgebra::Vector3;
use thiserror::Error;

use super::camera::{Camera, View};
use super::display::{adapter_available, without_panic, without_wayland_message};
use super::files::Picture;
use super::frame::{Frame, Wanted};
use super::geometry::{Bounds, single};
use super::scene_view::{DisplayedSurface, SceneView, prepare};
use super::{legend, obstacles, theme};

/// This machine has no graphics adapter that can render.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("cannot take pictures: {reason}")]
pub struct NoAdapter {
    /// The reason, in one line.
    pub reason: String,
}

/// Renders pictures of a simulation with the light and colours of the window.
pub struct OffscreenRenderer {
    requests: Option<Sender<Request>>,
    results: Receiver<Result<Picture, String>>,
    /// kiss3d keeps its graphics device per thread and never releases all of it. On a thread of its own, one renderer can
    /// follow another.
    thread: Option<JoinHandle<()>>,
    up: Vec3,
    color: Option<ElementField>,
}

/// A picture to render.
struct Request {
    shape: Arc<Shape>,
    frame: Frame,
    shown: DisplayedSurface,
    up: Vec3,
}

impl OffscreenRenderer {
    /// A renderer of pictures of `width` × `height` pixels; y is up.
    pub fn new(width: u32, height: u32) -> Result<Self, NoAdapter> {
        adapter_available().map_err(|reason| NoAdapter { reason })?;
        let (requests, received) = channel();
        let (answer, results) = channel();
        let thread = std::thread::spawn(move || serve(width, height, &received, &answer));
        let mut renderer =
            OffscreenRenderer { requests: Some(requests), results, thread: Some(thread), up: Vec3::Y, color: None };
        renderer.result()?; // the empty picture that a ready thread sends
        Ok(renderer)
    }

    /// Sets the upward direction in the pictures, as [`WindowOptions::up`](crate::WindowOptions).
    pub fn set_up(&mut self, up: &Vector3<f64>) {
        self.up = single(up).try_normalize().unwrap_or(Vec3::Y);
    }

    /// Sets the field that colours the elements of the simulation mesh, with a legend; `None` for plain colours.
    pub fn set_color(&mut self, color: Option<ElementField>) {
        self.color = color;
    }

    /// Renders the current state of the simulation.
    pub fn render(&mut self, simulation: &dyn Simulation, shown: DisplayedSurface) -> Result<Picture, NoAdapter> {
        let request = Request {
            shape: simulation.shape(),
            frame: Frame::of(simulation, Wanted { field: self.color, contact_forces: true }),
            shown,
            up: self.up,
        };
        if let Some(requests) = &self.requests {
            let _ = requests.send(request); // if the thread has ended, receiving the result fails
        }
        self.result()
    }

    fn result(&mut self) -> Result<Picture, NoAdapter> {
        let result = self.results.recv().unwrap_or_else(|_| Err("the graphics driver failed".into()));
        result.map_err(|reason| NoAdapter { reason })
    }
}

impl Drop for OffscreenRenderer {
    fn drop(&mut self) {
        self.requests = None; // ends the thread
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Renders pictures until the channel of requests is closed.
fn serve(width: u32, height: u32, requests: &Receiver<Request>, answer: &Sender<Result<Picture, String>>) {
    let opened = without_panic(|| {
        let surface = SceneSurface::open(width, height);
        let empty = Picture::new(surface.surface.snap_image());
        (surface, empty)
    });
    let (mut surface, first) = match opened {
        Ok((surface, empty)) => (Some(surface), Ok(empty)),
        Err(reason) => (None, Err(reason)),
    };
    let _ = answer.send(first);
    while let (Some(surface), Ok(request)) = (&mut surface, requests.recv()) {
        let _ = answer.send(without_panic(|| surface.render(request)));
    }
}

/// An offscreen surface and the scene rendered on it.
struct SceneSurface {
    // The view holds resources of the surface's device, so it is dropped first: fields are dropped in order.
    view: Option<Viewed>,
    surface: OffscreenSurface,
    /// A legend was drawn before. The first one is not visible in its frame, because egui prepares its fonts there.
    had_legend: bool,
}

/// The scene of the last picture.
struct Viewed {
    shape: Arc<Shape>,
    up: Vec3,
    scene: SceneView,
    /// The box of all positions so far, and of the obstacles.
    framed: Bounds,
}

impl SceneSurface {
    fn open(width: u32, height: u32) -> Self {
        let setup = CanvasSetup { vsync: false, samples: NumSamples::Four, ..CanvasSetup::default() };
        let open = || pollster::block_on(OffscreenSurface::with_setup(width, height, setup));
        let mut surface = without_wayland_message(open);
        theme::set_style(surface.window_mut().egui_context_mut());
        SceneSurface { view: None, surface, had_legend: false }
    }

    fn render(&mut self, request: Request) -> Picture {
        let Request { shape, frame, shown, up } = request;
        let view = View::of(&shape);
        let Viewed { scene, framed, .. } = match self.view.take() {
            Some(viewed) if Arc::ptr_eq(&viewed.shape, &shape) && viewed.up == up => self.view.insert(viewed),
            _ => {
                prepare(self.surface.window_mut(), view);
                let scene = SceneView::new(&shape, &frame.planes, up);
                let framed = obstacles::arena(scene.bounds(), &frame.planes);
                self.view.insert(Viewed { shape, up, scene, framed })
            }
        };
        scene.show(shown);
        // The camera moves back to keep the whole motion in the picture, and does not come nearer again.
        *framed = framed.joined(&scene.update(&frame));
        let size = Vec2::new(self.surface.width() as f32, self.surface.height() as f32);
        let mut camera = Camera::framing(view, framed, up, size, 0.0);
        let scale = scene.scale().copied();
        let frames = if scale.is_some() && !std::mem::replace(&mut self.had_legend, true) { 2 } else { 1 };
        for _ in 0..frames {
            scene.draw_lines(self.surface.window_mut(), &frame, &camera);
            self.surface.draw_ui(|context| scale.iter().for_each(|scale| legend::show(context, scale)));
            pollster::block_on(self.surface.render_3d(&mut scene.root, &mut camera));
        }
        Picture::new(self.surface.snap_image())
    }
}
