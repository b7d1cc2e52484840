//! Tests of the thread with a simulation of one moving node.

use std::sync::atomic::AtomicUsize;
use std::time::{Duration, Instant};

use fem_model::BodyMesh;
use fem_model::simulation::{
    Cause, Checkpoint, Counters, Diagnostics, Energies, EnergyLedger, Interactive, Part, Plane, PlaneContact,
    PlasticFlow, Reaction, Shape,
};
use kiss3d::glamx::Vec3;
use nalgebra::{DVector, Matrix3, Matrix4, Vector4};

use super::*;

const TIMEOUT: Duration = Duration::from_secs(10);
pub const REAL_TIME: LoopOptions = LoopOptions { stepping: Stepping::RealTime, steps: None, log_energies: true };

/// One node that rises by one metre per second, and fails or panics at given steps.
pub struct Fake {
    pub time: f64,
    pub density: f64,
    pub offset: f64,
    pub fails_at_step: usize,
    pub panics_at_step: usize,
    pub steps: usize,
    pub step_seconds: f64,
    pub calls: Arc<AtomicUsize>,
    /// Number of times that stresses or contact forces were computed.
    pub fields: Arc<AtomicUsize>,
    pub pulled: Option<Pull>,
    /// Nodes that scenes may name; the simulation moves one.
    pub mesh: BodyMesh,
}

pub fn fake() -> Fake {
    Fake {
        time: 0.0,
        density: 1.0,
        offset: 0.0,
        fails_at_step: usize::MAX,
        panics_at_step: usize::MAX,
        steps: 0,
        step_seconds: 0.0,
        calls: Arc::default(),
        fields: Arc::default(),
        pulled: None,
        mesh: fem_mesh::TetrahedralMesh::default().into(),
    }
}

impl Simulation for Fake {
    fn name(&self) -> &str {
        "fake"
    }
    fn shape(&self) -> Arc<Shape> {
        let mesh = self.mesh.clone();
        Arc::new(Shape { boundary: mesh.surface(), mesh, display: None, picture: None })
    }
    fn positions(&self) -> DVector<f64> {
        DVector::from_vec(vec![self.offset, self.time, 0.0])
    }
    fn velocities(&self) -> DVector<f64> {
        DVector::zeros(3)
    }
    fn display_positions(&self) -> Vec<Vector3<f64>> {
        vec![Vector3::new(self.offset, self.time, 0.0)]
    }
    fn time(&self) -> f64 {
        self.time
    }
    fn steps(&self) -> usize {
        self.steps
    }
    fn dt(&self) -> f64 {
        0.01
    }
    fn step(&mut self) -> Result<(), Failure> {
        self.calls.fetch_add(1, Ordering::SeqCst);
        std::thread::sleep(Duration::from_secs_f64(self.step_seconds));
        if self.steps + 1 == self.fails_at_step {
            let cause = Cause::Inverted { element: 7, J: -0.5 };
            return Err(Failure { step: self.steps + 1, time: self.time, cause, remedy: "smaller steps".into() });
        }
        assert!(self.steps + 1 != self.panics_at_step, "index out of bounds");
        self.steps += 1;
        self.time = self.steps as f64 * self.dt();
        Ok(())
    }
    fn reset(&mut self) {
        self.steps = 0;
        self.time = 0.0;
        self.fails_at_step = usize::MAX;
        self.panics_at_step = usize::MAX;
    }
    fn checkpoint(&self) -> Checkpoint {
        Checkpoint { time: self.time, steps: self.steps, ..Checkpoint::default() }
    }
    fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), String> {
        (self.time, self.steps) = (checkpoint.time, checkpoint.steps);
        Ok(())
    }
    fn energies(&self) -> Energies {
        Energies { kinetic: 1.0, potential: self.time }
    }
    fn min_J(&self) -> (f64, usize) {
        (1.0, 0)
    }
    fn stresses(&self) -> Vec<Matrix3<f64>> {
        self.fields.fetch_add(1, Ordering::SeqCst);
        vec![]
    }
    fn integrator(&self) -> &'static str {
        "verlet"
    }
    fn counters(&self) -> Counters {
        Counters::default()
    }
    fn parts(&self) -> Vec<Part> {
        Vec::new()
    }
    fn display_vertices_outside(&self) -> usize {
        0
    }
    fn nodal_forces(&self) -> Option<DVector<f64>> {
        None
    }
}

impl Interactive for Fake {
    fn next_integrator(&mut self) -> &'static str {
        "verlet"
    }
    fn parameters(&self) -> Vec<Parameter> {
        let range = (0.0, 1.0);
        vec![Parameter { key: "offset", label: "Offset", unit: "m", value: self.offset, range, logarithmic: false }]
    }
    fn apply_parameter(&mut self, _: &'static str, value: f64) {
        self.offset = value;
    }
    fn pick(&self, click: &Click) -> Vec<usize> {
        if click.win.x < 0.0 { Vec::new() } else { vec![0] }
    }
    fn pull(&mut self, pull: Option<Pull>) {
        self.pulled = pull;
    }
}

