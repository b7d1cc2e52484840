// Explicit simulation of flat bodies as a thesis (2019) describes it, in its own words of C++: linear corotated triangles with the rotation
// from a QR decomposition, one evaluation of the forces in each substep, lumped masses, semi-implicit Euler.
//
//   g++ -O3 -march=native -o sandbox2d main.cpp
//   ./sandbox2d MESH.obj [FRAMES]
//
// MESH.obj has lines `v x y z` and `f a b c`, as `mesh from-picture` and `mesh convert` write them. Prints the number of triangles, the
// median time of a frame of 40 substeps and the time of a substep, on one thread.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Real = float;  // as in the thesis

struct Vec2 {
    Real x = 0, y = 0;
};
Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
Vec2 operator*(Real s, Vec2 a) { return {s * a.x, s * a.y}; }

// Columns p and q.
struct Mat2 {
    Vec2 p, q;
};
Vec2 operator*(const Mat2& m, Vec2 v) { return v.x * m.p + v.y * m.q; }
Mat2 operator*(const Mat2& a, const Mat2& b) { return {a * b.p, a * b.q}; }
Mat2 transpose(const Mat2& m) { return {{m.p.x, m.q.x}, {m.p.y, m.q.y}}; }

struct Particle {
    Vec2 x, v, force;
    Real inverse_mass = 0;
};

struct Triangle {
    int nodes[3];
    Mat2 inverse_rest;
};

constexpr Real kLame = 45000;       // λ = μ, Pa
constexpr Real kDensity = 140.5;    // kg/m³
constexpr Real kThird = Real(1) / 3;  // of the forces of the edges: the thesis' mistake, 1/2 is right
constexpr Real kStep = 1e-5;        // s
constexpr int kSubsteps = 40;

// The rotation of a QR decomposition: Gram–Schmidt on the first column.
Mat2 rotation(const Mat2& F) {
    const Real length = std::sqrt(F.p.x * F.p.x + F.p.y * F.p.y);
    const Vec2 r = (Real(1) / length) * F.p;
    return {r, {-r.y, r.x}};
}

void add_forces(std::vector<Particle>& particles, const std::vector<Triangle>& triangles) {
    for (const Triangle& t : triangles) {
        Particle &a = particles[t.nodes[0]], &b = particles[t.nodes[1]], &c = particles[t.nodes[2]];
        const Mat2 F = Mat2{b.x - a.x, c.x - a.x} * t.inverse_rest;
        const Mat2 R = rotation(F);
        const Mat2 S = transpose(R) * F;
        const Real exx = S.p.x - 1, eyy = S.q.y - 1, exy = Real(0.5) * (S.p.y + S.q.x);
        const Real pressure = kLame * (exx + eyy);
        const Mat2 stress = R * Mat2{{2 * kLame * exx + pressure, 2 * kLame * exy}, {2 * kLame * exy, 2 * kLame * eyy + pressure}};
        const Mat2 turned = stress * transpose(R);
        // Each edge's traction times its length goes to its two nodes.
        const auto edge = [&](Particle& from, Particle& to) {
            const Vec2 along = to.x - from.x;
            const Vec2 f = kThird * (turned * Vec2{along.y, -along.x});
            from.force = from.force - f;
            to.force = to.force - f;
        };
        edge(a, b);
        edge(b, c);
        edge(c, a);
    }
}

void integrate(std::vector<Particle>& particles) {
    for (Particle& p : particles) {
        p.v = p.v + (kStep * p.inverse_mass) * p.force;
        p.x = p.x + kStep * p.v;
        p.force = {};
    }
}

bool read(const char* path, std::vector<Particle>& particles, std::vector<Triangle>& triangles) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            Particle p;
            words >> p.x.x >> p.x.y;
            particles.push_back(p);
        } else if (kind == "f") {
            Triangle t{};
            for (int& node : t.nodes) {
                std::string word;
                words >> word;
                node = std::atoi(word.c_str()) - 1;
                if (node < 0 || node >= static_cast<int>(particles.size())) return false;
            }
            triangles.push_back(t);
        }
    }
    return !triangles.empty();
}

void prepare(std::vector<Particle>& particles, std::vector<Triangle>& triangles) {
    std::vector<Real> masses(particles.size());
    for (Triangle& t : triangles) {
        const Vec2 a = particles[t.nodes[0]].x, u = particles[t.nodes[1]].x - a, v = particles[t.nodes[2]].x - a;
        const Real determinant = u.x * v.y - u.y * v.x;
        t.inverse_rest = {{v.y / determinant, -u.y / determinant}, {-v.x / determinant, u.x / determinant}};
        for (int node : t.nodes) masses[node] += kDensity * determinant / 6;
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
        particles[i].inverse_mass = 1 / masses[i];
        // A disturbance, so that the motion is not zero.
        particles[i].x.x += Real(1e-6) * Real(i % 7);
    }
}

}  // namespace

int main(int count, char** words) {
    if (count < 2) {
        std::fprintf(stderr, "usage: sandbox2d MESH.obj [FRAMES]\n");
        return 2;
    }
    std::vector<Particle> particles;
    std::vector<Triangle> triangles;
    if (!read(words[1], particles, triangles)) {
        std::fprintf(stderr, "%s: has no triangles, or one of an unknown vertex; give an .obj of triangles\n", words[1]);
        return 2;
    }
    prepare(particles, triangles);
    const int frames = count > 2 ? std::max(1, std::atoi(words[2])) : 30;
    std::vector<double> times;
    for (int frame = 0; frame < frames; ++frame) {
        const auto start = std::chrono::steady_clock::now();
        for (int substep = 0; substep < kSubsteps; ++substep) {
            add_forces(particles, triangles);
            integrate(particles);
        }
        times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    std::sort(times.begin(), times.end());
    const double median = times[times.size() / 2];
    for (const Particle& p : particles) {
        if (!std::isfinite(p.x.x) || !std::isfinite(p.x.y)) {
            std::fprintf(stderr, "the motion has exploded\n");
            return 1;
        }
    }
    std::printf("%zu triangles: %.3f ms a frame of %d substeps, %.4f ms a substep\n", triangles.size(), median, kSubsteps, median / kSubsteps);
}
