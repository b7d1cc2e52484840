"""Condition number of the stiffness matrix beside the shapes of the tetrahedra, before and after `mesh improve`.

    python benches/peers/tetrahedra/condition.py        # after the lines of dirty.py; a minute

The balls of one size are meshed by the program and by Delaunay tetrahedralization of random points, whose slivers are the worst case, and
improved. K is that of linear elasticity (Poisson's ratio 0.3), nodes in the lowest tenth fixed; its extreme eigenvalues are those of
ARPACK. Shewchuk, What Is a Good Linear Finite Element? (2002): one bad tetrahedron raises the largest eigenvalue, and with it the
condition number, without bound; the smallest eigenvalue hardly depends on shapes.
"""

import importlib.metadata
import os
import subprocess
import tempfile

import meshio
import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import eigsh, splu

from measures import dihedral_angles, oriented, volumes
from meshers import PROGRAM
from surfaces import sphere

YOUNG, POISSON = 1.0, 0.3


def stiffness(points, tetrahedra):
    """Linear elasticity on linear tetrahedra, 3n × 3n."""
    lame, shear = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / 2 / (1 + POISSON)
    corners = points[tetrahedra]
    edges = (corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1)
    gradients = np.linalg.inv(edges)
    gradients = np.concatenate([-gradients.sum(axis=1, keepdims=True), gradients], axis=1)
    products = np.einsum("eai,ebj->eabij", gradients, gradients)
    blocks = lame * products + shear * products.transpose(0, 1, 2, 4, 3)
    blocks += shear * np.einsum("eabkk,ij->eabij", products, np.eye(3))
    blocks *= volumes(points, tetrahedra)[:, None, None, None, None]
    rows = 3 * tetrahedra[:, :, None, None, None] + np.arange(3)[:, None]
    columns = 3 * tetrahedra[:, None, :, None, None] + np.arange(3)
    rows, columns = np.broadcast_arrays(rows, columns)
    size = 3 * len(points)
    return sparse.csc_matrix((blocks.ravel(), (rows.ravel(), columns.ravel())), shape=(size, size))


def condition(points, tetrahedra):
    """Extreme eigenvalues of the stiffness with the lowest tenth fixed."""
    z = points[:, 2]
    free = np.repeat(z > z.min() + 0.1 * np.ptp(z), 3)
    matrix = stiffness(points, tetrahedra)[free][:, free].tocsc()
    largest = eigsh(matrix, 1, which="LA", return_eigenvectors=False)[0]
    factor = splu(matrix)
    inverse = sparse.linalg.LinearOperator(matrix.shape, factor.solve)
    return largest, 1 / eigsh(inverse, 1, which="LA", return_eigenvectors=False)[0]


def run(*words):
    done = subprocess.run([PROGRAM, "mesh", *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr)


def main():
    print(f"scipy {importlib.metadata.version('scipy')}\n\n| mesh | tetrahedra | dihedral angles | largest eigenvalue | smallest | condition number |")
    print("|---|---:|---|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        path = lambda name: os.path.join(folder, name)
        meshio.write_points_cells(path("ball.ply"), sphere(levels=5)[0], [("triangle", sphere(levels=5)[1])], binary=False)
        points = np.random.default_rng(0).normal(size=(1200, 3))
        points *= np.random.default_rng(1).random((1200, 1)) ** (1 / 3) / np.linalg.norm(points, axis=1, keepdims=True)
        np.savetxt(path("points.csv"), np.concatenate([points, sphere(levels=3)[0]]), delimiter=",")
        run("from-surface", path("ball.ply"), path("stuffed.vtu"), "--edge", "0.15")
        run("delaunay", path("points.csv"), path("random.vtu"))
        for name in ("stuffed", "random"):
            run("improve", path(name + ".vtu"), path(name + "2.vtu"), "--iterations", "10")
        titles = {"stuffed": "`mesh from-surface`", "stuffed2": "the same after `mesh improve`",
                  "random": "`mesh delaunay` of random points", "random2": "the same after `mesh improve`"}
        for name, title in titles.items():
            mesh = meshio.read(path(name + ".vtu"))
            tetrahedra = oriented(mesh.points, mesh.cells_dict["tetra"])
            angles = dihedral_angles(mesh.points, tetrahedra)
            largest, smallest = condition(mesh.points, tetrahedra)
            print(f"| {title} | {len(tetrahedra)} | {angles.min():.2f}° … {angles.max():.2f}° | {largest:.3g} | {smallest:.3g} | {largest / smallest:.3g} |", flush=True)


main()
