//! Commands of a program that is built without the engine: the functions of the course run its scenes. Students receive it so, since the
//! engine holds solutions of the exercises.

/// Refuses runs of many environments.
pub mod batch {
    use fem_scene::Scene;

    use crate::cli::RunArguments;
    use crate::course::Course;
    use crate::end::End;

    pub fn run(_: &Course, scene: &Scene, _: &RunArguments) -> Result<(), End> {
        Err(End::unusable(scene.refuse("batch", "belongs to the engine, which this program does not have; remove it")))
    }
}

/// Refuses scenes of the engine. No scene of the course is a mass-spring body or a cantilever.
pub mod engine {
    use fem_mesh::TetrahedralMesh;
    use fem_model::Body;
    use fem_model::simulation::{Part, Simulation};
    use fem_scene::Scene;
    use nalgebra::Vector3;

    use crate::end::End;

    pub fn build(scene: &Scene, _: Body) -> Result<Box<dyn Simulation>, End> {
        Err(refused(scene))
    }

    pub fn planned_parts(scene: &Scene, _: &Body) -> Result<Vec<Part>, End> {
        Err(refused(scene))
    }

    fn refused(scene: &Scene) -> End {
        End::unusable(scene.refuse("pipeline", "is \"engine\", which this program does not have; write \"course\""))
    }

    pub fn line_of_moduli(_: &Body) -> Result<Option<String>, End> {
        Ok(None)
    }

    pub fn expected_tip_displacement(_: &Scene, _: &Body) -> Option<Vector3<f64>> {
        None
    }

    pub fn print_tip(_: &dyn Simulation, _: &Vector3<f64>) {}

    pub fn print_conditioning(_: &TetrahedralMesh) -> Result<(), End> {
        Err(End::unusable("--stiffness needs the engine, which this program does not have; leave it out"))
    }
}

/// No studies.
pub mod study {
    use clap::Subcommand;

    use crate::course::Course;
    use crate::end::End;

    #[derive(Debug, Subcommand)]
    pub enum Study {}

    impl Study {
        pub fn run(&self, _: &Course) -> Result<(), End> {
            match *self {}
        }
    }
}
