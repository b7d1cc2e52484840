// Vertex block descent: Chen, Liu, Yang and Yuksel, Vertex block descent (2024), algorithm 1. Nodes of a colour, which share no element,
// move at once: each to where the incremental potential of implicit Euler is least for it alone, by one step of Newton's method. The step
// is that of the engine's `integrators/descent`: blocks that are not definite enough are made so, and a step that is long beside
// the elements, or of such a block, is halved until the energy around the node does not rise.

@group(0) @binding(13) var<storage, read_write> inertial: array<real>; // displacements that inertia and dead loads alone would give, m
@group(0) @binding(14) var<storage, read_write> start: array<real>; // displacements at the start of the step, m
@group(0) @binding(15) var<storage, read> order: array<u32>; // nodes, colour after colour
@group(0) @binding(16) var<uniform> color: vec4<u32>; // first place in `order`, and number of nodes

// Places in `numbers`.
const DAMPED_DT = 6u; // dt/(1 + α dt)
const DT2 = 7u; // dt²/(1 + α dt)
const OVER_DT = 8u;
const OVER_DT2 = 9u;
const EPSILON = 10u;

const SMALLEST_PIVOT = 1e-5; // of a block that is solved as it is, as a part of its diagonal entry
const SHORT = 0.1; // change of the strain of the elements up to which a step needs no look at the energy
const HALVINGS = 16;
const ROUNDING = 16.0; // rounding errors of an energy, in machine epsilons

fn has_trouble(environment: u32) -> bool {
    return records[2u * sizes.environments + environment] != NO_TROUBLE;
}

@compute @workgroup_size(64)
fn predict(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = number_of(group, groups, lane);
    let node = number / sizes.environments;
    let environment = number % sizes.environments;
    if node >= sizes.nodes || has_trouble(environment) { return; }
    let pushed = numbers[DT2] * inverse_mass(node, environment) * dead_load(node, environment);
    var at = place_of(node, environment);
    for (var i = 0u; i < 3u; i++) {
        start[at] = u[at];
        u[at] += numbers[DAMPED_DT] * v[at] + pushed[i];
        inertial[at] = u[at];
        at += stride();
    }
}

// Velocities from displacements.
@compute @workgroup_size(64)
fn finish(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = number_of(group, groups, lane);
    let node = number / sizes.environments;
    let environment = number % sizes.environments;
    if node >= sizes.nodes || has_trouble(environment) { return; }
    var at = place_of(node, environment);
    var velocity = vector(real(0.0), real(0.0), real(0.0));
    for (var i = 0u; i < 3u; i++) {
        velocity[i] = (u[at] - start[at]) * numbers[OVER_DT];
        v[at] = velocity[i];
        at += stride();
    }
    check_node(node, environment, displacement(node, environment), velocity);
}

// An element around a node: G, and the gradient of the node's own shape function.
struct Around {
    G: Tensor,
    gradient: vector,
    element: u32,
}

fn shape_gradient(element: u32, corner: u32) -> vector {
    if corner > 0u { return gradient_of(element, corner); }
    return -(gradient_of(element, 1u) + gradient_of(element, 2u) + gradient_of(element, 3u));
}

fn around_node(k: u32, environment: u32, place: vector) -> Around {
    let element = around[k] / 4u;
    let own = around[k] % 4u;
    let zero = vector(real(0.0), real(0.0), real(0.0));
    var found = Around(Tensor(zero, zero, zero), zero, element);
    for (var step = 1u; step < 4u; step++) {
        let corner = (own + step) % 4u;
        let of_other = shape_gradient(element, corner);
        found.G = sum_of(found.G, outer(displacement(node_of(element, corner), environment) - place, of_other));
        found.gradient -= of_other;
    }
    return found;
}

fn is_upright(G: Tensor) -> bool {
    return ALLOWS_INVERSION || real(1.0) + volume_change(G) > real(0.0);
}

// Gradient and block of the incremental potential at a node, and the square of the largest change of an element's shape with it.
struct Sums {
    gradient: vector,
    block: Block,
    sharpness: real,
}

// Σ_jl H_(ij)(kl) g_j g_l
fn block(at: Tangent, gradient: vector) -> Block {
    let none = vector(real(0.0), real(0.0), real(0.0));
    let x = times(stress_change(at, Tensor(gradient, none, none)), gradient);
    let y = times(stress_change(at, Tensor(none, gradient, none)), gradient);
    let z = times(stress_change(at, Tensor(none, none, gradient)), gradient);
    return Block(vector(x.x, y.y, z.z), vector(y.x, z.x, z.y));
}

