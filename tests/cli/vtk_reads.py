"""What VTK itself makes of our files, and we of VTK's.

vtk_reads.py write FOLDER   the mesh mesh.vtu, written by VTK in every way that it has
vtk_reads.py same A B...    exits with 0 if both files of each pair hold the same cells, corners
                            and values, and the second the time that the first one has
vtk_reads.py blocks FOLDER  the mesh mesh.vtu with block ids, and what VTK writes of it as Exodus II
vtk_reads.py shapes FOLDER  a cube made of cells of all shapes that fill it face to face, .vtu and .vtk
vtk_reads.py fills A...     exits with 0 if the tetrahedra of each file fill such a cube, face to face,
                            and bear the labels of the cells that they come from
"""

import os
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from vtk_files import grid_of  # noqa: E402


def arrays(data):
    count = range(data.GetNumberOfArrays())
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in count}


def mixed_into(sums, rows):
    """One number per row that depends on all values bit for bit."""
    rows = np.ascontiguousarray(rows.reshape(len(rows), -1))
    bits = (rows + 0.0).astype("f8") if rows.dtype.kind == "f" else rows.astype("i8")
    for column in bits.view("u8").T:
        sums = (sums ^ column) * np.uint64(0x9E3779B97F4A7C15)
        sums ^= sums >> np.uint64(29)
    return sums


def facts(path):
    """The names of all arrays, the time, and the cells in an order that does not depend on that of the
    file."""
    grid = grid_of(path)
    points, cells = arrays(grid.GetPointData()), arrays(grid.GetCellData())
    sums = mixed_into(np.full(grid.GetNumberOfPoints(), 7, "u8"), vtk_to_numpy(grid.GetPoints().GetData()))
    for name in sorted(points):
        sums = mixed_into(sums, points[name])
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    sums = mixed_into(np.full(len(corners), 3, "u8"), sums[corners])
    for name in sorted(cells):
        sums = mixed_into(sums, cells[name])
    time = grid.GetFieldData().GetArray("TimeValue")
    return ((sorted(points), sorted(cells)), [] if time is None else vtk_to_numpy(time).tolist(),
            np.sort(sums))


def same(*paths):
    for a, b in zip(paths[::2], paths[1::2]):
        first, second = facts(a), facts(b)
        if first[0] != second[0]:
            sys.exit(f"{a}: {first[0]}; {b}: {second[0]}")
        if first[1] and first[1] != second[1]:  # Exodus files always tell one
            sys.exit(f"{a}: time {first[1]}; {b}: {second[1]}")
        if not np.array_equal(first[2], second[2]):
            sys.exit(f"{a} and {b} hold other cells or values")


def write(folder):
    grid = grid_of(f"{folder}/mesh.vtu")
    random = np.random.default_rng(1)
    points, cells = grid.GetNumberOfPoints(), grid.GetNumberOfCells()
    for data, name, values in (
        (grid.GetPointData(), "double", random.random(points)),
        (grid.GetPointData(), "a vector", random.random((points, 3)).astype("f4")),
        (grid.GetPointData(), "tensor", random.random((points, 9))),
        (grid.GetPointData(), "int", random.integers(-(2**30), 2**30, points, "i4")),
        (grid.GetCellData(), "wide", random.integers(-(2**60), 2**60, cells)),
        (grid.GetCellData(), "byte", random.integers(0, 255, cells, "u1")),
        (grid.GetCellData(), "two", random.integers(-30000, 30000, (cells, 2), "i2")),
        (grid.GetFieldData(), "TimeValue", np.array([0.1])),
    ):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.AddArray(array)
    codecs = {"none": 0, "zlib": 1, "lz4": 2, "lzma": 3}
    codings = {"ascii": (0, 0), "inline": (1, 0), "base64": (2, 1), "raw": (2, 0)}
    for coding, (mode, encode) in codings.items():
        for codec, kind in codecs.items():
            for bits in (32, 64):
                writer = vtk.vtkXMLUnstructuredGridWriter()
                writer.SetFileName(f"{folder}/{coding}-{codec}-{bits}.vtu")
                writer.SetInputData(grid)
                writer.SetDataMode(mode)
                writer.SetEncodeAppendedData(encode)
                writer.SetCompressorType(kind)
                writer.SetHeaderType(bits)
                writer.Write()
    for kind in (1, 2):
        for version in (42, 51):
            writer = vtk.vtkUnstructuredGridWriter()
            writer.SetFileName(f"{folder}/legacy-{kind}-{version}.vtk")
            writer.SetInputData(grid)
            writer.SetFileType(kind)
            writer.SetFileVersion(version)
            writer.Write()


