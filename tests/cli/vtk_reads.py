"""What VTK itself makes of our files, and we of VTK's.

vtk_reads.py write FOLDER   the mesh mesh.vtu, written by VTK in every way that it has
vtk_reads.py same A B...    exits with 0 if both files of each pair hold the same cells, corners
                            and values
"""

import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


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


def load(path):
    reader = reader_of(path)
    said = []
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *words: said.append(words))
    reader.SetFileName(path)
    reader.Update()
    if said:
        sys.exit(f"{path}: VTK is not content")
    return reader.GetOutput()


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
    """The names of all arrays, and the cells in an order that does not depend on that of the file."""
    grid = load(path)
    points, cells = arrays(grid.GetPointData()), arrays(grid.GetCellData())
    sums = mixed_into(np.full(grid.GetNumberOfPoints(), 7, "u8"), vtk_to_numpy(grid.GetPoints().GetData()))
    for name in sorted(points):
        sums = mixed_into(sums, points[name])
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    sums = mixed_into(np.full(len(corners), 3, "u8"), sums[corners])
    for name in sorted(cells):
        sums = mixed_into(sums, cells[name])
    return sorted(points), sorted(cells), np.sort(sums)


def same(*paths):
    for a, b in zip(paths[::2], paths[1::2]):
        first, second = facts(a), facts(b)
        if first[:2] != second[:2]:
            sys.exit(f"{a}: {first[:2]}; {b}: {second[:2]}")
        if not np.array_equal(first[2], second[2]):
            sys.exit(f"{a} and {b} hold other cells or values")


def write(folder):
    grid = load(f"{folder}/mesh.vtu")
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


{"write": write, "same": same}[sys.argv[1]](*sys.argv[2:])
