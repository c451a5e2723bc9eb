"""What a mesh is, in numbers, by plain means: topology, and cells that fold onto a neighbour."""
from fractions import Fraction

import numpy

FACES = numpy.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])
EDGES = numpy.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])


def components(ids, count):
    """Of sets of ids, given as rows, that are joined by common ones."""
    parent = numpy.arange(count)

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i
    for row in ids:
        first = root(row[0])
        for i in row[1:]:
            parent[root(i)] = first
    return len({root(i) for i in numpy.unique(ids)})


def exact_sign(corners):
    """Of the volume of a cell, of the coordinates as they are."""
    a, b, c = ([Fraction(float(x)) - Fraction(float(y)) for x, y in zip(corners[i], corners[0])]
               for i in (1, 2, 3))
    volume = (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
              + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return (volume > 0) - (volume < 0)


class Facts:
    def __init__(self, mesh):
        self.points, self.cells = mesh.points, mesh.cells
        count = len(mesh.points)
        self.cell_count = len(mesh.cells)
        self.vertices = len(numpy.unique(mesh.cells))
        edges = numpy.unique(numpy.sort(mesh.cells[:, EDGES].reshape(-1, 2), 1), axis=0)
        sides = numpy.sort(mesh.cells[:, FACES].reshape(-1, 3), 1)
        faces, where, uses = numpy.unique(sides, axis=0, return_inverse=True, return_counts=True)
        where = where.reshape(-1)
        self.euler = self.vertices - len(edges) + len(faces) - self.cell_count
        self.components = components(mesh.cells, count)
        self.crowded_faces = int((uses > 2).sum())
        boundary = faces[uses == 1]
        self.boundary_faces = len(boundary)
        rims = numpy.sort(boundary[:, [[0, 1], [0, 2], [1, 2]]].reshape(-1, 2), 1)
        rims, of_faces = numpy.unique(rims, axis=0, return_counts=True)
        self.boundary_euler = len(numpy.unique(boundary)) - len(rims) + len(boundary)
        self.boundary_components = components(boundary, count)
        self.branching_edges = int((of_faces != 2).sum())
        self.signs = self.orientations()
        self.flat = int((self.signs == 0).sum())
        self.folds = self.count_folds(where, uses)

    def orientations(self):
        corner = self.points[self.cells].astype(float)
        a, b, c = (corner[:, i] - corner[:, 0] for i in (1, 2, 3))
        with numpy.errstate(all="ignore"):
            volumes = numpy.einsum("ij,ij->i", a, numpy.cross(b, c))
            # As large as that it has the right sign, whatever was rounded.
            size = numpy.abs([a, b, c]).max((0, 2))
            doubt = ~(numpy.abs(volumes) > 1e-14 * size * size * size)
        signs = numpy.sign(volumes)
        for i in numpy.flatnonzero(doubt):
            signs[i] = exact_sign(corner[i])
        return signs

    def count_folds(self, where, uses):
        """Faces whose two cells lie on the same side."""
        order = numpy.argsort(where, kind="stable")
        order = order[(uses == 2)[where[order]]].reshape(-1, 2)
        cells, sides = order // 4, order % 4
        if len(cells) == 0:
            return 0
        # The sign of a cell, with its face's vertices in a common order.
        signs = []
        for k in (0, 1):
            corners = self.cells[cells[:, k]]
            face = numpy.take_along_axis(corners, FACES[sides[:, k]], 1)
            ranks = numpy.argsort(face, 1)
            parity = numpy.linalg.det(numpy.eye(3)[ranks])
            signs.append(self.signs[cells[:, k]] * parity * (-1.0) ** sides[:, k])
        return int((signs[0] * signs[1] > 0).sum())

    def topology(self):
        return {name: getattr(self, name) for name in
                ("euler", "components", "boundary_euler", "boundary_components")}
