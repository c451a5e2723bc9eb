"""The judge of examples.isosurface: VTK's contours of the same mesh.

    isosurface.py grid OUT.vtk                a mesh with whole numbers for values, for contours through its vertices
    isosurface.py same MESH.vtu FIELD VALUE SURFACE.obj
"""
import collections
import sys

import numpy
import vtk
from vtk.util import numpy_support


def write_grid(path):
    """4 x 4 x 4 boxes of six cells; field = x + y + z."""
    n = 5
    points = [(x, y, z) for z in range(n) for y in range(n) for x in range(n)]
    steps = [1, n, n * n]
    cells = []
    for x, y, z in points:
        if max(x, y, z) == n - 1:
            continue
        low = x + n * y + n * n * z
        for a, b, c in ((0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)):
            cells.append((low, low + steps[a], low + steps[a] + steps[b], low + sum(steps)))
    with open(path, "w") as file:
        file.write("# vtk DataFile Version 3.0\ngrid\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        file.write(f"POINTS {len(points)} double\n")
        file.writelines("%d %d %d\n" % p for p in points)
        file.write(f"CELLS {len(cells)} {5 * len(cells)}\n")
        file.writelines("4 %d %d %d %d\n" % c for c in cells)
        file.write(f"CELL_TYPES {len(cells)}\n" + "10\n" * len(cells))
        file.write(f"POINT_DATA {len(points)}\nSCALARS field double 1\nLOOKUP_TABLE default\n")
        file.writelines("%d\n" % sum(p) for p in points)


def area(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2


def contour(kind, mesh, field, value):
    """Points and triangles of VTK's."""
    made = kind()
    made.SetInputData(mesh)
    made.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, field)
    made.SetValue(0, value)
    if hasattr(made, "SetOutputPointsPrecision"):
        made.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    made.Update()
    out = made.GetOutput()
    if out.GetNumberOfCells() == 0:
        return numpy.zeros((0, 3)), numpy.zeros((0, 3), int)
    points = numpy_support.vtk_to_numpy(out.GetPoints().GetData()).astype(float)
    return points, numpy_support.vtk_to_numpy(out.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def read_surface(path):
    """Points and triangles of an OBJ; a triangle comes after its points."""
    points, triangles = [], []
    for line in open(path):
        kind, *words = line.split()
        if kind == "v":
            points.append([float(word) for word in words])
        else:
            triangles.append([int(word) - 1 for word in words])
            assert max(triangles[-1]) < len(points), "a triangle comes before its points"
    return numpy.array(points).reshape(-1, 3), numpy.array(triangles, int).reshape(-1, 3)


def same(mesh_path, field, value, surface_path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(mesh_path)
    reader.Update()
    mesh = reader.GetOutput()
    points, triangles = read_surface(surface_path)
    for kind in (vtk.vtkContourFilter, vtk.vtkContourGrid):
        theirs, polygons = contour(kind, mesh, field, value)
        name = kind.__name__
        assert len(polygons) == len(triangles), f"{name}: {len(polygons)} != {len(triangles)}"
        assert len(theirs) == len(points), f"{name}: {len(theirs)} != {len(points)} points"
        a, b = area(theirs, polygons), area(points, triangles)
        assert abs(a - b) <= 1e-6 * a, f"{name}: area {a} != {b}"
    # Points are shared and all triangles turned alike: an edge is run along once each way.
    ways = collections.Counter((t[i], t[(i + 1) % 3]) for t in triangles for i in range(3))
    assert max(ways.values(), default=1) == 1, "triangles are not turned alike"
    # VTK reads the file itself, too.
    obj = vtk.vtkOBJReader()
    obj.SetFileName(surface_path)
    obj.Update()
    assert obj.GetOutput().GetNumberOfCells() == len(triangles), "VTK does not read the file"
    print(len(triangles))


if sys.argv[1] == "grid":
    write_grid(sys.argv[2])
else:
    same(sys.argv[2], sys.argv[3], float(sys.argv[4]), sys.argv[5])
