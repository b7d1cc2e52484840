// Many bodies of one mesh, which step together. An invocation owns an element or a node of one environment.

@group(0) @binding(3) var<storage, read> factors: array<real>; // MODULUS, SECOND_MODULUS, WEIGHT, OVER_DENSITY: one of each environment
@group(0) @binding(5) var<storage, read_write> v: array<real>; // velocities, m/s
@group(0) @binding(6) var<storage, read_write> forces: array<real>; // of the elements on three corners, N: nine lists
@group(0) @binding(7) var<storage, read> starts: array<u32>; // first element around each node, and their number
@group(0) @binding(8) var<storage, read> around: array<u32>; // 4 · element + corner
@group(0) @binding(9) var<storage, read> nodal: array<real>; // inverse masses (1/kg; zero where constrained), weights and loads (N): nine lists
@group(0) @binding(10) var<storage, read> numbers: array<real>;
@group(0) @binding(11) var<storage, read_write> found: array<atomic<u32>>; // the first trouble of each environment
@group(0) @binding(12) var<storage, read_write> records: array<u32>; // steps, step of the trouble, trouble: three lists

// Places in `factors`.
const MODULUS = 0u;
const SECOND_MODULUS = 1u;
const WEIGHT = 2u;
const OVER_DENSITY = 3u;

// Places in `numbers`.
const DT = 0u;
const ALPHA = 1u;

// Values of `found`: an inverted element comes before a node whose place it has made infinite in the same step.
const NO_TROUBLE = 0xffffffffu;
const NODE = 0x80000000u;

// Notes an element without volume where the law has no stress for it. Where J is not finite, a node will tell.
fn check_volume(G: Tensor, element: u32, environment: u32) {
    let J = real(1.0) + volume_change(G);
    if !ALLOWS_INVERSION && is_finite(J) && J <= real(0.0) {
        atomicMin(&found[environment], element);
    }
}

fn check_node(node: u32, environment: u32, place: vector, velocity: vector) {
    if !(all_finite(place) && all_finite(velocity)) {
        atomicMin(&found[environment], NODE | node);
    }
}

// Whether an evaluation of the forces looks for inverted elements: it does at the end of a step, not at the stages within.
override looks: u32 = 1u;

@compute @workgroup_size(64)
fn find_forces(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = number_of(group, groups, lane);
    let element = number / sizes.environments;
    if element >= sizes.elements { return; }
    let environment = number % sizes.environments;
    let G = displacement_gradient(element, environment);
    if looks == 1u {
        check_volume(G, element, environment);
    }
    let moduli = sizes.environments * SECOND_MODULUS;
    let P = stress(G, factors[environment], factors[moduli + environment]);
    let volume = -volume_of(element);
    let step = sizes.elements * sizes.environments;
    var at = element * sizes.environments + environment;
    for (var corner = 1u; corner < 4u; corner++) {
        let force = volume * times(P, gradient_of(element, corner));
        forces[at] = force.x;
        forces[at + step] = force.y;
        forces[at + 2u * step] = force.z;
        at += 3u * step;
    }
}

// Looks for inverted elements after the last step.
@compute @workgroup_size(64)
fn look(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = number_of(group, groups, lane);
    let element = number / sizes.environments;
    if element >= sizes.elements { return; }
    let environment = number % sizes.environments;
    check_volume(displacement_gradient(element, environment), element, environment);
}

// Whether a step begins after this look at the troubles.
override begins: u32 = 1u;

// Keeps the first trouble of each environment with the number of steps that had been taken.
@compute @workgroup_size(64)
fn keep_trouble(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let environment = number_of(group, groups, lane);
    let count = sizes.environments;
    if environment >= count { return; }
    let trouble = atomicLoad(&found[environment]);
    if trouble != NO_TROUBLE && records[2u * count + environment] == NO_TROUBLE {
        records[count + environment] = records[environment];
        records[2u * count + environment] = trouble;
    }
    records[environment] += begins;
}

// Elastic forces on a node, N, element after element.
fn elastic_force(node: u32, environment: u32) -> vector {
    let step = sizes.elements * sizes.environments;
    var force = vector(real(0.0), real(0.0), real(0.0));
    for (var k = starts[node]; k < starts[node + 1u]; k++) {
        let corner = around[k] % 4u;
        var at = (around[k] / 4u) * sizes.environments + environment;
        if corner > 0u {
            at += 3u * (corner - 1u) * step;
            force += vector(forces[at], forces[at + step], forces[at + 2u * step]);
        } else {
            let a = vector(forces[at], forces[at + step], forces[at + 2u * step]);
            let b = vector(forces[at + 3u * step], forces[at + 4u * step], forces[at + 5u * step]);
            let c = vector(forces[at + 6u * step], forces[at + 7u * step], forces[at + 8u * step]);
            force -= a + b + c;
        }
    }
    return force;
}

fn nodal_vector(list: u32, node: u32) -> vector {
    let at = 3u * list * sizes.nodes + node;
    return vector(nodal[at], nodal[at + sizes.nodes], nodal[at + 2u * sizes.nodes]);
}

// Dead loads on a node, N.
fn dead_load(node: u32, environment: u32) -> vector {
    let weight = factors[sizes.environments * WEIGHT + environment];
    return weight * nodal_vector(1u, node) + nodal_vector(2u, node);
}

// Inverse mass of a node in each direction, 1/kg; zero in constrained ones.
fn inverse_mass(node: u32, environment: u32) -> vector {
    return factors[sizes.environments * OVER_DENSITY + environment] * nodal_vector(0u, node);
}
