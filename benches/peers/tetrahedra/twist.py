"""Errors of a twisted torus against the number of nodes: our meshes beside those of tetgen and pytetwild.

    python benches/peers/tetrahedra/twist.py        # after the lines of dirty.py; about ten minutes on two cores

The torus (radii 1 m and 0.4 m, about the axis x) is neo-Hookean. All nodes of its boundary are turned about the axis z by 0.5 rad per metre
of z, and the program finds the equilibrium of the others; no mesh has an advantage by where its nodes lie on a fixed part. The
displacement is compared at 20000 points inside with that on a fine mesh of gmsh, made from the exact geometry. The energy, whose
reference is extrapolated from two of them, also shows volume: a mesh inside the surface lacks some, and one that bulges out has more. tetgen is given a surface with triangles of the wanted edge, the others a fine one.
"""

import csv
import importlib.metadata
import json
import os
import subprocess
import tempfile

import meshio
import numpy as np
import pyvista

from measures import boundary, dihedral_angles
from meshers import PROGRAM, mesh
from surfaces import torus

TWIST = 0.5
EDGES = [0.2, 0.141, 0.1]

SCENE = """about = "a twisted torus"
pipeline = "engine"
[mesh]
file = "torus.vtu"
[material]
model = "neo_hookean"
young = 1e5
poisson = 0.3
density = 1000.0
[time]
integrator = "static"
[newton]
tolerance = 1e-8
"""


def probes(count=20000):
    """Points in the torus, spread evenly over a thinner one."""
    random = np.random.default_rng(0)
    points = random.uniform([-0.34, -1.34, -1.34], [0.34, 1.34, 1.34], (20 * count, 3))
    away = np.hypot(np.hypot(points[:, 1], points[:, 2]) - 1.0, points[:, 0])
    return points[away < 0.34][:count]


def interpolated(points, tetrahedra, values):
    """Linear interpolation at the probes."""
    cells = {pyvista.CellType.TETRA: tetrahedra}
    grid = pyvista.UnstructuredGrid(cells, np.ascontiguousarray(points, float))
    grid.point_data["values"] = values
    found = pyvista.PolyData(probes()).sample(grid)
    assert found["vtkValidPointMask"].all(), "a probe lies in no tetrahedron"
    return np.asarray(found["values"])


def solved(points, tetrahedra):
    """Elastic energy in equilibrium, J, and displacements at the probes, m."""
    with tempfile.TemporaryDirectory() as folder:
        path = lambda name: os.path.join(folder, name)
        meshio.write_points_cells(path("torus.vtu"), points, [("tetra", tetrahedra)], binary=True)
        with open(path("torus.toml"), "w") as scene:
            scene.write(SCENE)
            for node in np.unique(boundary(tetrahedra)):
                x, y, z = points[node]
                sine, cosine = np.sin(TWIST * z), np.cos(TWIST * z)
                move = [cosine * x - sine * y - x, sine * x + cosine * y - y, 0.0]
                scene.write(f"[[prescribed]]\nnodes = [{node}]\ndisplacement = {[float(value) for value in move]}\n")
        command = [PROGRAM, path("torus.toml"), "--headless", "--steps", "1", "--energies", path("e.csv"), "--state", path("q.json")]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode != 0:
            raise SystemExit(run.stderr)
        with open(path("e.csv")) as rows:
            energy = float(list(csv.DictReader(rows))[-1]["potential"])
        positions = np.array(json.load(open(path("q.json")))["q"]).reshape(-1, 3)
        return energy, interpolated(points, tetrahedra, positions - points)


def row(name, edge):
    surface = torus(edge if name == "tetgen" else 0.02)
    found, reason = mesh(name, *surface, edge)
    if reason:
        raise SystemExit(f"{name} at {edge}: {reason}")
    points, tetrahedra, _ = found
    angles = dihedral_angles(points, tetrahedra)
    return len(points), len(tetrahedra), angles.min(), angles.max(), *solved(points, tetrahedra)


def reference():
    """Energy by extrapolation of order 2 in the edge, which is taken from the number of tetrahedra, and displacements."""
    rows = [row("gmsh", edge) for edge in (0.07, 0.04)]
    (n, coarse), (m, fine) = [(row[1] ** (-2 / 3), row[4]) for row in rows]
    whole = (n * fine - m * coarse) / (n - m)
    print(f"reference {whole:.6f} J, from {coarse:.6f} J ({rows[0][1]} tetrahedra) and {fine:.6f} J ({rows[1][1]}) of gmsh "
          f"{importlib.metadata.version('gmsh')}, whose displacements differ by {difference(rows[0][5], rows[1][5]):.4%}\n")
    return whole, rows[1][5]


def difference(found, exact):
    """Root mean square of the difference over that of the displacement."""
    return np.sqrt(np.mean((found - exact) ** 2) / np.mean(exact**2))


def main():
    exact, displacements = reference()
    print("| mesher | nodes | tetrahedra | dihedral angles | energy | displacement |\n|---|---:|---:|---|---:|---:|")
    fits = []
    for name in ("ours", "tetgen", "pytetwild"):
        version = "" if name == "ours" else " " + importlib.metadata.version(name)
        errors = []
        for edge in EDGES:
            nodes, count, least, most, value, found = row(name, edge)
            off = difference(found, displacements)
            errors.append((np.log(nodes), np.log(off)))
            print(f"| {name}{version} | {nodes} | {count} | {least:.1f}° … {most:.1f}° | {value / exact - 1:+.3%} | {off:.4%} |", flush=True)
        slope, at = np.polyfit(*np.array(errors).T, 1)
        fits.append((name, slope, np.exp(at + slope * np.log(3000))))
    print("\nDisplacement, fitted: " + "; ".join(f"{name} {error:.3%} at 3000 nodes, order {-3 * slope:.1f} in the edge" for name, slope, error in fits))


if __name__ == "__main__":
    main()
