//! The body in each of rapier's four crates, which differ in dimension and number type alone.

use std::time::Instant;

use crate::mesh::Mesh;
use crate::options::{Law, Options};

/// The final positions and the times.
pub struct Run {
    /// Stacked positions, m, three numbers for each node.
    pub q: Vec<f64>,
    /// Wall time of each step, s.
    pub seconds: Vec<f64>,
}

macro_rules! simulate {
    ($name:ident, $rapier:ident, $real:ty, $corners:literal, $vector:expr, $position:expr) => {
        /// Runs the body, clamped at x = 0, for all of its steps.
        pub fn $name(options: &Options, mesh: &Mesh) -> Run {
            use $rapier::prelude::*;
            let vector: fn(&[f64]) -> Vector = $vector;
            let position: fn(Vector) -> [f64; 3] = $position;
            let mut world = PhysicsWorld::new();
            world.gravity = vector(&options.gravity);
            let settings = &mut world.integration_parameters;
            settings.dt = options.dt as $real;
            settings.num_solver_iterations = options.substeps;
            settings.soft_bodies.max_extra_substeps = 0; // they serve impacts, of which there are none
            settings.soft_bodies.fem.linear_tolerance = options.tolerance as $real;
            settings.soft_bodies.fem.max_linear_iterations = options.iterations;
            settings.soft_bodies.fem.max_dense_dofs = options.max_dense;
            let material = SoftBodyMaterial {
                young_modulus: options.young as $real,
                poisson_ratio: options.poisson as $real,
                elastic_damping_ratio: options.damping as $real,
                ..Default::default()
            };
            let cells = mesh.elements.iter().map(|e| std::array::from_fn::<u32, $corners, _>(|i| e[i] as u32));
            let clamped = (0..mesh.nodes.len()).filter(|&node| mesh.nodes[node][0] == 0.0).map(|node| node as u32);
            let builder = SoftBodyBuilder::new(mesh.nodes.iter().map(|x| vector(x)).collect())
                .cells(cells.collect())
                .masses(mesh.lumped_mass(options.density).into_iter().map(|mass| mass as $real).collect())
                .cell_model(match options.law {
                    Law::Corotated => SoftBodyCellModel::Corotational,
                    Law::StableNeoHookean => SoftBodyCellModel::NeoHookean,
                })
                .material(material)
                .solver(SoftBodySolver::Fem)
                .no_surface_collider()
                .can_sleep(false)
                .pinned_particles(clamped);
            let body = world.insert_soft_body(builder);
            let mut step = || {
                let start = Instant::now();
                world.step();
                start.elapsed().as_secs_f64()
            };
            let seconds = (0..options.steps).map(|_| step()).collect();
            Run { q: world.soft_bodies[body].particle_positions().flat_map(position).collect(), seconds }
        }
    };
}

simulate!(flat, rapier2d, f32, 3, |x| Vector::new(x[0] as f32, x[1] as f32), |x| [x.x.into(), x.y.into(), 0.0]);
simulate!(flat_double, rapier2d_f64, f64, 3, |x| Vector::new(x[0], x[1]), |x| [x.x, x.y, 0.0]);
simulate!(solid, rapier3d, f32, 4, |x| Vector::new(x[0] as f32, x[1] as f32, x[2] as f32), |x| {
    [x.x.into(), x.y.into(), x.z.into()]
});
simulate!(solid_double, rapier3d_f64, f64, 4, |x| Vector::new(x[0], x[1], x[2]), |x| [x.x, x.y, x.z]);
