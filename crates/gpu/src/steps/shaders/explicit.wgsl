// Explicit methods: a = M⁻¹ f − α v at a stage, and displacements and velocities from it. The methods are those of the engine's files of
// the same names.

@group(0) @binding(13) var<storage, read_write> a: array<real>; // accelerations at the start of the step, m/s²
@group(0) @binding(14) var<storage, read_write> stage_u: array<real>;
@group(0) @binding(15) var<storage, read_write> stage_v: array<real>;
@group(0) @binding(16) var<storage, read_write> start_u: array<real>;
@group(0) @binding(17) var<storage, read_write> start_v: array<real>;

// Stages of a method of several.
override weight: u32 = 0u; // place in `numbers` of the stage's weight times dt
override after: u32 = 0u; // place of the time from the start of the step to the next stage, s; 0 behind the last

// The acceleration of a node with a velocity, from forces that have been found.
fn acceleration(node: u32, environment: u32, velocity: vector) -> vector {
    let force = elastic_force(node, environment) + dead_load(node, environment);
    return inverse_mass(node, environment) * force - numbers[ALPHA] * velocity;
}

struct Owned {
    node: u32,
    environment: u32,
    at: u32,
    goes_on: bool,
}

fn owned(group: vec3<u32>, groups: vec3<u32>, lane: u32) -> Owned {
    let number = number_of(group, groups, lane);
    let node = number / sizes.environments;
    let environment = number % sizes.environments;
    // An environment with a trouble stands still.
    let goes_on = node < sizes.nodes && records[2u * sizes.environments + environment] == NO_TROUBLE;
    return Owned(node, environment, place_of(node, environment), goes_on);
}

fn velocity_at(at: u32) -> vector {
    return vector(v[at], v[at + stride()], v[at + 2u * stride()]);
}

fn set_u(at: u32, value: vector) {
    u[at] = value.x;
    u[at + stride()] = value.y;
    u[at + 2u * stride()] = value.z;
}

fn set_v(at: u32, value: vector) {
    v[at] = value.x;
    v[at + stride()] = value.y;
    v[at + 2u * stride()] = value.z;
}

fn set_a(at: u32, value: vector) {
    a[at] = value.x;
    a[at + stride()] = value.y;
    a[at + 2u * stride()] = value.z;
}

fn a_at(at: u32) -> vector {
    return vector(a[at], a[at + stride()], a[at + 2u * stride()]);
}

fn set_stage(at: u32, place: vector, velocity: vector) {
    stage_u[at] = place.x;
    stage_u[at + stride()] = place.y;
    stage_u[at + 2u * stride()] = place.z;
    stage_v[at] = velocity.x;
    stage_v[at + stride()] = velocity.y;
    stage_v[at + 2u * stride()] = velocity.z;
}

fn stage_velocity(at: u32) -> vector {
    return vector(stage_v[at], stage_v[at + stride()], stage_v[at + 2u * stride()]);
}

// Ends a step of a node.
fn finish(own: Owned, place: vector, velocity: vector) {
    set_u(own.at, place);
    set_v(own.at, velocity);
    check_node(own.node, own.environment, place, velocity);
}

@compute @workgroup_size(64)
fn explicit_euler(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let own = owned(group, groups, lane);
    if !own.goes_on { return; }
    let velocity = velocity_at(own.at);
    let place = displacement(own.node, own.environment) + numbers[DT] * velocity;
    finish(own, place, velocity + numbers[DT] * acceleration(own.node, own.environment, velocity));
}

@compute @workgroup_size(64)
fn semi_implicit_euler(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let own = owned(group, groups, lane);
    if !own.goes_on { return; }
    var velocity = velocity_at(own.at);
    velocity += numbers[DT] * acceleration(own.node, own.environment, velocity);
    finish(own, displacement(own.node, own.environment) + numbers[DT] * velocity, velocity);
}

// Accelerations before the first step.
@compute @workgroup_size(64)
fn verlet_start(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let own = owned(group, groups, lane);
    if !own.goes_on { return; }
    set_a(own.at, acceleration(own.node, own.environment, velocity_at(own.at)));
}

// Half a kick, and a drift.
@compute @workgroup_size(64)
fn verlet_drift(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let own = owned(group, groups, lane);
    if !own.goes_on { return; }
    let velocity = velocity_at(own.at) + real(0.5) * numbers[DT] * a_at(own.at);
    set_v(own.at, velocity);
    set_u(own.at, displacement(own.node, own.environment) + numbers[DT] * velocity);
}

// The other half of the kick. Damping takes the velocity that the whole kick of the start of the step leads to.
@compute @workgroup_size(64)
fn verlet_kick(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let own = owned(group, groups, lane);
    if !own.goes_on { return; }
    let half = real(0.5) * numbers[DT];
    let velocity = velocity_at(own.at);
    let now = acceleration(own.node, own.environment, velocity + half * a_at(own.at));
    set_a(own.at, now);
    finish(own, displacement(own.node, own.environment), velocity + half * now);
}

// The first stage of several, whose forces are those at the start: adds its part, and goes to the next stage.
@compute @workgroup_size(64)
fn first_stage(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let own = owned(group, groups, lane);
    if !own.goes_on { return; }
    let place = displacement(own.node, own.environment);
    let velocity = velocity_at(own.at);
    let slope = acceleration(own.node, own.environment, velocity);
    start_u[own.at] = place.x;
    start_u[own.at + stride()] = place.y;
    start_u[own.at + 2u * stride()] = place.z;
    start_v[own.at] = velocity.x;
    start_v[own.at + stride()] = velocity.y;
    start_v[own.at + 2u * stride()] = velocity.z;
    set_stage(own.at, place + numbers[after] * velocity, velocity + numbers[after] * slope);
    set_u(own.at, place + numbers[weight] * velocity);
    set_v(own.at, velocity + numbers[weight] * slope);
}

// A later stage, whose forces are those at `stage_u`.
@compute @workgroup_size(64)
fn next_stage(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let own = owned(group, groups, lane);
    if !own.goes_on { return; }
    let velocity = stage_velocity(own.at);
    let slope = acceleration(own.node, own.environment, velocity);
    let place = displacement(own.node, own.environment) + numbers[weight] * velocity;
    finish(own, place, velocity_at(own.at) + numbers[weight] * slope);
    let first_u = vector(start_u[own.at], start_u[own.at + stride()], start_u[own.at + 2u * stride()]);
    let first_v = vector(start_v[own.at], start_v[own.at + stride()], start_v[own.at + 2u * stride()]);
    set_stage(own.at, first_u + numbers[after] * velocity, first_v + numbers[after] * slope);
}
