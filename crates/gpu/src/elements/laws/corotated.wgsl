// Corotated linear elasticity: ψ = μ |F − R|² + λ/2 y², y = tr(RᵀF) − 3, P = 2μ (F − R) + λ y R, with the rotation R nearest to F.
// Sifakis and Barbič, FEM Simulation of 3D Deformable Solids (2012), part one, §3.4.

const ALLOWS_INVERSION = true;

// Smallest D, in units of x³ of which it is 16/27 at rest, for which R comes from the closed form: where two singular values cancel, R jumps,
// and near there the root loses its digits.
const SMALLEST = 0.05;

// R − 1; tr(RᵀF) − 3; and D = 2 (σ_1 + σ_2) (σ_2 + σ_3) (σ_3 + σ_1).
struct Rotation {
    change: Tensor,
    strain: real,
    denominator: real,
}

// x = tr(RᵀF) is the largest root of x⁴ − 2 I x² − 8 J x + I² − 4 II, and R = ∂x/∂F: Lin, Chitalu and Komura, Isotropic ARAP Energy Using
// Cauchy–Green Invariants (2022). In terms of G, the strain and R − 1 keep their digits near rest.
fn rotation(G: Tensor) -> Rotation {
    let trace = trace_of(G);
    let i = real(2.0) * trace + dot_of(G, G);
    let j = volume_change(G);
    let K = plus_diagonal(sum_of(cofactor(G), scaled(real(-1.0), transposed(G))), trace);
    let y = largest_root(i, j, real(2.0) * trace_of(K) + dot_of(K, K));
    let x = real(3.0) + y;
    let denominator = real(16.0) + y * (real(24.0) + y * (real(9.0) + y)) - i * x - real(2.0) * j;
    if !(denominator > real(SMALLEST) * x * x * x) {
        return rotation_by_quaternion(G);
    }
    let inverse = real(1.0) / denominator;
    let of_one = -y * (real(16.0) + y * (real(8.0) + y)) + i * (real(4.0) + y) + real(2.0) * j;
    let E = green_strain(G);
    let of_strain = scaled(real(-4.0), sum_of(E, product(G, E)));
    let terms = sum_of(sum_of(scaled(x * x + i + real(1.0), G), of_strain), scaled(real(2.0) * x, K));
    return Rotation(scaled(inverse, plus_diagonal(terms, of_one)), y, denominator);
}

// y = x − 3 for the largest root x: Newton's method from √(3 I) − 3, which lies above it, descends to the root.
fn largest_root(i: real, j: real, k: real) -> real {
    let i12 = real(12.0) * i;
    let linear = real(64.0) - i12 - real(8.0) * j;
    let quadratic = real(48.0) - real(2.0) * i;
    let absolute = i * i - i12 - real(24.0) * j - real(4.0) * k;
    var y = real(3.0) * i / (sqrt(real(9.0) + real(3.0) * i) + real(3.0));
    for (var n = 0; n < 24; n++) {
        let value = absolute + y * (linear + y * (quadratic + y * (real(12.0) + y)));
        let slope = linear + y * (real(2.0) * quadratic + y * (real(36.0) + real(4.0) * y));
        let next = y - value / slope;
        if !(next < y) { break; }
        y = next;
    }
    return y;
}

