"""Vertex block descent and XPBD beside those of pbatoolkit: where sweeps lead to, and the time of a sweep on one thread.

    cargo build --release -p fem-bench
    pip install -r benches/peers/pbat/requirements.txt
    python benches/peers/pbat/compare.py > docs/reference/pbatoolkit.md      # about a minute

Options: `--ours PROGRAM` (fem-bench), `--rounds N` (7), `--cells N` (12): cells along the shorter sides of the timed beam.

Both programs bend a beam under its weight with lumped masses, from the same start of every step, with the nodes in the same colours. The laws
differ: pbatoolkit's stable neo-Hookean law has no logarithm. So the iterates of each program are compared with those of a plain
implementation in this file, which takes either law; a beam of few cells and a few sweeps show a difference in any term. The times
are those of a beam of many cells: the median over rounds, in which the programs take turns, of a step of many sweeps over their number.

XPBD has no common iterates: pbatoolkit has two constraints in each element (Macklin, Müller 2021), ours one, or six with the residual of the equation of
motion. Its table shows how far sweeps stay from the converged step of implicit Euler of the same law, and the time of a sweep.
"""

import argparse
import itertools
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
from importlib.metadata import version

# One thread: pbatoolkit takes as many as the process may run on.
os.sched_setaffinity(0, [max(os.sched_getaffinity(0))])
os.environ["RAYON_NUM_THREADS"] = "1"

