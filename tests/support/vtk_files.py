"""What VTK reads in a file of its own formats, .vtu, .vtk or .vtkhdf."""

import sys

import vtk


def reader_of(path):
    if path.endswith(".vtkhdf"):
        return vtk.vtkHDFReader()
    if path.endswith(".vtu"):
        return vtk.vtkXMLUnstructuredGridReader()
    reader = vtk.vtkUnstructuredGridReader()
    reader.ReadAllScalarsOn()
    reader.ReadAllVectorsOn()
    reader.ReadAllFieldsOn()
    return reader


def grid_of(path):
    """The grid; ends the program where VTK has anything to say against the file."""
    reader = reader_of(path)
    said = []
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *words: said.append(words))
    reader.SetFileName(path)
    reader.Update()
    if said:
        sys.exit(f"{path}: VTK is not content")
    return reader.GetOutput()
