"""Legacy VTK files, binary: 5.1 is written, 4.2 and 5.1 are read, by hand, so that neither side of a
check is the library's own."""
import numpy

TYPES = {"f4": "float", "f8": "double", "i4": "int", "i8": "vtktypeint64"}


def write(path, mesh):
    with open(path, "wb") as file:
        def line(text):
            file.write(text.encode() + b"\n")

        def values(array, kind=None):
            file.write(numpy.ascontiguousarray(array, ">" + (kind or array.dtype.str[1:])).tobytes())
            file.write(b"\n")

        def columns(head, arrays, count):
            if not arrays:
                return
            line(f"{head} {count}")
            line(f"FIELD FieldData {len(arrays)}")
            for name, array in arrays.items():
                width = array.shape[1] if array.ndim > 1 else 1
                line(f"{name} {width} {count} {TYPES[array.dtype.str[1:]]}")
                values(array)

        count = len(mesh.cells)
        line("# vtk DataFile Version 5.1\nsoak\nBINARY\nDATASET UNSTRUCTURED_GRID")
        line(f"POINTS {len(mesh.points)} double")
        values(mesh.points, "f8")
        line(f"CELLS {count + 1} {4 * count}\nOFFSETS vtktypeint64")
        values(4 * numpy.arange(count + 1), "i8")
        line("CONNECTIVITY vtktypeint64")
        values(mesh.cells, "i8")
        line(f"CELL_TYPES {count}")
        values(numpy.full(count, 10), "i4")
        columns("POINT_DATA", mesh.fields, len(mesh.points))
        columns("CELL_DATA", mesh.cell_data, count)


class Read:
    """points, cells, fields and cell_data of a file of tetrahedra, and behind them triangles: faces,
    labelled by the cell array face_label, where the tetrahedra and they have 0 of each other's."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.data = file.read()
        self.at = 0
        self.fields, self.cell_data = {}, {}
        where = None
        while self.at < len(self.data):
            words = self.line().split()
            if not words:
                continue
            if words[0] == "POINTS":
                self.points = self.values(3 * int(words[1]), words[2]).reshape(-1, 3)
            elif words[0] == "CELLS":
                self.read_cells(int(words[1]), int(words[2]))
            elif words[0] == "CELL_TYPES":
                self.tell_kinds(self.values(int(words[1]), "int"))
            elif words[0] in ("POINT_DATA", "CELL_DATA"):
                where = self.fields if words[0] == "POINT_DATA" else self.cell_data
                count = int(words[1])
            elif words[0] in ("SCALARS", "VECTORS", "TENSORS"):
                width = {"SCALARS": int((words + ["1"])[3]), "VECTORS": 3, "TENSORS": 9}[words[0]]
                if words[0] == "SCALARS":
                    self.line()  # LOOKUP_TABLE
                array = self.values(width * count, words[2])
                where[words[1]] = array.reshape(-1, width) if width > 1 else array
            elif words[0] == "FIELD":
                for _ in range(int(words[2])):
                    self.read_array(where)
        self.part_cell_data()

    def read_array(self, where):
        words = self.line().split()
        while not words:
            words = self.line().split()
        name, width, count, kind = words[0], int(words[1]), int(words[2]), words[3]
        array = self.values(width * count, kind)
        where[name] = array.reshape(-1, width) if width > 1 else array

    def read_cells(self, offsets, size):
        if not self.data[self.at:].startswith(b"OFFSETS"):
            self.corners, self.counted = self.values(size, "int").astype("i8"), True
            return
        kind = self.line().split()[1]
        self.values(offsets, kind)
        kind = self.line().split()[1]
        self.corners, self.counted = self.values(size, kind).astype("i8"), False

    def tell_kinds(self, types):
        """With the number of its corners in front of each cell, where they are counted."""
        count = int((types == 10).sum())
        assert (types == numpy.repeat((10, 5), (count, len(types) - count))).all(), "other cells"

        def rows(flat, width):
            table = flat.reshape(-1, width + self.counted)
            assert not self.counted or (table[:, 0] == width).all(), "other numbers of corners"
            return table[:, int(self.counted):]
        end = count * (4 + self.counted)
        self.cells, self.faces = rows(self.corners[:end], 4), rows(self.corners[end:], 3)

    def part_cell_data(self):
        count = len(self.cells)
        labels = self.cell_data.pop("face_label", numpy.zeros(count, "i8"))
        self.face_labels = labels[count:]
        assert not labels[:count].any(), "tetrahedra have labels of faces"
        for name, array in self.cell_data.items():
            assert not array[count:].any(), f"triangles have values of {name}"
            self.cell_data[name] = array[:count]

    def line(self):
        end = self.data.find(b"\n", self.at)
        end = end if end >= 0 else len(self.data)
        text = self.data[self.at:end].decode(errors="replace")
        self.at = end + 1
        return text

    def values(self, count, kind):
        width = {"float": "f4", "double": "f8", "int": "i4", "vtktypeint64": "i8",
                 "long": "i8", "vtkIdType": "i8"}[kind]
        array = numpy.frombuffer(self.data, ">" + width, count, self.at).astype(width)
        self.at += count * int(width[1])
        return array
