// Conjugate gradients for A x = b, a symmetric matrix of 3×3 blocks, without a word to the processor within an iteration.
// The preconditioner is a Chebyshev polynomial in D⁻¹A, D the diagonal blocks, plus a correction on a coarse grid, P Aᶜ⁻¹ Pᵀ.
// `real` is the number type; an invocation owns a row.

struct Sizes {
    rows: u32,
    corners: u32, // of the coarse grid
    groups: u32,  // of 64 rows
    padding: u32,
}

@group(0) @binding(0) var<uniform> sizes: Sizes;
@group(0) @binding(1) var<storage, read> slices: array<u32>;
@group(0) @binding(2) var<storage, read> columns: array<u32>;
@group(0) @binding(3) var<storage, read> values: array<real>;
@group(0) @binding(4) var<storage, read> inverses: array<real>; // D⁻¹
@group(0) @binding(5) var<storage, read_write> x: array<real>;
@group(0) @binding(6) var<storage, read_write> r: array<real>;
@group(0) @binding(7) var<storage, read_write> p: array<real>;
@group(0) @binding(8) var<storage, read_write> q: array<real>; // A p, and the preconditioned residual later
@group(0) @binding(9) var<storage, read_write> z: array<real>; // polynomial so far
@group(0) @binding(10) var<storage, read_write> next: array<real>; // polynomial of one degree more
@group(0) @binding(11) var<storage, read_write> change: array<real>; // between the two
@group(0) @binding(12) var<storage, read_write> sums: array<real>; // two of each group
@group(0) @binding(13) var<storage, read_write> numbers: array<real>;
@group(0) @binding(14) var<storage, read_write> counts: array<u32>;
@group(0) @binding(15) var<storage, read> members: array<u32>; // first member of each corner, then nodes
@group(0) @binding(16) var<storage, read> shares: array<real>; // of the members
@group(0) @binding(17) var<storage, read> free: array<real>;
@group(0) @binding(18) var<storage, read_write> coarse_residual: array<real>;
@group(0) @binding(19) var<storage, read> coarse_inverse: array<real>;
@group(0) @binding(20) var<storage, read_write> coarse_change: array<real>;
@group(0) @binding(21) var<storage, read> corners: array<u32>; // eight of each row
@group(0) @binding(22) var<storage, read> weights: array<real>;
@group(0) @binding(23) var<storage, read> diagonal: array<u32>; // the first number of the diagonal block of each row
@group(0) @binding(24) var<storage, read_write> found: array<real>; // D⁻¹ of a new matrix
@group(0) @binding(25) var<storage, read_write> is_indefinite: array<atomic<u32>>;

// Places in `numbers`.
const RZ = 0u;
const PQ = 1u;
const ALPHA = 2u;
const BETA = 3u;
const RR = 4u;
const TARGET = 5u;
const PP = 6u;
const COARSE_WEIGHT = 7u;

// Places in `counts`.
const ITERATIONS = 0u;
const END = 1u;
const IS_STARTED = 2u;

// Values of END.
const CONVERGED = 1u;
const NO_CURVATURE = 2u;

// Coefficients of a polynomial of one degree more.
override of_change: f32 = 0.0;
override of_residual: f32 = 1.0;

var<workgroup> first: array<real, 64>;
var<workgroup> second: array<real, 64>;
var<workgroup> third: array<real, 64>;

// Sums of all invocations of a group, in `first[0]`, `second[0]` and `third[0]`.
fn reduce(lane: u32, a: real, b: real, c: real) {
    first[lane] = a;
    second[lane] = b;
    third[lane] = c;
    workgroupBarrier();
    for (var half = 32u; half > 0u; half = half / 2u) {
        if lane < half {
            first[lane] += first[lane + half];
            second[lane] += second[lane + half];
            third[lane] += third[lane + half];
        }
        workgroupBarrier();
    }
}

// D⁻¹ v of a row.
fn scaled(row: u32, a: real, b: real, c: real) -> array<real, 3> {
    let at = (row / 32u) * 288u + row % 32u;
    return array<real, 3>(
        inverses[at] * a + inverses[at + 32u] * b + inverses[at + 64u] * c,
        inverses[at + 96u] * a + inverses[at + 128u] * b + inverses[at + 160u] * c,
        inverses[at + 192u] * a + inverses[at + 224u] * b + inverses[at + 256u] * c,
    );
}

