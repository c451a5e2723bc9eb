"""Meshes for the tests, and the command that results are compared with."""
import os
import subprocess

import numpy

# A run with sanitizers is many times slower than usual: it has smaller meshes and fewer rounds.
SLOW = "TETSTREAM_SLOW" in os.environ

# The six cells of a cube: paths along its edges from corner 0 to corner 7.
_PATHS = ((1, 3), (1, 5), (2, 3), (2, 6), (4, 5), (4, 6))


def box(n, points=numpy.float64, cells=numpy.int64):
    """Points, cells and a field of n x n x 2n cubes."""
    grid = numpy.stack(numpy.meshgrid(*(numpy.arange(k + 1) for k in (n, n, 2 * n)), indexing="ij"),
                       axis=-1).reshape(-1, 3)
    rank = numpy.arange(len(grid)).reshape(n + 1, n + 1, 2 * n + 1)
    c = [rank[x:n + x, y:n + y, z:2 * n + z].ravel()
         for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    tetrahedra = numpy.stack([(c[0], c[a], c[b], c[7]) for a, b in _PATHS]).transpose(2, 0, 1)
    places = (grid / n).astype(points)
    field = numpy.sin(5 * places[:, 0]) * places[:, 1] + places[:, 2] ** 2
    return places, tetrahedra.reshape(-1, 4).astype(cells), field.astype(points)


def halves(points, cells):
    """Labels of two regions that meet in the middle plane: 3 below, 8 above."""
    middle = points[cells].mean(axis=1)[:, 2]
    return numpy.where(middle < points[:, 2].max() / 2, 3, 8)


def volume(points, cells):
    """Of all cells, without their signs."""
    a, b, c, d = (points[cells[:, i]].astype(float) for i in range(4))
    return numpy.abs(numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a)).sum() / 6


def write_vtu(path, points, cells, fields):
    """The mesh as text, written here and not by what is tested."""
    def array(name, values, kind):
        flat = " ".join(map(repr, values.ravel().tolist()))
        columns = values.shape[1] if values.ndim > 1 else 1
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{columns}" '
                f'format="ascii">{flat}</DataArray>')

    count = len(cells)
    with open(path, "w", encoding="ascii") as file:
        file.write('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">'
                   f'<UnstructuredGrid><Piece NumberOfPoints="{len(points)}" '
                   f'NumberOfCells="{count}"><PointData>')
        for name, values in fields.items():
            file.write(array(name, values, "Float64"))
        file.write("</PointData><Points>" + array("Points", points, "Float64") + "</Points><Cells>")
        file.write(array("connectivity", cells, "Int64"))
        file.write(array("offsets", 4 * numpy.arange(1, count + 1), "Int64"))
        file.write(array("types", numpy.full(count, 10), "UInt8"))
        file.write("</Cells></Piece></UnstructuredGrid></VTKFile>\n")


def command(*words):
    """Runs the command."""
    subprocess.run([os.environ["TETSTREAM_COMMAND"], *map(str, words), "--quiet"], check=True)
