"""MEDIT files as text, with labelled faces, locked vertices and fields beside them: written and read
by hand, so that neither side of a check is the library's own."""
import numpy

KINDS = {1: 1, 3: 2}  # components: number of the kind of values


def rows(file, numbers):
    for row in numbers.tolist():
        file.write(" ".join(map(repr, row)) + "\n")


def write(path, mesh):
    with open(path, "w") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(mesh.points)}\n")
        for point in mesh.points.tolist():
            file.write(" ".join(map(repr, point)) + " 0\n")
        labels = mesh.cell_data.get("region", numpy.zeros(len(mesh.cells), int))
        file.write(f"Tetrahedra\n{len(mesh.cells)}\n")
        rows(file, numpy.column_stack([mesh.cells + 1, labels]))
        file.write(f"Triangles\n{len(mesh.faces)}\n")
        rows(file, numpy.column_stack([mesh.faces + 1, mesh.face_labels]))
        file.write(f"RequiredVertices\n{len(mesh.locked)}\n")
        rows(file, mesh.locked.reshape(-1, 1) + 1)
        file.write("End\n")
    if mesh.fields:
        write_solutions(path.replace(".mesh", ".sol"), mesh)


def write_solutions(path, mesh):
    columns = [v.reshape(len(mesh.points), -1).astype(float) for v in mesh.fields.values()]
    with open(path, "w") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{len(mesh.points)}\n")
        file.write(" ".join(map(str, [len(columns)] + [KINDS[c.shape[1]] for c in columns])) + "\n")
        rows(file, numpy.concatenate(columns, 1))
        file.write("End\n")


class Read:
    """points, cells, faces, face_labels and locked of a file; locked is None where it is not told."""

    def __init__(self, path):
        with open(path) as file:
            words = file.read().split()
        self.faces, self.face_labels = numpy.zeros((0, 3), int), numpy.zeros(0, int)
        self.locked = numpy.zeros(0, int)
        widths = {"Vertices": 4, "Tetrahedra": 5, "Triangles": 4, "RequiredVertices": 1}
        at = 0
        while at < len(words):
            width = widths.get(words[at])
            if width is None:
                at += 1
                continue
            count = int(words[at + 1])
            table = numpy.array(words[at + 2:at + 2 + width * count], float).reshape(count, width)
            self.take(words[at], table)
            at += 2 + width * count

    def take(self, name, table):
        if name == "Vertices":
            self.points = table[:, :3]
        elif name == "Tetrahedra":
            self.cells = table[:, :4].astype(int) - 1
        elif name == "Triangles":
            self.faces, self.face_labels = table[:, :3].astype(int) - 1, table[:, 3].astype(int)
        else:
            self.locked = table[:, 0].astype(int) - 1