// The same by the quaternion q that maximizes tr(RᵀF) = q·K q, the eigenvector of the largest eigenvalue of K: Horn, Closed-Form Solution of
// Absolute Orientation Using Unit Quaternions (1987). Jacobi's rotations find it for inverted elements too: Golub and Van Loan, Matrix
// Computations (2013), section 8.5.
fn rotation_by_quaternion(G: Tensor) -> Rotation {
    let F = plus_diagonal(G, real(1.0));
    let zero = real(0.0);
    let one = real(1.0);
    let K01 = F.z.y - F.y.z;
    let K02 = F.x.z - F.z.x;
    let K03 = F.y.x - F.x.y;
    let K12 = F.x.y + F.y.x;
    let K13 = F.x.z + F.z.x;
    let K23 = F.y.z + F.z.y;
    var K = array<real, 16>(
        F.x.x + F.y.y + F.z.z, K01, K02, K03,
        K01, F.x.x - F.y.y - F.z.z, K12, K13,
        K02, K12, F.y.y - F.x.x - F.z.z, K23,
        K03, K13, K23, F.z.z - F.x.x - F.y.y,
    );
    var Q = array<real, 16>(one, zero, zero, zero, zero, one, zero, zero, zero, zero, one, zero, zero, zero, zero, one);
    for (var round = 0u; round < 10u; round++) {
        for (var p = 0u; p < 3u; p++) {
            for (var q = p + 1u; q < 4u; q++) {
                let entry = K[4u * p + q];
                if entry == zero { continue; }
                let turn = jacobi_rotation(K[5u * p], K[5u * q], entry);
                let c = turn[0];
                let s = turn[1];
                for (var k = 0u; k < 4u; k++) {
                    let a = K[4u * k + p];
                    let b = K[4u * k + q];
                    K[4u * k + p] = c * a - s * b;
                    K[4u * k + q] = s * a + c * b;
                }
                for (var k = 0u; k < 4u; k++) {
                    let a = K[4u * p + k];
                    let b = K[4u * q + k];
                    K[4u * p + k] = c * a - s * b;
                    K[4u * q + k] = s * a + c * b;
                    let d = Q[4u * k + p];
                    let e = Q[4u * k + q];
                    Q[4u * k + p] = c * d - s * e;
                    Q[4u * k + q] = s * d + c * e;
                }
            }
        }
    }
    var top = 0u;
    for (var k = 1u; k < 4u; k++) {
        if K[5u * k] > K[5u * top] { top = k; }
    }
    let w = Q[top];
    let v = vector(Q[4u + top], Q[8u + top], Q[12u + top]);
    let R = rotation_of(v, w);
    let x = dot_of(R, F);
    let square = dot_of(F, F);
    let denominator = x * x * x - square * x - real(2.0) * inner(F.x, cofactor(F).x);
    // On the crease the derivative is not finite; beside it, it is cut off.
    let least = real(1e-7) * max(square * sqrt(square), real(1e-12));
    return Rotation(plus_diagonal(R, real(-1.0)), x - real(3.0), max(denominator, least));
}

// The rotation of a unit quaternion.
fn rotation_of(v: vector, w: real) -> Tensor {
    let s = w * w - inner(v, v);
    let two = real(2.0);
    return Tensor(
        two * v.x * v + vector(s, -two * w * v.z, two * w * v.y),
        two * v.y * v + vector(two * w * v.z, s, -two * w * v.x),
        two * v.z * v + vector(-two * w * v.y, two * w * v.x, s),
    );
}

// P; the moduli are μ and λ, Pa.
fn stress(G: Tensor, mu: real, lambda: real) -> Tensor {
    let R = rotation(G);
    let difference = sum_of(G, scaled(real(-1.0), R.change));
    let pressure = lambda * R.strain;
    return sum_of(scaled(real(2.0) * mu, difference), plus_diagonal(scaled(pressure, R.change), pressure));
}

fn energy(G: Tensor, mu: real, lambda: real) -> real {
    let R = rotation(G);
    let difference = sum_of(G, scaled(real(-1.0), R.change));
    return mu * dot_of(difference, difference) + real(0.5) * lambda * R.strain * R.strain;
}

// R, y, and B = (tr S 1 − S)⁻¹, S = RᵀF, which gives the spin of R.
struct Tangent {
    R: Tensor,
    B: Tensor,
    strain: real,
    mu: real,
    lambda: real,
}

fn tangent(G: Tensor, mu: real, lambda: real) -> Tangent {
    let found = rotation(G);
    let R = plus_diagonal(found.change, real(1.0));
    let S = product(transposed(R), plus_diagonal(G, real(1.0)));
    let A = plus_diagonal(scaled(real(-1.0), S), real(3.0) + found.strain);
    return Tangent(R, scaled(real(2.0) / found.denominator, cofactor(A)), found.strain, mu, lambda);
}

// 2μ D + λ tr(W) R + (λ y − 2μ) R', W = RᵀD. R' = R [ω]×, where B gives ω from the axial vector of W − Wᵀ.
fn stress_change(at: Tangent, D: Tensor) -> Tensor {
    let W = product(transposed(at.R), D);
    let spin = times(at.B, vector(W.z.y - W.y.z, W.x.z - W.z.x, W.y.x - W.x.y));
    let turned = Tensor(cross_of(at.R.x, spin), cross_of(at.R.y, spin), cross_of(at.R.z, spin));
    let of_spin = at.lambda * at.strain - real(2.0) * at.mu;
    let along = sum_of(scaled(real(2.0) * at.mu, D), scaled(at.lambda * trace_of(W), at.R));
    return sum_of(along, scaled(of_spin, turned));
}

fn lame(mu: real, lambda: real) -> array<real, 2> {
    return array<real, 2>(mu, lambda);
}
