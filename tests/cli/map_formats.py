"""Whether a map of vertices fits the file that was written with it.

map_formats.py labels IN OUT                   IN with a linear field density, cells of two labels that
                                               take turns, and the sides of the box as labelled faces
map_formats.py agrees ORIGINAL (FILE MAP OF)... exits with 0 if the cells and weights of each map give
                                               the points of ORIGINAL back. FILE is one that VTK reads,
                                               or .sva in post-order; its cells have the numbers of the
                                               elements of OF, an .exo or an .msh of version 4.1, if
                                               that is not empty
map_formats.py carried ORIGINAL VALUES         exits with 0 if these are ORIGINAL's density
"""

import os
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from vtk_files import grid_of  # noqa: E402


def points_of(grid):
    return vtk_to_numpy(grid.GetPoints().GetData()).astype("f8")


def cells_of(grid):
    """The tetrahedra, which stand before all else."""
    count = np.count_nonzero(vtk_to_numpy(grid.GetCellTypesArray()) == vtk.VTK_TETRA)
    return vtk_to_numpy(grid.GetCells().GetConnectivityArray())[:4 * count].reshape(-1, 4)


def add(data, name, values):
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    data.AddArray(array)


def labels(source, target):
    grid = grid_of(source)
    points, cells = points_of(grid), cells_of(grid)
    faces = np.sort(np.concatenate([np.delete(cells, k, axis=1) for k in range(4)]), axis=1)
    faces, count = np.unique(faces, axis=0, return_counts=True)
    faces = faces[count == 1]
    at = points[faces]
    sides = np.zeros(len(faces), int)
    for axis in range(3):
        for end, value in enumerate((points[:, axis].min(), points[:, axis].max())):
            sides[(at[:, :, axis] == value).all(axis=1)] = 1 + 2 * axis + end
    assert (sides > 0).all()
    parts = np.where(points[cells].mean(axis=1)[:, 0] < points[:, 0].mean(), 9, 4)
    none = np.zeros(len(faces), int), np.zeros(len(cells), int)
    corners = np.concatenate([np.column_stack([np.full(len(rows), rows.shape[1]), rows]).ravel()
                              for rows in (cells, faces)])
    array = vtk.vtkCellArray()
    array.ImportLegacyFormat(numpy_to_vtkIdTypeArray(corners.astype("i8"), deep=True))
    labelled = vtk.vtkUnstructuredGrid()
    wide = vtk.vtkPoints()
    wide.SetData(numpy_to_vtk(points, deep=True))
    labelled.SetPoints(wide)
    labelled.SetCells([vtk.VTK_TETRA] * len(cells) + [vtk.VTK_TRIANGLE] * len(faces), array)
    add(labelled.GetPointData(), "density", points @ [1, -2, 0.5] + 3)
    add(labelled.GetCellData(), "part", np.concatenate([parts, none[0]]).astype("i4"))
    add(labelled.GetCellData(), "face_label", np.concatenate([none[1], sides]))
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(target)
    writer.SetInputData(labelled)
    writer.Write()


def corners_of_post_order(path):
    with open(path, encoding="ascii") as file:
        lines = [line.split() for line in file]
    points = np.array([words[1:4] for words in lines if words[0] == "v"], "f8")
    return points[np.array([words[1:5] for words in lines if words[0] == "c"], int) - 1]


def corners_of(path):
    if path.endswith(".sva"):
        return corners_of_post_order(path)
    grid = grid_of(path)
    return points_of(grid)[cells_of(grid)]


def tags_of_cells(path):
    """Of an .msh of version 4.1, text or binary, less those of the faces."""
    with open(path, "rb") as file:
        head, rest = file.read().split(b"$Elements\n")
    text = head.split(b"\n")[1].split()[1] == b"0"
    words = iter(rest.split(b"$End")[0].split()) if text else None

    def take(count, kind):
        nonlocal rest
        if words:
            return np.array([next(words) for _ in range(count)], "i8")
        values = np.frombuffer(rest, kind, count)
        rest = rest[values.nbytes:]
        return values.astype("i8")

    blocks, faces, cells = int(take(4, "u8")[0]), 0, []
    for _ in range(blocks):
        dimension = int(take(3, "i4")[0])
        count = int(take(1, "u8")[0])
        rows = take(count * (dimension + 2), "u8").reshape(count, -1)
        faces += count if dimension == 2 else 0
        cells.append(rows[:0 if dimension == 2 else count, 0])
    return np.concatenate(cells) - faces


def numbers_of_elements(path):
    if path.endswith(".msh"):
        return tags_of_cells(path)
    return vtk_to_numpy(grid_of(path, numbered=True).GetCellData().GetArray("GlobalElementId"))


def agrees(original, *files):
    was = points_of(grid_of(original))
    for path, map_path, numbered in zip(files[::3], files[1::3], files[2::3]):
        one_agrees(was, path, map_path, numbered)


def one_agrees(was, path, map_path, numbered):
    corners = corners_of(path)
    if numbered:
        number = numbers_of_elements(numbered)
        assert np.array_equal(np.sort(number), np.arange(1, len(corners) + 1))
        assert not np.array_equal(number, np.arange(1, len(corners) + 1)), f"cells of {numbered} are not grouped"
        corners = corners[np.argsort(number)]
    row = np.dtype([("vertex", "<i8"), ("cell", "<i8"), ("weight", "<f8", 4)])
    rows = np.fromfile(map_path, row, np.fromfile(map_path, "<i8", 3)[2], offset=64)
    found = (rows["weight"][..., None] * corners[rows["cell"]]).sum(axis=1)
    error = abs(found - was[rows["vertex"]]).max()
    # VTK has the points of Exodus as float32.
    most = 1e-6 if path.endswith(".exo") else 1e-13
    assert len(rows) == len(was) and error < most, (path, numbered, error)


def carried(original, values):
    was = vtk_to_numpy(grid_of(original).GetPointData().GetArray("density"))
    error = abs(np.load(values) - was).max()
    assert error < 1e-12 * np.ptp(was), error


{"labels": labels, "agrees": agrees, "carried": carried}[sys.argv[1]](*sys.argv[2:])
