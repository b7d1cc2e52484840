"""Writes one bar in the formats and options of several programs to `matrix/`, and what the program's own reader finds in each file to
`matrix/expected.json`. Needs `pip install gmsh meshio pyvista trimesh scipy pymeshlab`. Geometry of our own; free of rights of others.
"""

import collections
import json
import os

import gmsh
import meshio
import numpy
import pymeshlab
import pyvista
import trimesh

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "matrix")
os.makedirs(HERE, exist_ok=True)
os.chdir(HERE)
EXPECTED = {}
DIMENSION = {"vertex": 0, "line": 1, "triangle": 2, "tetra": 3}
KINDS = ["points", "edges", "triangles", "tetrahedra"]


def volume(x, cells):
    a, b, c, d = (x[cells[:, i]] for i in range(4))
    return float(numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a).sum() / 6)


def area(x, cells):
    a, b, c = (x[cells[:, i]] for i in range(3))
    return float(numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2)


def expect(name, x, cells, sets):
    """Notes what a file holds: its tetrahedra, or else its triangles."""
    is_body = cells.shape[1] == 4
    EXPECTED[name] = {
        "nodes": len(numpy.unique(cells)),
        "elements": len(cells),
        "size": volume(x, cells) if is_body else area(x, cells),
        "sets": sets,
    }


def bar():
    """Two boxes with groups of every dimension."""
    gmsh.model.add("bar")
    a = gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    b = gmsh.model.occ.addBox(1, 0, 0, 1, 1, 1)
    gmsh.model.occ.fragment([(3, a)], [(3, b)])
    gmsh.model.occ.synchronize()
    at = lambda dim, *box: [tag for _, tag in gmsh.model.getEntitiesInBoundingBox(*box, dim)]
    e = 1e-3
    gmsh.model.addPhysicalGroup(3, [a], 10, "soft")
    gmsh.model.addPhysicalGroup(3, [b], 20, "stiff part")
    gmsh.model.addPhysicalGroup(2, at(2, -e, -e, -e, e, 1 + e, 1 + e), 7, "clamped")
    gmsh.model.addPhysicalGroup(1, at(1, -e, -e, -e, e, e, 1 + e), 4, "edge")
    gmsh.model.addPhysicalGroup(0, at(0, -e, -e, -e, e, e, e), 3, "corner")
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.8)
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.8)
    gmsh.model.mesh.generate(3)


def of_gmsh(name):
    """Reads a file with Gmsh."""
    gmsh.clear()
    gmsh.open(name)
    tags, x, _ = gmsh.model.mesh.getNodes()
    x = x.reshape(-1, 3)
    index = numpy.zeros(int(tags.max()) + 1, int)
    index[tags] = range(len(tags))
    sets = collections.defaultdict(lambda: [0, 0, 0, 0])
    for dim, group in gmsh.model.getPhysicalGroups():
        label = gmsh.model.getPhysicalName(dim, group) or str(group)
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, group):
            sets[label][dim] += sum(len(list) for list in gmsh.model.mesh.getElements(dim, entity)[1])
    dim = 3 if len(gmsh.model.mesh.getElementsByType(4)[0]) else 2
    cells = gmsh.model.mesh.getElementsByType(4 if dim == 3 else 2)[1].reshape(-1, dim + 1)
    expect(name, x, index[cells], {k: dict(zip(KINDS, v)) for k, v in sets.items()})


def of_meshio(name, tag=None):
    """Reads a file with meshio; sets are the values of a field of cells, or the file's sets of cells."""
    mesh = meshio.read(name)
    kind = "tetra" if "tetra" in mesh.cells_dict else "triangle"
    sets = collections.defaultdict(lambda: [0, 0, 0, 0])
    for i, block in enumerate(mesh.cells):
        if tag:
            for value in mesh.cell_data[tag][i]:
                sets[str(int(value))][DIMENSION[block.type]] += int(value != 0)
        for set_name, of_blocks in mesh.cell_sets.items():
            if of_blocks[i] is not None and set_name.split(":")[0] != "gmsh":
                sets[set_name][DIMENSION[block.type]] += len(of_blocks[i])
    sets.pop("0", None)
    cells = mesh.cells_dict[kind]
    expect(name, mesh.points, cells, {k: dict(zip(KINDS, v)) for k, v in sets.items()})


