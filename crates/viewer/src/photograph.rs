//! Pictures without a window or a display server.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

use fem_scene::simulation::{Shape, Simulation};
use kiss3d::camera::Camera3d;
use kiss3d::glamx::{Vec2, Vec3};
use kiss3d::window::{CanvasSetup, NumSamples, OffscreenSurface};
use nalgebra::Vector3;
use thiserror::Error;

use crate::camera::OrbitCamera;
use crate::display::{adapter_available, without_panic};
use crate::geometry::{Bounds, points, single};
use crate::pictures::Photograph;
use crate::stage::{Shown, Stage, prepare};

/// Pictures cannot be taken on this machine.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("cannot take pictures: {reason}")]
pub struct NoAdapter {
    /// Why, in one line.
    pub reason: String,
}

/// Takes pictures of a simulation, with the light and colours of the window.
pub struct Photographer {
    orders: Option<Sender<Order>>,
    results: Receiver<Result<Photograph, String>>,
    /// The drawing library keeps its graphics card per thread and never lets go of all of it. On a thread of its own,
    /// one photographer can follow another.
    thread: Option<JoinHandle<()>>,
    up: Vec3,
}

/// A picture to be taken.
struct Order {
    shape: Arc<Shape>,
    positions: Vec<Vec3>,
    display: Vec<Vec3>,
    shown: Shown,
    up: Vec3,
}

impl Photographer {
    /// A photographer of pictures of `width` × `height` pixels, y being up.
    pub fn new(width: u32, height: u32) -> Result<Self, NoAdapter> {
        adapter_available().map_err(|reason| NoAdapter { reason })?;
        let (orders, ordered) = channel();
        let (answer, results) = channel();
        let thread = std::thread::spawn(move || serve(width, height, &ordered, &answer));
        let mut photographer = Photographer { orders: Some(orders), results, thread: Some(thread), up: Vec3::Y };
        photographer.result()?; // an empty picture: the room is ready
        Ok(photographer)
    }

    /// Which direction is up in the pictures, as [`WindowOptions::up`](crate::WindowOptions).
    pub fn set_up(&mut self, up: &Vector3<f64>) {
        self.up = single(up).try_normalize().unwrap_or(Vec3::Y);
    }

    /// Takes a picture of the simulation as it is now.
    pub fn shoot(&mut self, simulation: &dyn Simulation, shown: Shown) -> Result<Photograph, NoAdapter> {
        let order = Order {
            shape: simulation.shape(),
            positions: points(&simulation.positions()),
            display: simulation.display_positions().iter().map(single).collect(),
            shown,
            up: self.up,
        };
        if let Some(orders) = &self.orders {
            let _ = orders.send(order); // a thread that is gone answers nothing, which is seen next
        }
        self.result()
    }

    fn result(&mut self) -> Result<Photograph, NoAdapter> {
        let result = self.results.recv().unwrap_or_else(|_| Err("the graphics driver failed".into()));
        result.map_err(|reason| NoAdapter { reason })
    }
}

impl Drop for Photographer {
    fn drop(&mut self) {
        self.orders = None; // ends the thread
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Takes pictures until nobody orders any.
fn serve(width: u32, height: u32, orders: &Receiver<Order>, answer: &Sender<Result<Photograph, String>>) {
    let opened = without_panic(|| {
        let room = Room::open(width, height);
        let empty = Photograph::new(room.surface.snap_image());
        (room, empty)
    });
    let (mut room, first) = match opened {
        Ok((room, empty)) => (Some(room), Ok(empty)),
        Err(reason) => (None, Err(reason)),
    };
    let _ = answer.send(first);
    while let (Some(room), Ok(order)) = (&mut room, orders.recv()) {
        let _ = answer.send(without_panic(|| room.draw(order)));
    }
}

/// Where pictures are taken.
struct Room {
    // What lies on the graphics card is dropped before the card: fields are dropped from the first to the last.
    /// The body, which way is up, what is drawn, and the box of all places where it has been.
    stage: Option<(Arc<Shape>, Vec3, Stage, Bounds)>,
    surface: OffscreenSurface,
}

impl Room {
    fn open(width: u32, height: u32) -> Self {
        let setup = CanvasSetup { vsync: false, samples: NumSamples::Four, ..CanvasSetup::default() };
        let mut surface = pollster::block_on(OffscreenSurface::with_setup(width, height, setup));
        prepare(surface.window_mut());
        Room { stage: None, surface }
    }

    fn draw(&mut self, order: Order) -> Photograph {
        let Order { shape, positions, display, shown, up } = order;
        let (_, _, stage, framed) = match self.stage.take() {
            Some(stage) if Arc::ptr_eq(&stage.0, &shape) && stage.1 == up => self.stage.insert(stage),
            _ => {
                let stage = Stage::new(&shape, up);
                let framed = *stage.bounds();
                self.stage.insert((shape, up, stage, framed))
            }
        };
        stage.show(shown);
        // A body that has left its place is not cut off: the camera steps back, and stays there.
        *framed = framed.joined(&stage.place(&positions, &display));
        let size = Vec2::new(self.surface.width() as f32, self.surface.height() as f32);
        let mut camera = OrbitCamera::framing(framed, up, size, 0.0);
        stage.draw_edges(self.surface.window_mut(), &positions, camera.eye());
        pollster::block_on(self.surface.render_3d(&mut stage.root, &mut camera));
        Photograph::new(self.surface.snap_image())
    }
}