import numpy as np  # noqa: E402
from pbatoolkit import pbat  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
YOUNG, POISSON, DENSITY, GRAVITY = 1e5, 0.3, 1000.0, 9.81
MU, LAMBDA = YOUNG / (2 + 2 * POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
SCENE = """pipeline = "engine"
[mesh]
file = "beam.node"
[material]
model = "stable_neo_hookean"
young = {young!r}
poisson = {poisson!r}
density = {density!r}
[mass]
lumped = true
[gravity]
acceleration = [0, 0, {gravity!r}]
[fixed]
plane = {{ axis = "x", below = 1e-9 }}
[time]
dt = {dt!r}
integrator = "{integrator}"
[iterations]
count = {sweeps}
{keys}"""


class Beam:
    """A beam of 4 × 1 × 1 m in tetrahedra, its inner nodes moved a little, and its nodes in colours."""

    def __init__(self, cells):
        shape = (4 * cells, cells, cells)
        grid = np.array(list(itertools.product(*(range(n + 1) for n in shape))), dtype=float)
        inner = ((grid > 0) & (grid < shape)).all(axis=1)
        shift = np.random.default_rng(1).uniform(-0.1, 0.1, grid.shape)
        self.rest = (grid + shift * inner[:, None]) / cells
        number = lambda place: (place[0] * (cells + 1) + place[1]) * (cells + 1) + place[2]
        tetrahedra = []
        for cell in itertools.product(*map(range, shape)):
            for way in itertools.permutations(range(3)):
                place, corners = list(cell), [number(cell)]
                for axis in way:
                    place[axis] += 1
                    corners.append(number(place))
                edges = self.rest[corners[1:]] - self.rest[corners[0]]
                tetrahedra.append(corners if np.linalg.det(edges) > 0 else [corners[i] for i in (0, 1, 3, 2)])
        self.elements = np.array(tetrahedra)
        self.edges = np.stack([self.rest[self.elements[:, a]] - self.rest[self.elements[:, 0]] for a in (1, 2, 3)], axis=2)
        self.volumes = np.linalg.det(self.edges) / 6
        self.masses = np.zeros(len(self.rest))
        np.add.at(self.masses, self.elements.ravel(), np.repeat(DENSITY * self.volumes / 4, 4))
        self.fixed = self.rest[:, 0] < 1e-9
        self.around = [[] for _ in self.rest]
        for element, corners in enumerate(self.elements):
            for local, node in enumerate(corners):
                self.around[node].append((element, local))
        self.colors = self.color()

    def color(self):
        """The first colour that no neighbour has, in the order in which fem-engine numbers a small body: free nodes along the beam, then fixed ones."""
        colors = np.full(len(self.rest), -1)
        for node in np.lexsort((*self.rest.T[::-1], self.fixed)):
            taken = {colors[neighbor] for element, _ in self.around[node] for neighbor in self.elements[element]}
            colors[node] = next(color for color in itertools.count() if color not in taken)
        return [[node for node in np.flatnonzero(colors == color) if not self.fixed[node]] for color in range(colors.max() + 1)]

    def write(self, folder, dt, sweeps, method):
        """The mesh and the scene, as fem-bench reads them."""
        rows = lambda table: "".join(f"{i} {' '.join(map(repr, row))}\n" for i, row in enumerate(table.tolist()))
        (folder / "beam.node").write_text(f"{len(self.rest)} 3 0 0\n{rows(self.rest)}")
        (folder / "beam.ele").write_text(f"{len(self.elements)} 4 0\n{rows(self.elements)}")
        numbers = {"young": YOUNG, "poisson": POISSON, "density": DENSITY, "gravity": -GRAVITY}
        (folder / "beam.toml").write_text(SCENE.format(dt=dt, sweeps=sweeps, integrator=method[0], keys=method[1], **numbers))


def our_law(I, J):
    """a and b of P = a F + b cof, and s and r of ∂P/∂F = a 1 + s F⊗F + r cof⊗cof + b ∂cof/∂F, for fem-engine's stable neo-Hookean law."""
    mu, bulk = 4 / 3 * MU, LAMBDA + 5 / 6 * MU
    return mu * I / (I + 1), bulk * (J - 1) - MU, 2 * mu / (I + 1) ** 2, bulk + 0 * J


def their_law(I, J):
    """The same for ψ = μ/2 (I − 3) + λ/2 (J − 1 − μ/λ)² with λ + μ in place of λ, so that both have Lamé's constants μ and λ at small strain."""
    return MU + 0 * I, (LAMBDA + MU) * (J - 1) - MU, 0 * I, LAMBDA + MU + 0 * J


def descend(beam, law, volumes, masses, dt, steps, sweeps):
    """Positions  (n × 3)  m after steps of vertex block descent, written down as it is published."""
    slopes = np.zeros((len(volumes), 4, 3))
    slopes[:, 1:] = np.linalg.inv(beam.edges)
    slopes[:, 0] = -slopes[:, 1:].sum(axis=1)
    x, v = beam.rest.copy(), np.zeros_like(beam.rest)
    for _ in range(steps):
        start = x.copy()
        y = np.where(beam.fixed[:, None], x, x + dt * v + dt * dt * np.array([0, 0, -GRAVITY]))
        x = y.copy()
        for node in itertools.chain(*(beam.colors * sweeps)):
            element, local = np.array(beam.around[node]).T
            F = np.einsum("eai,eaj->eij", x[beam.elements[element]], slopes[element])
            I, J = (F * F).sum(axis=(1, 2)), np.linalg.det(F)
            g, V = slopes[element, local], volumes[element]
            f, c = np.einsum("eij,ej->ei", F, g), np.einsum("eji,ej->ei", np.linalg.inv(F), g) * J[:, None]
            a, b, s, r = law(I, J)
            inertia = masses[node] / dt**2
            force = inertia * (x[node] - y[node]) + (V * a) @ f + (V * b) @ c
            along = inertia + (V * a * (g * g).sum(axis=1)).sum()
            block = along * np.eye(3) + (f.T * (V * s)) @ f + (c.T * (V * r)) @ c
            x[node] = x[node] - np.linalg.solve(block, force)
        v = (x - start) / dt
    return x


def columns(table, kind):
    """A table as pbatoolkit takes it."""
    return np.asfortranarray(np.asarray(table, dtype=kind).T)


class Theirs:
    """pbatoolkit's vertex block descent of a beam, with the colours of the beam."""

    def __init__(self, beam):
        vbd, count = pbat.sim.vbd, len(beam.elements)
        data = vbd.Data().with_volume_mesh(columns(beam.rest, float), columns(beam.elements, np.int64))
        data = data.with_surface_mesh(np.zeros(0, dtype=np.int64), np.zeros((3, 0), dtype=np.int64, order="F"))
        data = data.with_material(np.full(count, DENSITY), np.full(count, MU), np.full(count, LAMBDA + MU))
        data = data.with_acceleration(columns(np.tile([0, 0, -GRAVITY], (len(beam.rest), 1)), float))
        data = data.with_dirichlet_vertices(np.flatnonzero(beam.fixed).astype(np.int64), muD=0.0)
        data = data.construct()
        data.Pptr = np.cumsum([0, *map(len, beam.colors)]).astype(np.int64)
        data.Padj = np.concatenate(beam.colors).astype(np.int64)
        # Its weights of quadrature have six digits, so that volumes and masses are 2e-6 off.
        self.volumes, self.masses = np.array(data.wg), np.array(data.m)
        self.integrator = vbd.Integrator(data)
        # In version 0.0.11 this name stands for x + Δt v + Δt² a, the start of ours; descend() would tell if it did not.
        self.integrator.strategy = vbd.InitializationStrategy.KineticEnergyMinimum

    def step(self, dt, sweeps):
        start = time.perf_counter()
        self.integrator.step(dt, sweeps, 1)
        return time.perf_counter() - start

    def positions(self):
        return np.array(self.integrator.x).T


class TheirXpbd(Theirs):
    """pbatoolkit's XPBD of a beam, its elements in colours."""

    def __init__(self, beam):
        colors = np.full(len(beam.elements), -1)
        for element, corners in enumerate(beam.elements):
            taken = {colors[other] for node in corners for other, _ in beam.around[node]}
            colors[element] = next(color for color in itertools.count() if color not in taken)
        parts = [np.flatnonzero(colors == color) for color in range(colors.max() + 1)]
        data = pbat.sim.xpbd.Data().with_volume_mesh(columns(beam.rest, float), columns(beam.elements, np.int64))
        # It has contacts between the triangles of a surface and refuses none of them: one triangle, with nothing to meet.
        data = data.with_surface_mesh(np.arange(4, dtype=np.int64), columns([[0, 1, 2]], np.int64))
        data = data.with_acceleration(columns(np.tile([0, 0, -GRAVITY], (len(beam.rest), 1)), float))
        data = data.with_mass_inverse(1 / beam.masses)
        data = data.with_elastic_material(columns(np.tile([MU, LAMBDA + MU], (len(beam.elements), 1)), float))
        data = data.with_dirichlet_vertices(np.flatnonzero(beam.fixed).astype(np.int64))
        data = data.with_partitions(np.cumsum([0, *map(len, parts)]).tolist(), np.concatenate(parts).tolist())
        self.integrator = pbat.sim.xpbd.Integrator(data.construct(), 1, 1)


VBD, XPBD, PLAIN = ("vbd", ""), ("xpbd", ""), ("xpbd", "residual = false\n")


def ours(program, beam, dt, steps, sweeps, method=VBD):
    """Positions  (n × 3)  m, and the median of the seconds of a step."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        beam.write(folder, dt, sweeps, method)
        command = [program, "run", folder / "beam.toml", "--steps", str(steps), "--data", folder]
        done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"error: fem-bench failed: {done.stderr.strip()}")
    found = json.loads(done.stdout)
    return np.array(found["positions"]).reshape(-1, 3), found["wall_per_step_median"]


def check(program):
    """Compares the iterates of both programs with the plain implementation; ends with an error where they differ."""
    beam, dt, steps = Beam(2), 0.02, 4
    print("| sweeps in each of 4 steps | ours, m | pbatoolkit, m | largest displacement, m |\n|---:|---:|---:|---:|")
    for sweeps in (1, 2, 5):
        theirs = Theirs(beam)
        for _ in range(steps):
            theirs.step(dt, sweeps)
        expected = [
            descend(beam, our_law, beam.volumes, beam.masses, dt, steps, sweeps),
            descend(beam, their_law, theirs.volumes, theirs.masses, dt, steps, sweeps),
        ]
        found = [ours(program, beam, dt, steps, sweeps)[0], theirs.positions()]
        errors = [np.abs(a - b).max() for a, b in zip(found, expected)]
        largest = np.abs(found[0] - beam.rest).max()
        print(f"| {sweeps} | {errors[0]:.1e} | {errors[1]:.1e} | {largest:.2f} |", flush=True)
        if max(errors) > 1e-10:
            sys.exit("error: the iterates differ from those of the plain implementation")


def converged(program):
    """Prints how far the sweeps of XPBD stay from the converged step, which vertex block descent gives for each law."""
    beam, dt, steps = Beam(2), 0.02, 4
    descent = Theirs(beam)
    exact = [
        ours(program, beam, dt, steps, 1000)[0],
        descend(beam, their_law, descent.volumes, descent.masses, dt, steps, 200),
    ]
    size = np.abs(exact[0] - beam.rest).max()
    print("\n## XPBD\n\nLargest distance of a node from the converged steps of the same law, over the largest displacement, after 4 steps.\n")
    print("| sweeps of a step | ours | ours, `residual = false` | pbatoolkit |\n|---:|---:|---:|---:|")
    for sweeps in (1, 5, 20, 100):
        theirs = TheirXpbd(beam)
        for _ in range(steps):
            theirs.step(dt, sweeps)
        found = [ours(program, beam, dt, steps, sweeps, method)[0] - exact[0] for method in (XPBD, PLAIN)]
        errors = [np.abs(apart).max() / size for apart in [*found, theirs.positions() - exact[1]]]
        print(f"| {sweeps} | {errors[0]:.1e} | {errors[1]:.1e} | {errors[2]:.1e} |", flush=True)


def race(program, cells, rounds):
    """Prints the median time of a sweep of each program."""
    beam, dt, sweeps = Beam(cells), 0.01, 40
    methods = {"VBD": (VBD, Theirs(beam)), "XPBD": (XPBD, None), "XPBD, one constraint": (PLAIN, TheirXpbd(beam))}
    times = {name: ([], []) for name in methods}
    for _ in range(rounds):
        for name, (method, theirs) in methods.items():
            times[name][0].append(ours(program, beam, dt, 3, sweeps, method)[1] / sweeps)
            if theirs:
                times[name][1].append(theirs.step(dt, sweeps) / sweeps)
    print("\n## Time of a sweep\n")
    print(f"A beam of {len(beam.rest)} nodes and {len(beam.elements)} tetrahedra, {len(beam.colors)} colours of nodes; medians of {rounds} rounds in turn.")
    print("pbatoolkit's XPBD, with two constraints in each element, is beside ours with one.\n")
    print("| sweep | ours, ms | pbatoolkit, ms | ratio |\n|---|---:|---:|---:|")
    for name, (mine, theirs) in times.items():
        mine = 1e3 * statistics.median(mine)
        other = f"{1e3 * statistics.median(theirs):.2f} | {1e3 * statistics.median(theirs) / mine:.1f}" if theirs else "– | –"
        print(f"| {name} | {mine:.2f} | {other} |")


def machine():
    """The first line of the page."""
    text_of = lambda command: subprocess.run(command, capture_output=True, text=True, cwd=ROOT).stdout.strip()
    cpu = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), "unknown")
    commit, rustc = text_of(["git", "rev-parse", "--short", "HEAD"]), text_of(["rustc", "--version"])
    return f"Measured on {time.strftime('%Y-%m-%d')}: pbatoolkit {version('pbatoolkit')} from PyPI, finite-elements-3d at {commit}, {rustc}, RUSTFLAGS=\"{os.environ.get('RUSTFLAGS', '')}\", {cpu}, one thread, double precision."


PAGE = """# Beside pbatoolkit

{machine}
`python benches/peers/pbat/compare.py > docs/reference/pbatoolkit.md` prints this page.

A beam of 4 × 1 × 1 m, clamped at one end, bends under its weight: E = {young:g} Pa, ν = {poisson}, stable neo-Hookean, lumped mass. pbatoolkit's law has no logarithm, so each
program is compared with the same method in its own law.

## Vertex block descent

Both programs sweep over the nodes in the same colours. Iterates are compared with those of a plain implementation in NumPy; the program ends with an error if they differ by more than 1e-10 m.
"""


def main():
    targets = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ours", type=pathlib.Path, default=targets / "release/fem-bench")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--cells", type=int, default=12)
    arguments = parser.parse_args()
    if not arguments.ours.is_file():
        parser.error(f"{arguments.ours}: no such program; build it as the first lines of --help say, or give its path")
    print(PAGE.format(machine=machine(), young=YOUNG, poisson=POISSON))
    check(arguments.ours)
    converged(arguments.ours)
    race(arguments.ours, arguments.cells, arguments.rounds)


main()
