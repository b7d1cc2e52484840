// Linear tetrahedra with displacements of their nodes, of one body or of many of the same mesh, environment beside environment: entry k of
// an array of the mesh belongs to all of them, and entry k · environments + e of a state to environment e. Invocations side by side read
// numbers side by side.

struct Sizes {
    nodes: u32,
    elements: u32,
    environments: u32,
    slots: u32, // of a matrix
}

@group(0) @binding(0) var<uniform> sizes: Sizes;
@group(0) @binding(1) var<storage, read> corners: array<u32>; // four lists of nodes, one number for each element
@group(0) @binding(2) var<storage, read> shapes: array<real>; // gradients of three corners, 1/m, and volumes, m³: ten lists
@group(0) @binding(4) var<storage, read_write> u: array<real>; // displacements, m: three lists

fn number_of(group: vec3<u32>, groups: vec3<u32>, lane: u32) -> u32 {
    return (group.y * groups.x + group.x) * 64u + lane;
}

// Place in a state of the first entry of a node; the others follow at distances of `stride()`.
fn place_of(node: u32, environment: u32) -> u32 {
    return node * sizes.environments + environment;
}

fn stride() -> u32 {
    return sizes.nodes * sizes.environments;
}

fn displacement(node: u32, environment: u32) -> vector {
    let at = place_of(node, environment);
    return vector(u[at], u[at + stride()], u[at + 2u * stride()]);
}

// Gradient of the shape function of corner 1, 2 or 3, 1/m.
fn gradient_of(element: u32, corner: u32) -> vector {
    let at = 3u * (corner - 1u) * sizes.elements + element;
    return vector(shapes[at], shapes[at + sizes.elements], shapes[at + 2u * sizes.elements]);
}

fn volume_of(element: u32) -> real {
    return shapes[9u * sizes.elements + element];
}

fn node_of(element: u32, corner: u32) -> u32 {
    return corners[corner * sizes.elements + element];
}

// G = Σ (u_a − u_0) ⊗ ∇φ_a
fn displacement_gradient(element: u32, environment: u32) -> Tensor {
    let origin = displacement(node_of(element, 0u), environment);
    let a = outer(displacement(node_of(element, 1u), environment) - origin, gradient_of(element, 1u));
    let b = outer(displacement(node_of(element, 2u), environment) - origin, gradient_of(element, 2u));
    let c = outer(displacement(node_of(element, 3u), environment) - origin, gradient_of(element, 3u));
    return sum_of(sum_of(a, b), c);
}
