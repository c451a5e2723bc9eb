"""Labelled faces and locked vertices of a mesh: chosen, and what has to hold of them afterwards."""
import numpy

from facts import FACES, components


def choose(mesh, random):
    """Labels faces of the boundary and inside, locks vertices; says what it did."""
    faces, uses = numpy.unique(numpy.sort(mesh.cells[:, FACES].reshape(-1, 3), 1), axis=0,
                               return_counts=True)
    faces, uses = faces[uses <= 2], uses[uses <= 2]
    labels = numpy.zeros(len(faces), int)
    outside, inside = uses == 1, uses == 2
    of_boundary, chosen = boundary_labels(mesh, faces, random)
    labels[outside] = chosen[outside]
    of_interior, chosen = interior_labels(mesh, faces, random)
    labels[inside] = chosen[inside]
    mesh.faces, mesh.face_labels = faces[labels > 0], labels[labels > 0]
    turned = random.random(len(mesh.faces)) < 0.5
    mesh.faces[turned] = mesh.faces[turned][:, [1, 0, 2]]
    used = numpy.unique(mesh.cells)
    mesh.locked = used[random.random(len(used)) < random.choice([0, 0, 0.01, 0.1, 1])]
    return f"faces {of_boundary}, inside {of_interior}, {len(mesh.locked)} locked"


def boundary_labels(mesh, faces, random):
    middle = mesh.points[faces].mean(1)
    middle = middle - numpy.median(middle, axis=0)
    ways = {"none": numpy.zeros(len(faces), int), "one": numpy.full(len(faces), 7),
            "halves": 1 + (middle[:, 0] > 0),
            "sides": 1 + numpy.argmax(numpy.abs(normals(mesh, faces)), 1),
            "patch": 3 * (middle[:, 0] + middle[:, 1] > 0),
            "strips": (numpy.abs(middle[:, 1]) * 1.5).astype(int) % 3,
            "random": random.integers(0, 3, len(faces))}
    way = str(random.choice(list(ways)))
    return way, ways[way]


def interior_labels(mesh, faces, random):
    axis = int(random.integers(3))
    centres = mesh.points[mesh.cells].mean(1)[:, axis]
    above = (centres > numpy.median(centres))[cells_beside(mesh, faces)]
    ways = {"none": numpy.zeros(len(faces), int), "plane": 20 * (above[:, 0] != above[:, 1]),
            "random": 21 * (random.random(len(faces)) < 0.02)}
    way = str(random.choice(["none", *ways]))
    return way, ways[way]


def normals(mesh, faces):
    a, b, c = (mesh.points[faces[:, i]] for i in range(3))
    return numpy.cross(b - a, c - a)


def cells_beside(mesh, faces):
    """The two cells of each face; of a face of one cell that one twice."""
    sides = numpy.sort(mesh.cells[:, FACES].reshape(-1, 3), 1)
    _, where = numpy.unique(numpy.concatenate([faces, sides]), axis=0, return_inverse=True)
    where = where.reshape(-1)
    order = numpy.argsort(where[len(faces):], kind="stable")
    sorted_where = where[len(faces):][order]
    begin = numpy.searchsorted(sorted_where, where[:len(faces)])
    end = numpy.searchsorted(sorted_where, where[:len(faces)], "right")
    return numpy.stack([order[begin], order[end - 1]], 1) // 4


class Marks:
    """Of a mesh with faces, face_labels and locked."""

    def __init__(self, mesh):
        self.mesh = mesh
        sides = numpy.sort(mesh.cells[:, FACES].reshape(-1, 3), 1)
        there, uses = numpy.unique(sides, axis=0, return_counts=True)
        self.outside = {tuple(face) for face in there[uses == 1]}
        self.sides = {tuple(face) for face in there}
        self.faces = [tuple(face) for face in numpy.sort(mesh.faces, 1)]
        self.labels = sorted(set(map(int, mesh.face_labels)))

    def surface(self, label):
        """Euler characteristic and components of the faces of a label, and the parts of them that
        hang together by edges: what is pinched has more."""
        faces = numpy.sort(self.mesh.faces[self.mesh.face_labels == label], 1)
        edges, sides = numpy.unique(faces[:, [[0, 1], [0, 2], [1, 2]]].reshape(-1, 2), axis=0,
                                    return_inverse=True)
        return (len(numpy.unique(faces)) - len(edges) + len(faces),
                components(faces, len(self.mesh.points)),
                components(sides.reshape(-1, 3), len(edges)))

    def is_covered(self):
        """Whether all of the boundary is labelled."""
        return self.outside <= set(self.faces)


def complaint(before, after):
    """What is wrong of the marks of a result; empty: nothing."""
    loose = [face for face in after.faces if face not in after.sides]
    if loose:
        return f"{len(loose)} labelled faces are no faces of cells"
    if len(set(after.faces)) != len(after.faces):
        return "a face is labelled twice"
    if before.labels != after.labels:
        return f"the labels were {before.labels} and are {after.labels}"
    if before.is_covered() and not after.is_covered():
        return "part of the boundary has lost its label"
    for label in before.labels:
        was, now = before.surface(label), after.surface(label)
        if was != now:
            return f"the faces of label {label} had the topology {was} and have {now}"
    return lock_complaint(before.mesh, after.mesh)


def lock_complaint(before, after):
    if after.locked is None:
        return ""
    stay = {tuple(point) for point in before.points[before.locked]}
    there = {tuple(point) for point in after.points[after.locked]}
    if stay != there:
        return f"{len(stay - there)} of {len(stay)} locked vertices have moved or lost their mark, " \
            f"{len(there - stay)} others have one"
    return ""