fn sums_of(node: u32, environment: u32, place: vector) -> Sums {
    let moduli = array<real, 2>(factors[environment], factors[sizes.environments * SECOND_MODULUS + environment]);
    let at_rest = lame(moduli[0], moduli[1]);
    var sums = Sums(vector(real(0.0), real(0.0), real(0.0)), diagonal_block(real(0.0)), real(0.0));
    for (var k = starts[node]; k < starts[node + 1u]; k++) {
        let of_element = around_node(k, environment, place);
        let G = of_element.G;
        let gradient = of_element.gradient;
        let square = inner(gradient, gradient);
        var sharpness = square;
        var P: Tensor;
        var added: Block;
        if is_upright(G) {
            P = stress(G, moduli[0], moduli[1]);
            added = block(tangent(G, moduli[0], moduli[1]), gradient);
            if !ALLOWS_INVERSION {
                let J = real(1.0) + volume_change(G);
                let slope = times(cofactor(plus_diagonal(G, real(1.0))), gradient);
                sharpness = max(square, inner(slope, slope) / (J * J));
            }
        } else {
            // Where the law has no stress, the element is a linear one until it is upright again.
            P = hooke_stress(G, at_rest[0], at_rest[1]);
            added = hooke_block(gradient, at_rest[0], at_rest[1]);
        }
        let volume = volume_of(of_element.element);
        sums.gradient += volume * times(P, gradient);
        sums.block = Block(sums.block.diagonal + volume * added.diagonal, sums.block.off + volume * added.off);
        sums.sharpness = max(sums.sharpness, sharpness);
    }
    return sums;
}

// Masses over dt², N/m; zero in constrained directions.
fn weights_of(node: u32, environment: u32) -> vector {
    let inverse = inverse_mass(node, environment);
    var weights = vector(real(0.0), real(0.0), real(0.0));
    for (var i = 0u; i < 3u; i++) {
        if inverse[i] > real(0.0) { weights[i] = numbers[OVER_DT2] / inverse[i]; }
    }
    return weights;
}

fn from_inertia(node: u32, environment: u32, place: vector) -> vector {
    let at = place_of(node, environment);
    return place - vector(inertial[at], inertial[at + stride()], inertial[at + 2u * stride()]);
}

// Rows and columns of constrained directions become those of the identity.
fn constrained(sums: Sums, weights: vector) -> Sums {
    var own = sums;
    let free = vec3<bool>(weights.x > real(0.0), weights.y > real(0.0), weights.z > real(0.0));
    for (var i = 0u; i < 3u; i++) {
        if !free[i] {
            own.gradient[i] = real(0.0);
            own.block.diagonal[i] = real(1.0);
        }
    }
    if !(free.x && free.y) { own.block.off.x = real(0.0); }
    if !(free.x && free.z) { own.block.off.y = real(0.0); }
    if !(free.y && free.z) { own.block.off.z = real(0.0); }
    return own;
}

struct Solved {
    step: vector,
    is_definite: bool,
}

// −A⁻¹ g by A = L D Lᵀ.
fn solved(block: Block, g: vector) -> Solved {
    let over_a = real(1.0) / block.diagonal.x;
    let of_b = block.off.x * over_a;
    let of_c = block.off.y * over_a;
    let second = block.diagonal.y - of_b * block.off.x;
    let coupling = block.off.z - of_b * block.off.y;
    let over_second = real(1.0) / second;
    let of_coupling = coupling * over_second;
    let third = block.diagonal.z - of_c * block.off.y - of_coupling * coupling;
    let least = real(SMALLEST_PIVOT);
    let is_definite = block.diagonal.x > real(0.0) && second > least * abs(block.diagonal.y) && third > least * abs(block.diagonal.z);
    let y1 = g.y - of_b * g.x;
    let y2 = g.z - of_c * g.x - of_coupling * y1;
    let z = y2 / third;
    let y = y1 * over_second - of_coupling * z;
    let x = g.x * over_a - of_b * y - of_c * z;
    return Solved(vector(-x, -y, -z), is_definite);
}