impl Diagnostics for Fake {
    fn substeps(&self) -> usize {
        1
    }
    fn energy_ledger(&self) -> Option<EnergyLedger> {
        None
    }
    fn failure_at_end(&self) -> Option<Failure> {
        None
    }
    fn estimated_error(&self) -> Option<f64> {
        None
    }
    fn load_factor(&self) -> Option<f64> {
        None
    }
    fn inverted_elements(&self) -> usize {
        0
    }
    fn critical_time_step(&self) -> Option<f64> {
        None
    }
    fn has_stress(&self) -> bool {
        true
    }
    fn stresses_at_points(&self) -> Vec<Matrix3<f64>> {
        self.stresses()
    }
    fn material_of_elements(&self) -> Vec<usize> {
        Vec::new()
    }
    fn moduli_of_elements(&self) -> Vec<[f64; 2]> {
        Vec::new()
    }
    fn plastic_flow(&self) -> Option<PlasticFlow> {
        None
    }
    fn reactions(&self) -> Vec<Reaction> {
        Vec::new()
    }
    fn contacts(&self) -> Vec<PlaneContact> {
        Vec::new()
    }
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }
    fn planes(&self) -> Vec<Plane> {
        Vec::new()
    }
    fn weight(&self) -> Option<f64> {
        Some(self.density)
    }
    fn contact_forces(&self) -> Option<DVector<f64>> {
        self.fields.fetch_add(1, Ordering::SeqCst);
        Some(DVector::from_vec(vec![0.0, 1.0, 0.0]))
    }
    fn lag_residual(&self) -> Option<f64> {
        None
    }
}

fn start(simulation: Box<dyn Simulation>, options: LoopOptions) -> Worker {
    Worker::start(simulation, options, None)
}

/// Takes snapshots until one satisfies `wanted`.
pub fn wait_for(worker: &Worker, what: &str, wanted: impl Fn(&Snapshot) -> bool) -> Snapshot {
    let begun = Instant::now();
    while begun.elapsed() < TIMEOUT {
        match worker.latest() {
            Some(snapshot) if wanted(&snapshot) => return snapshot,
            _ => std::thread::sleep(Duration::from_millis(1)),
        }
    }
    panic!("no snapshot that is {what}");
}

#[test]
fn steps_follow_the_first_snapshot() {
    let worker = start(Box::new(fake()), REAL_TIME);
    let later = wait_for(&worker, "some steps on", |s| s.steps >= 3);
    assert!((later.time - 0.01 * later.steps as f64).abs() < 1e-9);
    assert_eq!(later.frame.positions[0].y, later.time as f32);
    let finished = worker.finish();
    assert_eq!(finished.step_seconds.len(), finished.energies.len());
    assert!(finished.stop.is_none() && finished.simulation.is_some());
}

#[test]
fn a_fast_simulation_runs_in_real_time() {
    let begun = Instant::now();
    let worker = start(Box::new(fake()), REAL_TIME);
    let snapshot = wait_for(&worker, "0.2 s on", |s| s.time >= 0.2);
    assert!(begun.elapsed().as_secs_f64() >= snapshot.time - 0.02);
}

#[test]
fn a_paused_simulation_takes_no_steps_and_continues() {
    let fake = fake();
    let calls = Arc::clone(&fake.calls);
    let worker = start(Box::new(fake), REAL_TIME);
    worker.send(Command::TogglePause);
    let paused = wait_for(&worker, "paused", |s| s.paused);
    let before = calls.load(Ordering::SeqCst);
    std::thread::sleep(Duration::from_millis(60));
    assert_eq!(calls.load(Ordering::SeqCst), before);
    worker.send(Command::TogglePause);
    wait_for(&worker, "going on", |s| !s.paused && s.steps > paused.steps);
}

#[test]
fn a_reset_restores_the_initial_state_also_during_a_pause() {
    let worker = start(Box::new(fake()), REAL_TIME);
    wait_for(&worker, "some steps on", |s| s.steps >= 3);
    worker.send(Command::TogglePause);
    worker.send(Command::Reset);
    let start = wait_for(&worker, "at the start", |s| s.paused && s.steps == 0);
    assert_eq!((start.time, start.history.len()), (0.0, 1));
    assert!(worker.finish().step_seconds.is_empty());
}

#[test]
fn a_failure_keeps_the_last_good_state_until_a_reset() {
    let worker = start(Box::new(Fake { fails_at_step: 4, ..fake() }), REAL_TIME);
    let failed = wait_for(&worker, "failed", |s| s.stop.is_some());
    assert_eq!(failed.steps, 3);
    assert!(failed.stop.unwrap().to_string().contains("smaller steps"));
    worker.send(Command::Reset);
    wait_for(&worker, "running again", |s| s.stop.is_none() && s.steps > 4);
}