def of_pyvista(name, tag=None):
    mesh = pyvista.read(name)
    grid = mesh.cast_to_unstructured_grid()
    cells = grid.cells_dict.get(10, grid.cells_dict.get(5))
    sets = collections.defaultdict(lambda: [0, 0, 0, 0])
    if tag:
        for kind, value in zip(grid.celltypes, grid.cell_data[tag]):
            sets[str(int(value))][{1: 0, 3: 1, 5: 2, 10: 3}[kind]] += 1
    expect(name, numpy.asarray(grid.points, float), cells, {k: dict(zip(KINDS, v)) for k, v in sets.items()})


def of_trimesh(name):
    mesh = trimesh.load(name, process=False)
    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    expect(name, mesh.vertices, numpy.asarray(mesh.faces), {})


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)

# Gmsh
bar()
for version in ["1", "2.2", "4", "4.1"]:
    for binary in [0, 1] if version in ["2.2", "4.1"] else [0]:
        gmsh.option.setNumber("Mesh.MshFileVersion", float(version))
        gmsh.option.setNumber("Mesh.Binary", binary)
        gmsh.write(f"gmsh_{version}_{'binary' if binary else 'text'}.msh")
gmsh.option.setNumber("Mesh.Binary", 0)
gmsh.write("gmsh.mesh")
gmsh.write("gmsh.vtk")
gmsh.option.setNumber("Mesh.SaveAll", 1)
gmsh.write("gmsh_all_4.1.msh")
gmsh.write("gmsh_all.mesh")
gmsh.option.setNumber("Mesh.SaveAll", 0)
gmsh.option.setNumber("Mesh.SaveGroupsOfNodes", 1)
gmsh.write("gmsh.inp")
gmsh.option.setNumber("Mesh.SaveGroupsOfNodes", 0)
for binary in [0, 1]:
    gmsh.option.setNumber("Mesh.Binary", binary)
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    gmsh.write(f"gmsh_{'binary' if binary else 'text'}.stl")
    gmsh.option.setNumber("Mesh.SaveAll", 0)
gmsh.option.setNumber("Mesh.Binary", 0)
gmsh.model.mesh.partition(2)
gmsh.write("gmsh_partitioned_4.1.msh")
gmsh.option.setNumber("Mesh.Binary", 1)
gmsh.write("gmsh_partitioned_4.1_binary.msh")
gmsh.option.setNumber("Mesh.Binary", 0)
for name in sorted(os.listdir(".")):
    if name.startswith("gmsh") and name.endswith(".msh"):
        of_gmsh(name)
of_meshio("gmsh.mesh", "medit:ref")
of_meshio("gmsh_all.mesh", "medit:ref")
of_pyvista("gmsh.vtk", "CellEntityIds")
for name in ["gmsh_text.stl", "gmsh_binary.stl"]:
    of_trimesh(name)

# meshio
mesh = meshio.read("gmsh_4.1_text.msh")
mesh.cell_sets = {}
tags = mesh.cell_data.pop("gmsh:geometrical")
plain = meshio.Mesh(mesh.points, mesh.cells, cell_data={"gmsh:physical": mesh.cell_data["gmsh:physical"]})
for name, options in [("meshio_text.vtu", {"binary": False}), ("meshio_binary.vtu", {"compression": None}), ("meshio_zlib.vtu", {"compression": "zlib"})]:
    plain.write(name, **options)
    of_meshio(name, "gmsh:physical")
for name, options in [("meshio_42.vtk", {"fmt_version": "4.2"}), ("meshio_51.vtk", {"fmt_version": "5.1"})]:
    for binary in [True, False]:
        of = name.replace(".", "_binary." if binary else "_text.")
        meshio.vtk.write(of, plain, binary=binary, **options)
        of_meshio(of, "gmsh:physical")
medit = meshio.Mesh(mesh.points, [c for c in mesh.cells if c.type != "vertex"],
                    cell_data={"medit:ref": [d for c, d in zip(mesh.cells, mesh.cell_data["gmsh:physical"]) if c.type != "vertex"]})
