"""Writes gmsh_text.vtk again with VTK, in the layouts of versions 4.2 and 5.1."""

import vtk

reader = vtk.vtkUnstructuredGridReader()
reader.SetFileName("gmsh_text.vtk")
reader.Update()
for version in (42, 51):
    for is_binary, name in enumerate(("text", "binary")):
        writer = vtk.vtkUnstructuredGridWriter()
        writer.SetInputData(reader.GetOutput())
        writer.SetFileVersion(version)
        writer.SetFileType(vtk.VTK_BINARY if is_binary else vtk.VTK_ASCII)
        writer.SetFileName(f"vtk_{version}_{name}.vtk")
        writer.Write()
