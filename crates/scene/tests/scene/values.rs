//! A body from values is the body of a scene with the same tables, and what cannot be simulated is refused at once.

use fem_mesh::{Pattern, box_mesh};
use fem_model::{
    Axis, Body, ContactPlane, Damping, DampingForm, Elastic, Integrator, Law, Material, Method, Motion, PlaneState,
    Region, Selector,
};
use nalgebra::Vector3;

fn rubber() -> Material {
    Material::new(Law::StableNeoHookean(Elastic::new(1e5, 0.3)), 1000.0)
}

fn beam() -> Body {
    Body::new(box_mesh([2.0, 1.0, 1.0], 2, Pattern::default()).unwrap(), rubber()).unwrap()
}

const SCENE: &str = r#"
pipeline = "engine"
[mesh]
box = { size = [2, 1, 1], cells_per_unit = 2 }
[material]
model = "stable_neo_hookean"
young = 1e5
poisson = 0.3
density = 1000
[[materials]]
sphere = { center = [0, 0, 0], radius = 0.5 }
model = "hencky"
young = 2e5
poisson = 0.1
density = 500
[gravity]
acceleration = [0, 0, -9.81]
[body_force]
density = [1, 2, 3]
[fixed]
on = { axis = "x", side = "min", within = 1e-9 }
[[prescribed]]
on = { axis = "x", side = "max", within = 1e-9 }
components = ["y"]
displacement = [0, 0.1, 0]
[[initial_velocity]]
velocity = [1, 0, 0]
[[traction]]
on = { axis = "z", side = "max", within = 1e-9 }
force_per_area = [0, 0, -5]
[[traction]]
on = "all"
pressure = 7
[[force]]
nodes = [4, 9]
value = [0, 1, 0]
[[springs]]
nodes = [3, 20]
stiffness = 10
[[planes]]
point = [0, 0, -0.5]
normal = [0, 0, 2]
[damping]
alpha = 0.5
[time]
integrator = "verlet"
dt = 0.001
substeps = 2
"#;

#[test]
fn a_body_from_values_is_that_of_the_scene_with_the_same_tables() {
    let scene = crate::read(SCENE);
    let method = Method { substeps: 2, ..Method::new(Integrator::Verlet, 0.001) };
    assert_eq!(scene.method(), method);
    let core = Material::new(Law::Hencky(Elastic::new(2e5, 0.1)), 500.0);
    let plane = ContactPlane::new(Vector3::new(0.0, 0.0, -0.5), Vector3::new(0.0, 0.0, 2.0));
    let body = beam()
        .region(&Selector::Region(Region::Sphere { center: [0.0; 3], radius: 0.5 }), core)
        .unwrap()
        .gravity([0.0, 0.0, -9.81])
        .unwrap()
        .body_force([1.0, 2.0, 3.0])
        .unwrap()
        .fix(&Selector::least(Axis::X))
        .unwrap()
        .prescribe(&Selector::most(Axis::X), [false, true, false], Motion::by([0.0, 0.1, 0.0]))
        .unwrap()
        .velocity([1.0, 0.0, 0.0])
        .unwrap()
        .traction(&Selector::most(Axis::Z), [0.0, 0.0, -5.0])
        .unwrap()
        .pressure(&Selector::Region(Region::All), 7.0)
        .unwrap()
        .force(&Selector::Nodes(vec![9, 4]), [0.0, 1.0, 0.0])
        .unwrap()
        .spring([3, 20], 10.0)
        .unwrap()
        .damping(Damping { alpha: 0.5, beta: 0.0, form: DampingForm::KelvinVoigt })
        .unwrap()
        .obstacles(vec![plane], &method)
        .unwrap()
        .lump_mass_for(&method);
    let expected = fem_scene::body(&scene, "no data".as_ref()).unwrap();
    assert_eq!(Body { name: expected.name.clone(), ..body }, expected);
}