// The inverse of a row's diagonal block, which is symmetric: cofactors over the determinant. A block that is not positive definite is noted.
@compute @workgroup_size(64)
fn invert(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x;
    if row >= sizes.rows { return; }
    let at = diagonal[row];
    let xx = values[at];
    let xy = values[at + 96u];
    let yy = values[at + 128u];
    let xz = values[at + 192u];
    let yz = values[at + 224u];
    let zz = values[at + 256u];
    let of_xx = yy * zz - yz * yz;
    let of_xy = xz * yz - xy * zz;
    let of_xz = xy * yz - xz * yy;
    let of_zz = xx * yy - xy * xy;
    let of_yz = xy * xz - xx * yz;
    let determinant = xx * of_xx + xy * of_xy + xz * of_xz;
    if !(xx > real(0.0) && of_zz > real(0.0) && determinant > real(0.0)) {
        atomicStore(&is_indefinite[0], 1u);
    }
    let to = (row / 32u) * 288u + row % 32u;
    let inverse = real(1.0) / determinant;
    let of_yy = xx * zz - xz * xz;
    let entries = array<real, 9>(of_xx, of_xy, of_xz, of_xy, of_yy, of_yz, of_xz, of_yz, of_zz);
    for (var k = 0u; k < 9u; k++) {
        found[to + 32u * k] = inverse * entries[k];
    }
}

@compute @workgroup_size(64)
fn advance(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x;
    if row >= sizes.rows { return; }
    let alpha = numbers[ALPHA];
    var s: array<real, 3>;
    for (var i = 0u; i < 3u; i++) {
        let at = 3u * row + i;
        x[at] += alpha * p[at];
        s[i] = r[at] - alpha * q[at];
        r[at] = s[i];
    }
    let d = scaled(row, s[0], s[1], s[2]);
    for (var i = 0u; i < 3u; i++) {
        change[3u * row + i] = real(of_residual) * d[i];
        z[3u * row + i] = real(of_residual) * d[i];
    }
}

@compute @workgroup_size(64)
fn raise_degree(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x;
    if row >= sizes.rows { return; }
    let lane = row % 32u;
    var a = r[3u * row];
    var b = r[3u * row + 1u];
    var c = r[3u * row + 2u];
    for (var layer = slices[row / 32u]; layer < slices[row / 32u + 1u]; layer++) {
        let column = 3u * columns[layer * 32u + lane];
        let at = layer * 288u + lane;
        let u = z[column];
        let v = z[column + 1u];
        let w = z[column + 2u];
        a -= values[at] * u + values[at + 32u] * v + values[at + 64u] * w;
        b -= values[at + 96u] * u + values[at + 128u] * v + values[at + 160u] * w;
        c -= values[at + 192u] * u + values[at + 224u] * v + values[at + 256u] * w;
    }
    let d = scaled(row, a, b, c);
    for (var i = 0u; i < 3u; i++) {
        let at = 3u * row + i;
        let moved = real(of_change) * change[at] + real(of_residual) * d[i];
        change[at] = moved;
        next[at] = z[at] + moved;
    }
}

// A group sums the residuals around a corner of the coarse grid.
@compute @workgroup_size(64)
fn collect(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    var a = real(0.0);
    var b = real(0.0);
    var c = real(0.0);
    for (var k = members[group.x] + lane; k < members[group.x + 1u]; k += 64u) {
        let node = 3u * members[k];
        a += shares[k] * free[node] * r[node];
        b += shares[k] * free[node + 1u] * r[node + 1u];
        c += shares[k] * free[node + 2u] * r[node + 2u];
    }
    reduce(lane, a, b, c);
    if lane == 0u {
        coarse_residual[3u * group.x] = first[0];
        coarse_residual[3u * group.x + 1u] = second[0];
        coarse_residual[3u * group.x + 2u] = third[0];
    }
}

// A group takes three rows of the inverse of the coarse matrix.
@compute @workgroup_size(64)
fn solve_coarse(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let size = 3u * sizes.corners;
    let row = 3u * group.x * size;
    var a = real(0.0);
    var b = real(0.0);
    var c = real(0.0);
    for (var k = lane; k < size; k += 64u) {
        let residual = coarse_residual[k];
        a += coarse_inverse[row + k] * residual;
        b += coarse_inverse[row + size + k] * residual;
        c += coarse_inverse[row + 2u * size + k] * residual;
    }
    reduce(lane, a, b, c);
    if lane == 0u {
        coarse_change[3u * group.x] = numbers[COARSE_WEIGHT] * first[0];
        coarse_change[3u * group.x + 1u] = numbers[COARSE_WEIGHT] * second[0];
        coarse_change[3u * group.x + 2u] = numbers[COARSE_WEIGHT] * third[0];
    }
}

