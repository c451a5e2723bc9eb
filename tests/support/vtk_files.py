"""What VTK reads in a file of its own formats, .vtu, .vtk or .vtkhdf, or of Exodus II, .exo."""

import sys

import vtk


def reader_of(path):
    if path.endswith(".vtkhdf"):
        return vtk.vtkHDFReader()
    if path.endswith(".exo"):
        return vtk.vtkExodusIIReader()
    if path.endswith(".vtu"):
        return vtk.vtkXMLUnstructuredGridReader()
    reader = vtk.vtkUnstructuredGridReader()
    reader.ReadAllScalarsOn()
    reader.ReadAllVectorsOn()
    reader.ReadAllFieldsOn()
    return reader


def grid_of(path, numbered=False):
    """The grid; ends the program where VTK has anything to say against the file. `numbered`: elements
    of Exodus have their numbers, from 1, in GlobalElementId."""
    reader = reader_of(path)
    said = []
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *words: said.append(words))
    reader.SetFileName(path)
    grid = blocks_of(reader, numbered) if path.endswith(".exo") else None
    reader.Update()
    if said:
        sys.exit(f"{path}: VTK is not content")
    return grid or reader.GetOutput()


def blocks_of(reader, numbered):
    """All element blocks of an Exodus file as one grid, with all variables; block_id tells which."""
    reader.UpdateInformation()
    reader.GenerateObjectIdCellArrayOn()
    reader.SetGenerateGlobalElementIdArray(numbered)
    reader.GenerateGlobalNodeIdArrayOff()
    for kind in (reader.NODAL, reader.ELEM_BLOCK):
        for i in range(reader.GetNumberOfObjectArrays(kind)):
            reader.SetObjectArrayStatus(kind, reader.GetObjectArrayName(kind, i), 1)
    reader.Update()
    blocks = reader.GetOutput().GetBlock(0)
    append = vtk.vtkAppendFilter()
    for i in range(blocks.GetNumberOfBlocks()):
        append.AddInputData(blocks.GetBlock(i))
    append.Update()
    grid = append.GetOutput()
    grid.GetCellData().GetArray("ObjectId").SetName("block_id")
    return grid