#[test]
fn a_method_with_a_number_that_no_step_can_have_is_refused() {
    let method = Method::new(Integrator::GeneralizedAlpha, 0.01);
    assert_eq!(method.check(), Ok(()));
    let refused = |method: Method, text: &str| {
        let error = method.check().unwrap_err().to_string();
        assert!(error.starts_with(text), "{error}");
    };
    refused(Method { dt: -1.0, ..method.clone() }, "time.dt is -1; give a positive number of seconds");
    refused(Method { dt: f64::NAN, ..method.clone() }, "time.dt is NaN");
    refused(Method { substeps: 0, ..method.clone() }, "time.substeps is 0");
    refused(Method { adaptive: Some(1.0), ..method.clone() }, "time.adaptive.tolerance is 1; give a number");
    refused(Method { rho_inf: f64::NAN, ..method.clone() }, "generalized_alpha.spectral_radius is NaN");
}

#[test]
fn values_that_cannot_be_simulated_are_refused_with_the_quantity_and_the_remedy() {
    let refused = |outcome: Result<Body, fem_model::Refusal>, text: &str| {
        let error = outcome.unwrap_err().to_string();
        assert!(error.contains(text), "{error}");
    };
    let mesh = || box_mesh([1.0; 3], 1, Pattern::default()).unwrap();
    let with = |law: Law, density: f64| Body::new(mesh(), Material::new(law, density));
    refused(with(Law::Linear(Elastic::new(-1.0, 0.3)), 1.0), "material.young is -1; give a positive number of Pa");
    refused(with(Law::Linear(Elastic::new(1.0, 0.5)), 1.0), "material.poisson is 0.5");
    refused(with(Law::Hencky(Elastic::new(1.0, 0.3)), f64::NAN), "material.density is NaN");
    refused(with(Law::Yeoh { C1: 1.0, C2: f64::INFINITY, C3: 0.0, D: 1.0 }, 1.0), "material.C2 is inf");
    let thin = Material { plane: PlaneState::Stress, ..rubber() };
    refused(Body::new(mesh(), thin), "material.plane is stress");
    let mut inverted = mesh();
    inverted.elements[0].swap(0, 1);
    refused(Body::new(inverted, rubber()), "mesh cannot be simulated");
    let far = Selector::Region(Region::Sphere { center: [9.0; 3], radius: 1.0 });
    refused(beam().fix(&far), "fixed.sphere (radius 1 m about [9.0, 9.0, 9.0] m) names no node");
    refused(beam().fix(&Selector::Set("feet".to_owned())), "the mesh has no sets");
    refused(beam().force(&Selector::Nodes(vec![999]), [0.0; 3]), "force[0].nodes names node 999");
    refused(beam().spring([2, 2], 1.0), "springs[0].nodes names node 2 twice");
    refused(beam().traction(&Selector::most(Axis::X), [f64::NAN, 0.0, 0.0]), "traction[0].force_per_area is NaN");
    refused(beam().gravity([0.0, f64::INFINITY, 0.0]), "gravity.acceleration is inf");
    refused(beam().body_force([f64::NAN, 0.0, 0.0]), "body_force.density is NaN");
    let fixed = beam().fix(&Selector::least(Axis::X)).unwrap();
    refused(
        fixed.prescribe(&Selector::least(Axis::X), [true; 3], Motion::by([0.1, 0.0, 0.0])),
        "which [fixed] constrains",
    );
    let all = Selector::Region(Region::All);
    refused(beam().region(&all, rubber()).unwrap().region(&all, rubber()), "has elements of materials[0]");
    let nowhere = ContactPlane::new(Vector3::zeros(), Vector3::zeros());
    refused(
        beam().obstacles(vec![nowhere], &Method::new(Integrator::ImplicitEuler, 0.01)),
        "planes[0].normal has no length",
    );
    let far = Motion::by([0.0, f64::NAN, 0.0]);
    refused(beam().prescribe(&Selector::most(Axis::X), [true; 3], far), "prescribed[0].displacement is NaN");
    let behind = ContactPlane::new(Vector3::new(0.0, 0.0, 0.5), Vector3::z());
    refused(beam().obstacles(vec![behind], &Method::new(Integrator::ImplicitEuler, 0.01)), "has the body behind it");
}
