"""The meshers, each in a process of its own with a time limit: some of them crash or hang on dirty input."""

import os
import subprocess
import sys
import tempfile

import meshio
import numpy as np

LIMIT = 240.0
HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAM = os.path.abspath(os.environ.get("PROGRAM", os.path.join(HERE, "../../../target/release/finite-elements-3d")))


def ours(file, out, edge):
    run = subprocess.run([PROGRAM, "mesh", "from-surface", file, out, "--edge", str(edge)], capture_output=True, text=True)
    if run.returncode != 0:
        raise RuntimeError(run.stderr)


def tetgen(file, out, edge):
    import pyvista
    import tetgen

    mesher = tetgen.TetGen(pyvista.read(file))
    found = mesher.tetrahedralize(order=1, quality=True, minratio=1.5, mindihedral=10, fixedvolume=True, maxvolume=edge**3 * 2**0.5 / 12)
    save(out, found[0], found[1])


def pytetwild(file, out, edge):
    import pytetwild

    mesh = meshio.read(file)
    points, tetrahedra = pytetwild.tetrahedralize(np.array(mesh.points, float), mesh.cells_dict["triangle"].astype(np.int32), edge_length_abs=edge, loglevel=6)
    save(out, points, tetrahedra)


def gmsh(file, out, edge):
    """A torus about the axis x from its exact geometry; the file is not read."""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    body = gmsh.model.occ.addTorus(0, 0, 0, 1.0, 0.4)
    gmsh.model.occ.rotate([(3, body)], 0, 0, 0, 0, 1, 0, np.pi / 2)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMin", edge)
    gmsh.option.setNumber("Mesh.MeshSizeMax", edge)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.optimize("Netgen")
    tags, places, _ = gmsh.model.mesh.getNodes()
    _, nodes = gmsh.model.mesh.getElementsByType(4)
    numbers = np.zeros(int(max(tags)) + 1, int)
    numbers[tags.astype(int)] = np.arange(len(tags))
    save(out, places.reshape(-1, 3), numbers[nodes.astype(int)].reshape(-1, 4))


def save(out, points, tetrahedra):
    used, numbers = np.unique(tetrahedra, return_inverse=True)
    points, tetrahedra = np.asarray(points, float)[used], numbers.reshape(-1, 4)
    from measures import oriented

    meshio.write_points_cells(out, points, [("tetra", oriented(points, tetrahedra))], file_format="vtu", binary=True)


def processor_time():
    """Seconds of all threads and of the processes started here: fair on a machine that does other work, too."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def mesh(name, points, faces, edge):
    """Points, tetrahedra and seconds of processor time; or None and the reason."""
    with tempfile.TemporaryDirectory() as folder:
        file, out, seconds = (os.path.join(folder, part) for part in ("in.ply", "out.vtu", "seconds"))
        meshio.write_points_cells(file, points, [("triangle", faces)], binary=False)
        command = [sys.executable, os.path.abspath(__file__), name, file, out, str(edge), seconds]
        try:
            # Some leave files in the current folder.
            run = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, cwd=folder)
        except subprocess.TimeoutExpired:
            return None, f"over {LIMIT:.0f} s"
        if run.returncode != 0 or not os.path.exists(out):
            lines = run.stderr.strip().splitlines()
            return None, f"crash ({run.returncode})" if run.returncode < 0 else (lines or ["no mesh"])[-1][:90]
        found = meshio.read(out)
        return (found.points, found.cells_dict["tetra"], float(open(seconds).read())), None


if __name__ == "__main__":
    _, name, file, out, edge, seconds = sys.argv
    import_first = {"tetgen": "tetgen", "pytetwild": "pytetwild", "gmsh": "gmsh"}.get(name)
    if import_first:
        __import__(import_first)
    start = processor_time()
    globals()[name](file, out, float(edge))
    open(seconds, "w").write(str(processor_time() - start))
