"""Meshes a bar in two halves with Gmsh and writes it in every format that fem-mesh reads."""

import gmsh

gmsh.initialize()
occ, mesh = gmsh.model.occ, gmsh.model.mesh
halves = [(3, occ.addBox(x, 0, 0, 1, 1, 1)) for x in (0, 1)]
occ.fragment(halves[:1], halves[1:])
occ.synchronize()


def tags(dimension, is_wanted):
    return [tag for _, tag in gmsh.model.getEntities(dimension) if is_wanted(occ.getCenterOfMass(dimension, tag)[0])]


gmsh.model.addPhysicalGroup(3, tags(3, lambda x: x < 1), 10, "soft part")
gmsh.model.addPhysicalGroup(3, tags(3, lambda x: x > 1), 11, "stiff")
gmsh.model.addPhysicalGroup(2, tags(2, lambda x: x < 1e-9), 20, "clamped")
gmsh.model.addPhysicalGroup(2, tags(2, lambda x: x > 2 - 1e-9), 21, "loaded")
gmsh.option.setNumber("Mesh.MeshSizeMin", 3)
gmsh.option.setNumber("Mesh.MeshSizeMax", 3)
mesh.generate(3)
for is_binary, name in enumerate(("text", "binary")):
    gmsh.option.setNumber("Mesh.Binary", is_binary)
    for version in (2.2, 4.1):
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.write(f"gmsh_{version}_{name}.msh")
    gmsh.write(f"gmsh_{name}.vtk")
