"""Reads the files that this library writes with Gmsh, meshio, PyVista and trimesh, and prints what each finds.

    cargo build --release && pip install gmsh meshio pyvista trimesh scipy
    python benches/peers/meshes/read_ours.py target/release/finite-elements-3d

Each cell has the number of elements and the relative error of the volume (of a body) or of the area (of a surface); `-` where the program
does not read the format. Gmsh 4.15 calls its reading of binary PLY experimental and refuses those of trimesh and VTK as well.
"""

import os
import subprocess
import sys
import tempfile

import gmsh
import meshio
import numpy
import pyvista
import trimesh

FILES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../crates/mesh/tests/mesh/other_programs/matrix")
BODY, SURFACE = ["msh", "mesh", "vtk", "vtu", "inp", "node"], ["obj", "ply", "stl"]


def size(x, cells):
    corners = [x[cells[:, i]] for i in range(cells.shape[1])]
    normals = numpy.cross(corners[1] - corners[0], corners[2] - corners[0])
    if len(corners) == 4:
        return abs(numpy.einsum("ij,ij->i", normals, corners[3] - corners[0]).sum()) / 6
    return numpy.linalg.norm(normals, axis=1).sum() / 2


def of_gmsh(path):
    if path.endswith((".vtu", ".node", ".obj", ".inp")):
        return None
    # Gmsh takes no further file after one that it could not read.
    gmsh.finalize()
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(path)
    tags, x, _ = gmsh.model.mesh.getNodes()
    index = numpy.zeros(int(tags.max()) + 1, int)
    index[tags] = range(len(tags))
    for kind, nodes in [(4, 4), (2, 3)]:
        cells = gmsh.model.mesh.getElementsByType(kind)[1].reshape(-1, nodes)
        if len(cells):
            return x.reshape(-1, 3), index[cells]
    return None


def of_meshio(path):
    mesh = meshio.read(path)
    return mesh.points, mesh.cells_dict["tetra" if "tetra" in mesh.cells_dict else "triangle"]


def of_pyvista(path):
    if not path.endswith((".vtk", ".vtu", ".obj", ".ply", ".stl")):
        return None
    grid = pyvista.read(path).cast_to_unstructured_grid()
    return numpy.asarray(grid.points, float), grid.cells_dict.get(10, grid.cells_dict.get(5))


def of_trimesh(path):
    if not path.endswith((".obj", ".ply", ".stl")):
        return None
    mesh = trimesh.load(path, process=False)
    return mesh.vertices, mesh.faces


def cell(read, path, expected):
    try:
        found = read(path)
    except Exception as error:
        return type(error).__name__
    return "-" if found is None else f"{len(found[1])}, {size(*found) / expected - 1:.0e}"


gmsh.initialize()
readers = [("Gmsh", of_gmsh), ("meshio", of_meshio), ("PyVista", of_pyvista), ("trimesh", of_trimesh)]
print("| file | " + " | ".join(name for name, _ in readers) + " |\n|---|" + "---|" * len(readers))
with tempfile.TemporaryDirectory() as folder:
    for source, endings, expected in [("gmsh_4.1_text.msh", BODY, 2.0), ("trimesh.obj", SURFACE, 10.0)]:
        for ending in endings:
            path = os.path.join(folder, f"ours.{ending}")
            subprocess.run([sys.argv[1], "mesh", "convert", os.path.join(FILES, source), path], check=True, capture_output=True)
            print(f"| .{ending} | " + " | ".join(cell(read, path, expected) for _, read in readers) + " |")