def blocks(folder):
    grid = grid_of(f"{folder}/mesh.vtu")
    random = np.random.default_rng(3)
    for data in (grid.GetPointData(), grid.GetCellData()):
        while data.GetNumberOfArrays() > 0:
            data.RemoveArray(0)
    cells = grid.GetNumberOfCells()
    for data, name, values in (
        (grid.GetPointData(), "p", random.random(grid.GetNumberOfPoints())),
        (grid.GetCellData(), "rho", random.random(cells)),
        (grid.GetCellData(), "block_id", np.sort(random.integers(1, 4, cells, "i4"))),
    ):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.AddArray(array)
    # Exodus files of VTK have one type of floats.
    doubles = vtk.vtkPoints()
    doubles.SetDataTypeToDouble()
    doubles.DeepCopy(grid.GetPoints())
    grid.SetPoints(doubles)
    for writer, name in ((vtk.vtkXMLUnstructuredGridWriter(), "blocks.vtu"),
                         (vtk.vtkExodusIIWriter(), "blocks.exo")):
        writer.SetFileName(f"{folder}/{name}")
        writer.SetInputData(grid)
        if name == "blocks.exo":
            writer.SetBlockIdArrayName("block_id")
            writer.SetStoreDoubles(1)
        writer.Write()


def cube_of_shapes(n):
    """n x n x n cubes, each cut into cells of one shape, with points numbered at random; the cell
    array is the octant that a cell lies in."""
    grid = vtk.vtkUnstructuredGrid()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    number = np.random.default_rng(2).permutation((n + 1) ** 3)
    places = np.empty(((n + 1) ** 3 + n**3, 3))
    at = lambda x, y, z: int(number[x + (n + 1) * (y + (n + 1) * z)])
    grid.Allocate(n**3)
    labels = []
    middle = (n + 1) ** 3
    for z, y, x in np.ndindex(n + 1, n + 1, n + 1):
        places[at(x, y, z)] = np.array((x, y, z)) / n
    for z, y, x in np.ndindex(n, n, n):
        places[middle] = (np.array((x, y, z)) + 0.5) / n
        c = [at(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)) for i in range(8)]
        round_ = [c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]]
        kind = (x + z) % 4  # wedges meet along y with their triangles
        cells = [[(vtk.VTK_VOXEL, c)], [(vtk.VTK_HEXAHEDRON, round_)],
                 [(vtk.VTK_WEDGE, [c[0], c[1], c[4], c[2], c[3], c[6]]),
                  (vtk.VTK_WEDGE, [c[1], c[5], c[4], c[3], c[7], c[6]])],
                 [(vtk.VTK_PYRAMID, [c[i] for i in face] + [middle]) for face in
                  ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))]]
        for shape, corners in cells[kind]:
            grid.InsertNextCell(shape, len(corners), corners)
            labels.append((2 * x >= n) + 2 * (2 * y >= n) + 4 * (2 * z >= n))
        middle += 1
    points.SetData(numpy_to_vtk(places, deep=True))
    grid.SetPoints(points)
    array = numpy_to_vtk(np.array(labels, "i4"), deep=True)
    array.SetName("octant")
    grid.GetCellData().AddArray(array)
    return grid


def shapes(folder):
    grid = cube_of_shapes(6)
    for writer, name in ((vtk.vtkXMLUnstructuredGridWriter(), "shapes.vtu"),
                         (vtk.vtkUnstructuredGridWriter(), "shapes.vtk")):
        writer.SetFileName(f"{folder}/{name}")
        writer.SetInputData(grid)
        writer.Write()


def fills(*paths):
    for path in paths:
        grid = grid_of(path)
        p = vtk_to_numpy(grid.GetPoints().GetData())
        cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
        corners = p[cells]
        volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
        if abs(volume.sum() - 1) > 1e-12 or volume.min() == 0:
            sys.exit(f"{path}: the volume is {volume.sum()}, the least {volume.min()}")
        faces = np.sort(np.concatenate([np.delete(cells, i, 1) for i in range(4)]), 1)
        faces, counts = np.unique(faces, axis=0, return_counts=True)
        a, b, c = p[faces[counts == 1]].transpose(1, 0, 2)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
        if counts.max() > 2 or abs(area - 6) > 1e-12:
            sys.exit(f"{path}: the faces outside have an area of {area}")
        labels = (corners.mean(1) >= 0.5) @ np.array((1, 2, 4))
        if not np.array_equal(labels, vtk_to_numpy(grid.GetCellData().GetArray("octant"))):
            sys.exit(f"{path}: other labels")


{"write": write, "same": same, "blocks": blocks, "shapes": shapes, "fills": fills}[sys.argv[1]](*sys.argv[2:])
