// 3×3 matrices by their rows, and what the laws need of them. `real` is the number type.

alias vector = vec3<real>;

struct Tensor {
    x: vector,
    y: vector,
    z: vector,
}

fn transposed(a: Tensor) -> Tensor {
    return Tensor(vector(a.x.x, a.y.x, a.z.x), vector(a.x.y, a.y.y, a.z.y), vector(a.x.z, a.y.z, a.z.z));
}

fn outer(a: vector, b: vector) -> Tensor {
    return Tensor(a.x * b, a.y * b, a.z * b);
}

fn sum_of(a: Tensor, b: Tensor) -> Tensor {
    return Tensor(a.x + b.x, a.y + b.y, a.z + b.z);
}

fn scaled(s: real, a: Tensor) -> Tensor {
    return Tensor(s * a.x, s * a.y, s * a.z);
}

// a + s 1
fn plus_diagonal(a: Tensor, s: real) -> Tensor {
    let zero = real(0.0);
    return Tensor(a.x + vector(s, zero, zero), a.y + vector(zero, s, zero), a.z + vector(zero, zero, s));
}

fn inner(a: vector, b: vector) -> real {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

fn cross_of(a: vector, b: vector) -> vector {
    return vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// a b
fn times(a: Tensor, b: vector) -> vector {
    return vector(inner(a.x, b), inner(a.y, b), inner(a.z, b));
}

// The row a times the matrix B.
fn row_times(a: vector, b: Tensor) -> vector {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

fn product(a: Tensor, b: Tensor) -> Tensor {
    return Tensor(row_times(a.x, b), row_times(a.y, b), row_times(a.z, b));
}

// Σ a_ij b_ij
fn dot_of(a: Tensor, b: Tensor) -> real {
    return inner(a.x, b.x) + inner(a.y, b.y) + inner(a.z, b.z);
}

fn trace_of(a: Tensor) -> real {
    return a.x.x + a.y.y + a.z.z;
}

// det(a) a^(−T)
fn cofactor(a: Tensor) -> Tensor {
    return Tensor(cross_of(a.y, a.z), cross_of(a.z, a.x), cross_of(a.x, a.y));
}

// tr cof G + det G: J − 1 without tr G, its terms of second order and above.
fn second_order_volume_change(G: Tensor) -> real {
    let c = cofactor(G);
    return trace_of(c) + inner(G.x, c.x);
}

// J − 1, without the cancellation of det(1 + G) − 1.
fn volume_change(G: Tensor) -> real {
    return trace_of(G) + second_order_volume_change(G);
}

// Green's strain ½ (G + Gᵀ + GᵀG), accurate near rest.
fn green_strain(G: Tensor) -> Tensor {
    let T = transposed(G);
    return scaled(real(0.5), sum_of(sum_of(G, T), product(T, G)));
}

// The number is neither infinite nor NaN, nor beyond the range of single precision. Compilers may take a comparison of NaN with itself
// for true, so the bits tell.
fn is_finite(x: real) -> bool {
    return (bitcast<u32>(f32(x)) & 0x7f800000u) != 0x7f800000u;
}

fn all_finite(a: vector) -> bool {
    return is_finite(a.x) && is_finite(a.y) && is_finite(a.z);
}

// A symmetric 3×3 matrix: its diagonal, and its entries xy, xz and yz.
struct Block {
    diagonal: vector,
    off: vector,
}

fn diagonal_block(s: real) -> Block {
    return Block(vector(s, s, s), vector(real(0.0), real(0.0), real(0.0)));
}

// block + s a⊗a
fn plus_outer(block: Block, s: real, a: vector) -> Block {
    return Block(block.diagonal + s * a * a, block.off + s * vector(a.x * a.y, a.x * a.z, a.y * a.z));
}

// Hooke's law for small strain, with Lamé's constants μ and λ: stress, energy density, and the block Σ_jl H_(ij)(kl) g_j g_l of its
// derivative.
fn hooke_stress(G: Tensor, mu: real, lambda: real) -> Tensor {
    return plus_diagonal(scaled(mu, sum_of(G, transposed(G))), lambda * trace_of(G));
}

fn hooke_energy(G: Tensor, mu: real, lambda: real) -> real {
    return real(0.5) * dot_of(G, hooke_stress(G, mu, lambda));
}

fn hooke_block(gradient: vector, mu: real, lambda: real) -> Block {
    return plus_outer(diagonal_block(mu * inner(gradient, gradient)), mu + lambda, gradient);
}

// Cosine and sine of Jacobi's rotation that makes the entry between two diagonal entries p and q of a symmetric matrix zero: Golub and Van
// Loan, Matrix Computations (2013), section 8.5.
fn jacobi_rotation(p: real, q: real, entry: real) -> array<real, 2> {
    let one = real(1.0);
    let theta = (q - p) / (real(2.0) * entry);
    let size = one / (abs(theta) + sqrt(theta * theta + one));
    let t = select(size, -size, theta < real(0.0));
    let c = one / sqrt(t * t + one);
    return array<real, 2>(c, t * c);
}