#[test]
fn a_panic_stops_the_simulation_until_a_reset() {
    let worker = start(Box::new(Fake { panics_at_step: 2, ..fake() }), REAL_TIME);
    let stopped = wait_for(&worker, "stopped", |s| s.stop.is_some());
    assert_eq!(stopped.stop, Some(Stop::Panicked("index out of bounds".into())));
    assert_eq!(stopped.frame.positions.len(), 1, "the last snapshot stays");
    worker.send(Command::Reset);
    wait_for(&worker, "running again", |s| s.stop.is_none() && s.steps > 2);
}

#[test]
fn a_refused_parameter_has_a_message_and_a_valid_one_clears_it() {
    let worker = start(Box::new(fake()), REAL_TIME);
    worker.send(Command::Set("offset", 2.0));
    let refused = wait_for(&worker, "refused", |s| s.refusal.is_some());
    assert_eq!(refused.parameters[0].value, 0.0);
    worker.send(Command::Set("offset", 0.5));
    let set = wait_for(&worker, "set", |s| s.parameters[0].value == 0.5);
    assert_eq!(set.refusal, None);
}

#[test]
fn a_pick_returns_nodes_and_positions_also_during_a_pause() {
    let worker = start(Box::new(Fake { offset: 0.25, ..fake() }), REAL_TIME);
    worker.send(Command::TogglePause);
    let pick = |x: f64| {
        let (reply, answer) = channel();
        let win = Vector3::new(x, 0.0, 0.0);
        let (view, viewport) = (Matrix4::identity(), Vector4::zeros());
        worker.send(Command::Pick(Click { win, view, proj: view, viewport }, reply));
        answer.recv_timeout(TIMEOUT).unwrap()
    };
    assert!(pick(-1.0).is_empty());
    let anchors = pick(1.0);
    assert_eq!((anchors[0].0, anchors[0].1.x), (0, 0.25));
}

#[test]
fn the_simulation_finishes_after_the_given_number_of_steps() {
    let worker = start(Box::new(fake()), LoopOptions { steps: Some(5), ..REAL_TIME });
    assert_eq!(wait_for(&worker, "finished", |s| s.finished).steps, 5);
    assert_eq!(worker.finish().energies.len(), 5);
}

#[test]
fn frames_come_on_request_at_even_intervals() {
    let options = LoopOptions { stepping: Stepping::Frames(1.0 / 30.0), ..REAL_TIME };
    let worker = start(Box::new(fake()), options);
    let mut times = vec![wait_for(&worker, "the start", |_| true).time];
    for _ in 0..6 {
        std::thread::sleep(Duration::from_millis(5));
        assert!(worker.latest().is_none(), "a frame comes on request only");
        worker.send(Command::NextFrame);
        times.push(wait_for(&worker, "the next frame", |_| true).time);
    }
    let steps: Vec<i32> = times.iter().map(|t| (t * 100.0).round() as i32).collect();
    assert_eq!(steps, [0, 4, 7, 10, 14, 17, 20]);
}

#[test]
fn the_thread_ends_when_its_window_is_gone() {
    let fake = Fake { step_seconds: 0.001, ..fake() };
    let calls = Arc::clone(&fake.calls);
    let Worker { commands, thread, .. } = start(Box::new(fake), REAL_TIME);
    drop(commands);
    assert!(thread.join().unwrap().simulation.is_some());
    let after = calls.load(Ordering::SeqCst);
    std::thread::sleep(Duration::from_millis(20));
    assert_eq!(calls.load(Ordering::SeqCst), after);
}

#[test]
fn fields_and_contact_forces_are_computed_only_while_they_are_wanted() {
    let fake = fake();
    let fields = Arc::clone(&fake.fields);
    let worker = start(Box::new(fake), REAL_TIME);
    wait_for(&worker, "some steps on", |s| s.steps >= 5);
    assert_eq!(fields.load(Ordering::SeqCst), 0);
    worker.send(Command::Want(Wanted { field: Some(ElementField::Stress), contact_forces: true }));
    let shown = wait_for(&worker, "with arrows", |s| !s.frame.arrows.is_empty());
    assert_eq!(shown.frame.field, Some((ElementField::Stress, vec![])));
    assert_eq!(shown.frame.arrows, [(0, Vec3::new(0.0, 3.0, 0.0))], "three times the force, over the weight of 1 N");
    worker.send(Command::Want(Wanted::default()));
    let plain = wait_for(&worker, "plain", |s| s.frame.arrows.is_empty());
    assert_eq!(plain.frame.field, None);
}
