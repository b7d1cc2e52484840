// The stiffness matrices of linear tetrahedra, and their sum in a matrix of 3×3 blocks in slices of 32 rows. An invocation owns an element, or
// a block of the matrix, whose terms it adds in a fixed order.

@group(0) @binding(3) var<storage, read> moduli: array<real>; // two lists, one number for each element
@group(0) @binding(5) var<storage, read_write> matrices: array<real>; // ten blocks of each element, N/m: 90 lists
@group(0) @binding(6) var<storage, read> numbers: array<real>;
@group(0) @binding(7) var<storage, read> starts: array<u32>; // first term of each block, and their number
@group(0) @binding(8) var<storage, read> terms: array<u32>; // 16 · element + 4 · corner of the row + corner of the column
@group(0) @binding(9) var<storage, read> masses: array<real>; // of each block, kg
@group(0) @binding(10) var<storage, read> slices: array<u32>; // of each layer: a block of each row of a slice
@group(0) @binding(11) var<storage, read> columns: array<u32>; // of each block
@group(0) @binding(12) var<storage, read> free: array<real>; // 1 for each free direction of a node, 0 for a constrained one: three lists
@group(0) @binding(13) var<storage, read_write> values: array<real>;

// Places in `numbers`.
const STIFFNESS = 0u; // factor of the stiffness
const MASS = 1u; // factor of the mass
const ADDS = 2u; // not zero: the matrices of the elements are added to those that are there

// The list of the first entry of the block between two corners, row >= column.
fn block_of(row: u32, column: u32) -> u32 {
    return 9u * (row * (row + 1u) / 2u + column);
}

// V Σ_jl H_(ij)(kl) (∇φ_a)_j (∇φ_b)_l for all corners a >= b.
@compute @workgroup_size(64)
fn find_matrices(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let element = number_of(group, groups, lane);
    if element >= sizes.elements { return; }
    var gradients: array<vector, 4>;
    for (var corner = 1u; corner < 4u; corner++) {
        gradients[corner] = gradient_of(element, corner);
        gradients[0] -= gradients[corner];
    }
    let at = tangent(displacement_gradient(element, 0u), moduli[element], moduli[sizes.elements + element]);
    let factor = numbers[STIFFNESS] * volume_of(element);
    for (var column = 0u; column < 4u; column++) {
        let gradient = factor * gradients[column];
        for (var k = 0u; k < 3u; k++) {
            let axis = vector(real(k == 0u), real(k == 1u), real(k == 2u));
            let P = stress_change(at, outer(axis, gradient));
            for (var row = column; row < 4u; row++) {
                add_column(element, block_of(row, column) + k, times(P, gradients[row]));
            }
        }
    }
}

fn add_column(element: u32, list: u32, entries: vector) {
    let step = 3u * sizes.elements;
    let at = list * sizes.elements + element;
    if numbers[ADDS] == real(0.0) {
        matrices[at] = entries.x;
        matrices[at + step] = entries.y;
        matrices[at + 2u * step] = entries.z;
    } else {
        matrices[at] += entries.x;
        matrices[at + step] += entries.y;
        matrices[at + 2u * step] += entries.z;
    }
}

// Adds stiffness and mass to the blocks that are there. In constrained directions the diagonal entry alone remains.
@compute @workgroup_size(64)
fn assemble(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let slot = number_of(group, groups, lane);
    if slot >= sizes.slots || starts[slot] == starts[slot + 1u] { return; }
    let layer = slot / 32u;
    let row = 32u * slices[layer] + slot % 32u;
    let column = columns[slot];
    var sum: array<real, 9>;
    for (var k = starts[slot]; k < starts[slot + 1u]; k++) {
        let element = terms[k] / 16u;
        let a = (terms[k] / 4u) % 4u;
        let b = terms[k] % 4u;
        let is_stored = a >= b;
        let first = block_of(max(a, b), min(a, b));
        for (var i = 0u; i < 3u; i++) {
            for (var j = 0u; j < 3u; j++) {
                let list = first + select(3u * j + i, 3u * i + j, is_stored);
                sum[3u * i + j] += matrices[list * sizes.elements + element];
            }
        }
    }
    let at = layer * 288u + slot % 32u;
    for (var i = 0u; i < 3u; i++) {
        for (var j = 0u; j < 3u; j++) {
            var entry = values[at + 32u * (3u * i + j)] + sum[3u * i + j];
            if i == j { entry += numbers[MASS] * masses[slot]; }
            let is_diagonal = row == column && i == j;
            let is_free = free[i * sizes.nodes + row] * free[j * sizes.nodes + column];
            values[at + 32u * (3u * i + j)] = select(is_free * entry, entry, is_diagonal);
        }
    }
}
