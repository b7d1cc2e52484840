"""Error of the energy of a twisted torus against the number of nodes: our meshes beside those of tetgen and pytetwild.

    python benches/peers/tetrahedra/twist.py        # after the lines of dirty.py; about ten minutes on two cores

The torus (radii 1 m and 0.4 m, about the axis x) is neo-Hookean. All nodes of its boundary are turned about the axis z by 0.5 rad per metre
of z, and the program finds the equilibrium of the others. So the error is that of the elements and of the boundary's shape; no mesh has
an advantage by where its nodes lie on a fixed part. The reference is extrapolated from two fine meshes of gmsh, made from the exact
geometry. tetgen is given a surface with triangles of the wanted edge, the others a fine one.
"""

import csv
import importlib.metadata
import os
import subprocess
import tempfile

import meshio
import numpy as np

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


def energy(points, tetrahedra):
    """Elastic energy in equilibrium, J."""
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
        command = [PROGRAM, path("torus.toml"), "--headless", "--steps", "1", "--energies", path("e.csv")]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode != 0:
            raise SystemExit(run.stderr)
        with open(path("e.csv")) as rows:
            return float(list(csv.DictReader(rows))[-1]["potential"])


def row(name, edge):
    surface = torus(edge if name == "tetgen" else 0.02)
    found, reason = mesh(name, *surface, edge)
    if reason:
        raise SystemExit(f"{name} at {edge}: {reason}")
    points, tetrahedra, _ = found
    angles = dihedral_angles(points, tetrahedra)
    return len(points), len(tetrahedra), angles.min(), angles.max(), energy(points, tetrahedra)


def reference():
    """Extrapolation of order 2 in the edge, which is taken from the number of tetrahedra."""
    rows = [row("gmsh", edge) for edge in (0.07, 0.045)]
    (n, coarse), (m, fine) = [(row[1] ** (-2 / 3), row[4]) for row in rows]
    whole = (n * fine - m * coarse) / (n - m)
    print(f"reference {whole:.6f} J, from {coarse:.6f} J ({rows[0][1]} tetrahedra) and {fine:.6f} J ({rows[1][1]}) of gmsh "
          f"{importlib.metadata.version('gmsh')}\n")
    return whole


def main():
    exact = reference()
    print("| mesher | nodes | tetrahedra | dihedral angles | energy, J | error |\n|---|---:|---:|---|---:|---:|")
    fits = []
    for name in ("ours", "tetgen", "pytetwild"):
        version = "" if name == "ours" else " " + importlib.metadata.version(name)
        errors = []
        for edge in EDGES:
            nodes, count, least, most, value = row(name, edge)
            errors.append((np.log(nodes), np.log(abs(value / exact - 1))))
            print(f"| {name}{version} | {nodes} | {count} | {least:.1f}° … {most:.1f}° | {value:.5f} | {value / exact - 1:+.3%} |", flush=True)
        slope, at = np.polyfit(*np.array(errors).T, 1)
        fits.append((name, slope, np.exp(at + slope * np.log(3000))))
    print("\nFitted: " + "; ".join(f"{name} {error:.2%} at 3000 nodes, order {-3 * slope:.1f} in the edge" for name, slope, error in fits))


if __name__ == "__main__":
    main()