@compute @workgroup_size(64)
fn prolong(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let row = id.x;
    var rz = real(0.0);
    var rr = real(0.0);
    if row < sizes.rows {
        var s = array<real, 3>(z[3u * row], z[3u * row + 1u], z[3u * row + 2u]);
        if sizes.corners > 0u {
            for (var k = 0u; k < 8u; k++) {
                let corner = 3u * corners[8u * row + k];
                let weight = weights[8u * row + k];
                for (var i = 0u; i < 3u; i++) {
                    s[i] += weight * free[3u * row + i] * coarse_change[corner + i];
                }
            }
        }
        for (var i = 0u; i < 3u; i++) {
            let at = 3u * row + i;
            q[at] = s[i];
            rz += r[at] * s[i];
            rr += r[at] * r[at];
        }
    }
    reduce(lane, rz, rr, real(0.0));
    if lane == 0u {
        sums[2u * group.x] = first[0];
        sums[2u * group.x + 1u] = second[0];
    }
}

// Sums of the groups, by one group.
fn reduce_groups(lane: u32) {
    var a = real(0.0);
    var b = real(0.0);
    for (var k = lane; k < sizes.groups; k += 64u) {
        a += sums[2u * k];
        b += sums[2u * k + 1u];
    }
    reduce(lane, a, b, real(0.0));
}

@compute @workgroup_size(64)
fn find_direction(@builtin(local_invocation_index) lane: u32) {
    reduce_groups(lane);
    if lane == 0u && counts[END] == 0u {
        numbers[BETA] = real(0.0);
        if counts[IS_STARTED] == 1u {
            numbers[BETA] = first[0] / numbers[RZ];
            counts[ITERATIONS] += 1u;
        }
        counts[IS_STARTED] = 1u;
        numbers[RZ] = first[0];
        numbers[RR] = second[0];
        if atomicLoad(&is_indefinite[0]) == 1u {
            numbers[PQ] = -second[0];
            numbers[PP] = second[0];
            counts[END] = NO_CURVATURE;
        } else if second[0] <= numbers[TARGET] {
            counts[END] = CONVERGED;
        } else if first[0] <= real(0.0) {
            // Below the smallest number, or D is not positive definite: no direction is left.
            numbers[PQ] = first[0];
            numbers[PP] = second[0];
            counts[END] = NO_CURVATURE;
        }
    }
}

@compute @workgroup_size(64)
fn turn(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x;
    if row >= sizes.rows { return; }
    let beta = numbers[BETA];
    for (var i = 0u; i < 3u; i++) {
        let at = 3u * row + i;
        p[at] = q[at] + beta * p[at];
    }
}

@compute @workgroup_size(64)
fn multiply(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let row = id.x;
    var pq = real(0.0);
    var pp = real(0.0);
    if row < sizes.rows {
        let place = row % 32u;
        var a = real(0.0);
        var b = real(0.0);
        var c = real(0.0);
        for (var layer = slices[row / 32u]; layer < slices[row / 32u + 1u]; layer++) {
            let column = 3u * columns[layer * 32u + place];
            let at = layer * 288u + place;
            let u = p[column];
            let v = p[column + 1u];
            let w = p[column + 2u];
            a += values[at] * u + values[at + 32u] * v + values[at + 64u] * w;
            b += values[at + 96u] * u + values[at + 128u] * v + values[at + 160u] * w;
            c += values[at + 192u] * u + values[at + 224u] * v + values[at + 256u] * w;
        }
        q[3u * row] = a;
        q[3u * row + 1u] = b;
        q[3u * row + 2u] = c;
        let u = p[3u * row];
        let v = p[3u * row + 1u];
        let w = p[3u * row + 2u];
        pq = a * u + b * v + c * w;
        pp = u * u + v * v + w * w;
    }
    reduce(lane, pq, pp, real(0.0));
    if lane == 0u {
        sums[2u * group.x] = first[0];
        sums[2u * group.x + 1u] = second[0];
    }
}

@compute @workgroup_size(64)
fn find_length(@builtin(local_invocation_index) lane: u32) {
    reduce_groups(lane);
    if lane == 0u {
        numbers[ALPHA] = real(0.0);
        if counts[END] == 0u {
            numbers[PQ] = first[0];
            numbers[PP] = second[0];
            if first[0] > real(0.0) {
                numbers[ALPHA] = numbers[RZ] / first[0];
            } else {
                counts[END] = NO_CURVATURE;
            }
        }
    }
}