medit.write("meshio.mesh")
of_meshio("meshio.mesh", "medit:ref")
tetra = [c for c in mesh.cells if c.type == "tetra"]
regions = [d for c, d in zip(mesh.cells, mesh.cell_data["gmsh:physical"]) if c.type == "tetra"]
body = meshio.Mesh(mesh.points, [("tetra", numpy.vstack([c.data for c in tetra]))],
                   cell_data={"tetgen:ref": [numpy.concatenate(regions)]})
body.write("meshio.node")
of_meshio("meshio.ele", "tetgen:ref")
count = len(tetra[0].data)
body = meshio.Mesh(mesh.points, [("tetra", numpy.vstack([c.data for c in tetra]))],
                   cell_sets={"soft": [numpy.arange(count)], "stiff": [numpy.arange(count, sum(len(c.data) for c in tetra))]})
body.write("meshio.inp")
of_meshio("meshio.inp")

# VTK through PyVista
grid = pyvista.read("meshio_51_binary.vtk").cast_to_unstructured_grid()
grid.field_data["note"] = ["a text", "of two"]
grid.point_data["height"] = grid.points[:, 2]
grid.save("pyvista_text.vtk", binary=False)
grid.save("pyvista_binary.vtk", binary=True)
import vtk

for mode in ["Ascii", "Binary", "Appended"]:
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(f"vtk_{mode.lower()}.vtu")
    getattr(writer, f"SetDataModeTo{mode}")()
    writer.Write()
    of_pyvista(f"vtk_{mode.lower()}.vtu", "gmsh:physical")
of_pyvista("pyvista_text.vtk", "gmsh:physical")
of_pyvista("pyvista_binary.vtk", "gmsh:physical")
surface = grid.extract_cells(grid.celltypes == 10).extract_surface(algorithm="dataset_surface").triangulate()
for binary in [False, True]:
    for ending in ["ply", "stl", "vtk"]:
        name = f"pyvista_surface_{'binary' if binary else 'text'}.{ending}"
        plain_surface = pyvista.PolyData(numpy.asarray(surface.points, float), surface.faces)
        plain_surface.save(name, binary=binary)
        of_pyvista(name)
strips = pyvista.PolyData(numpy.asarray(surface.points, float), surface.faces).strip()
strips.save("pyvista_strips.vtk", binary=False)
triangles = strips.triangulate()
expect("pyvista_strips.vtk", numpy.asarray(triangles.points, float), triangles.regular_faces, {})

# trimesh and MeshLab
shell = trimesh.Trimesh(surface.points, surface.regular_faces, process=False)
shell.visual.face_colors = numpy.tile([200, 10, 30, 255], (len(shell.faces), 1))
shell.export("trimesh.obj")
shell.export("trimesh_text.ply", encoding="ascii")
shell.export("trimesh_binary.ply")
shell.export("trimesh_text.stl", file_type="stl_ascii")
shell.export("trimesh_binary.stl")
for name in ["trimesh.obj", "trimesh_text.ply", "trimesh_binary.ply", "trimesh_text.stl", "trimesh_binary.stl"]:
    of_trimesh(name)
meshlab = pymeshlab.MeshSet()
meshlab.add_mesh(pymeshlab.Mesh(numpy.asarray(surface.points, float), surface.regular_faces))
meshlab.compute_texcoord_parametrization_triangle_trivial_per_wedge()
for name, options in [
    ("meshlab.obj", {}), ("meshlab_text.ply", {"binary": False, "save_wedge_texcoord": True, "save_face_color": True}),
    ("meshlab_binary.ply", {"save_wedge_texcoord": True, "save_face_color": True}), ("meshlab_text.stl", {"binary": False}), ("meshlab.stl", {}),
]:
    meshlab.save_current_mesh(name, **options)
    loaded = pymeshlab.MeshSet()
    loaded.load_new_mesh(name)
    loaded.meshing_remove_duplicate_vertices()
    expect(name, loaded.current_mesh().vertex_matrix(), loaded.current_mesh().face_matrix(), {})

for name in os.listdir("."):
    if name.endswith((".png", ".mtl")):
        os.remove(name)
with open("expected.json", "w") as out:
    json.dump(EXPECTED, out, indent=1, sort_keys=True)
print(len(EXPECTED), "files")