// The block with its eigenvalues replaced by their magnitudes, or by the inertia of the node where that is larger. Eigenvalues by
// Jacobi's rotations: Golub and Van Loan, Matrix Computations (2013), section 8.5.
fn made_definite(block: Block, weights: vector) -> Block {
    var A = array<real, 9>(
        block.diagonal.x, block.off.x, block.off.y,
        block.off.x, block.diagonal.y, block.off.z,
        block.off.y, block.off.z, block.diagonal.z,
    );
    let one = real(1.0);
    let zero = real(0.0);
    var Q = array<real, 9>(one, zero, zero, zero, one, zero, zero, zero, one);
    for (var rotation = 0u; rotation < 24u; rotation++) {
        let p = select(0u, 1u, rotation % 3u == 2u);
        let q = select(2u, 1u, rotation % 3u == 0u);
        let entry = A[3u * p + q];
        if entry == zero { continue; }
        let turn = jacobi_rotation(A[4u * p], A[4u * q], entry);
        let c = turn[0];
        let s = turn[1];
        for (var k = 0u; k < 3u; k++) {
            let a = A[3u * k + p];
            let b = A[3u * k + q];
            A[3u * k + p] = c * a - s * b;
            A[3u * k + q] = s * a + c * b;
        }
        for (var k = 0u; k < 3u; k++) {
            let a = A[3u * p + k];
            let b = A[3u * q + k];
            A[3u * p + k] = c * a - s * b;
            A[3u * q + k] = s * a + c * b;
            let d = Q[3u * k + p];
            let e = Q[3u * k + q];
            Q[3u * k + p] = c * d - s * e;
            Q[3u * k + q] = s * d + c * e;
        }
    }
    let values = vector(A[0], A[4], A[8]);
    let largest = max(max(abs(values.x), abs(values.y)), abs(values.z));
    if min(min(values.x, values.y), values.z) > real(10.0) * real(SMALLEST_PIVOT) * largest { return block; }
    let heaviest = max(max(weights.x, weights.y), weights.z);
    let least = max(heaviest, real(20.0) * real(SMALLEST_PIVOT) * largest);
    var definite = diagonal_block(zero);
    for (var k = 0u; k < 3u; k++) {
        definite = plus_outer(definite, max(abs(values[k]), least), vector(Q[k], Q[3u + k], Q[6u + k]));
    }
    return definite;
}

// Change of the energy around a node with a step, J, and the magnitude of its terms.
fn energy_change(node: u32, environment: u32, place: vector, weights: vector, step: vector) -> array<real, 2> {
    let moduli = array<real, 2>(factors[environment], factors[sizes.environments * SECOND_MODULUS + environment]);
    let at_rest = lame(moduli[0], moduli[1]);
    var change = real(0.0);
    var size = real(0.0);
    for (var k = starts[node]; k < starts[node + 1u]; k++) {
        let of_element = around_node(k, environment, place);
        let after = sum_of(of_element.G, outer(step, of_element.gradient));
        var energies: array<real, 2>;
        if is_upright(of_element.G) {
            energies = array<real, 2>(energy(of_element.G, moduli[0], moduli[1]), energy(after, moduli[0], moduli[1]));
        } else {
            let before = hooke_energy(of_element.G, at_rest[0], at_rest[1]);
            energies = array<real, 2>(before, hooke_energy(after, at_rest[0], at_rest[1]));
        }
        let volume = volume_of(of_element.element);
        change += volume * (energies[1] - energies[0]);
        size += volume * (abs(energies[0]) + abs(energies[1]));
    }
    let moved = from_inertia(node, environment, place) + real(0.5) * step;
    for (var i = 0u; i < 3u; i++) {
        let of_inertia = weights[i] * moved[i] * step[i];
        change += of_inertia;
        size += abs(of_inertia);
    }
    return array<real, 2>(change, size);
}

@compute @workgroup_size(64)
fn sweep(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = number_of(group, groups, lane);
    let environment = number % sizes.environments;
    let place_in_color = number / sizes.environments;
    if place_in_color >= color.y || has_trouble(environment) { return; }
    let node = order[color.x + place_in_color];
    let weights = weights_of(node, environment);
    if !(weights.x > real(0.0) || weights.y > real(0.0) || weights.z > real(0.0)) { return; }
    let place = displacement(node, environment);
    var sums = sums_of(node, environment, place);
    sums.gradient += weights * from_inertia(node, environment, place);
    sums.block.diagonal += weights;
    sums = constrained(sums, weights);
    var found = solved(sums.block, sums.gradient);
    var is_doubtful = !found.is_definite;
    if is_doubtful {
        found = solved(made_definite(sums.block, weights), sums.gradient);
    }
    var step = found.step;
    is_doubtful = is_doubtful || !(inner(step, step) * sums.sharpness <= real(SHORT * SHORT));
    if is_doubtful {
        for (var halving = 0; halving <= HALVINGS; halving++) {
            let change = energy_change(node, environment, place, weights, step);
            if is_finite(change[0]) && change[0] <= real(ROUNDING) * numbers[EPSILON] * change[1] { break; }
            step = select(real(0.5), real(0.0), halving == HALVINGS) * step;
        }
    }
    let at = place_of(node, environment);
    u[at] = place.x + step.x;
    u[at + stride()] = place.y + step.y;
    u[at + 2u * stride()] = place.z + step.z;
}
