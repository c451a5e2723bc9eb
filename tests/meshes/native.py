#!/usr/bin/python3
"""native.py --tetstream PROGRAM --mesh FILE [--ratio R]

A mesh as its authors wrote it, FILE of the folder native, is simplified into every format that is
written; what others read in the results has to be, value for value, what was sent:
  sent        what the .sva file says, decoded here: positions, cells, fields, cell data
  vtu         VTK and meshio; labelled faces are those that `tetstream info` counts in the stream
  vtk, vtkhdf VTK, with the faces
  msh         meshio and Gmsh, both versions as text and binary; with the faces that VTK found
  mesh, meshb meshio, with the faces; fields: the .sol file decoded here
  svb         decoded here
  all         our own readers, cell by cell
What a format cannot hold must have been told in a note. Before that, what we read in FILE itself has
to be what meshio reads there; of TetGen's and SU2's files, what is read here, and so of Exodus' where
meshio lacks netCDF4. Without meshio or Gmsh their part is left out, without VTK the test is "not run".
"""
import argparse
import contextlib
import io
import os
import subprocess
import sys
import urllib.parse

try:
    import numpy as np
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print("not run:", missing)
    sys.exit(77)

try:
    import meshio
except ImportError:
    meshio = None
try:
    from scipy.io import netcdf_file
except ImportError:
    netcdf_file = None
try:
    import gmsh
except ImportError:
    gmsh = None

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import face_labels  # noqa: E402
import harness  # noqa: E402
from vtk_files import grid_of  # noqa: E402

TRIANGLE, TETRAHEDRON = 5, 10
REGIONS = ("gmsh:physical", "medit:ref")  # how meshio calls a label of cells
WAYS = (("vtu", "--compress", "yes"), ("vtu", "--compress", "no"), ("vtk",), ("vtkhdf",),
        ("msh", "--msh-version", "4.1", "--encoding", "binary"),
        ("msh", "--msh-version", "4.1", "--encoding", "text"),
        ("msh", "--msh-version", "2.2", "--encoding", "binary"),
        ("msh", "--msh-version", "2.2", "--encoding", "text"),
        ("mesh",), ("meshb",), ("svb",), ("tets",))


class Mesh:
    """faces: rows of three sorted vertices and a label, sorted; None: the format has none."""

    def __init__(self, points, cells, fields, cell_data, faces=None):
        self.points, self.cells, self.faces = points, cells, faces
        self.fields, self.cell_data = fields, cell_data


def rows_of(values):
    values = np.asarray(values)
    return values.reshape(len(values), -1)


def sorted_faces(corners, labels):
    rows = np.column_stack([np.sort(corners, 1), labels]).astype(int)
    return rows[np.lexsort(rows.T[::-1])]


# ------------------------------------------------------------------------------- the streams


def read_stream(vertices, cells):
    """Vertices in order, and cells (first unknown vertex, four references) with vertices from 0."""
    corners = [[r - 1 if r > 0 else known + r for r in refs] for known, refs in cells]
    return np.array(vertices), np.array(corners).reshape(-1, 4)


def read_sva(path):
    """The header's types say how the numbers that follow a position or a cell are parted."""
    arrays, rows, head = [], {"v": [], "c": []}, {}
    known, cells = 0, []
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words[0] == "#" and words[1].startswith("tetstream:"):
                arrays.append(words[1].split(":", 4))
            elif words[0] == "#":
                head[words[1]] = words[2:]
            elif words[0] == "v":
                rows["v"].append(words[1:])
                known += 1
            elif words[0] == "c":
                cells.append((known, list(map(int, words[1:5]))))
                rows["c"].append(words[5:])
    position = next((a[2] for a in arrays if a[1] == "position"), "float32")
    values = np.array(rows["v"])
    points, corners = read_stream(values[:, :3], cells)
    found = {"vertex": {}, "cell": {}}
    for of, table in (("vertex", values[:, 3:]), ("cell", np.array(rows["c"]))):
        at = 0
        # Floats come first.
        mine = [a for a in arrays if a[1] == of]
        for _, _, kind, components, name in sorted(mine, key=lambda a: a[2].startswith("int")):
            columns = table[:, at:at + int(components)]
            found[of][urllib.parse.unquote(name)] = columns.astype(kind)
            at += int(components)
    return Mesh(points.astype(position), corners, found["vertex"], found["cell"])


def read_svb(path):
    """Without a box and comments, in this machine's byte order, as we write it."""
    words = np.fromfile(path, "<i4", offset=4, count=5)
    floats, ints = words[3:5]
    at = 24 + (floats > 0) + (ints > 0)
    if floats and np.fromfile(path, "u1", offset=24, count=1)[0]:
        sys.exit(f"{path} has a box")
    body = np.fromfile(path, "<i4", offset=at)
    vertices, cells = [], []
    for block in range(0, len(body), 129):
        elements = body[block + 1:block + 129].reshape(-1, 4)
        for bit, element in enumerate(elements):
            if int(body[block]) >> bit & 1:
                vertices.append(element)
            else:
                cells.append((len(vertices), list(map(int, element))))
    rows, corners = read_stream(vertices, cells)
    values = {"": rows[:, 3:].view("<f4" if floats == 4 else "<i4")} if floats + ints == 4 else {}
    return Mesh(np.ascontiguousarray(rows[:, :3]).view("<f4"), corners, values, {})


# ------------------------------------------------------------------------------------ others


def with_vtk(path):
    grid = grid_of(path)
    types = vtk_to_numpy(grid.GetCellTypesArray())
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    starts = vtk_to_numpy(grid.GetCells().GetOffsetsArray())[:-1]
    tetrahedra, triangles = types == TETRAHEDRON, types == TRIANGLE

    def arrays(data, rows):
        return {data.GetArrayName(i): rows_of(vtk_to_numpy(data.GetArray(i)))[rows]
                for i in range(data.GetNumberOfArrays())}

    data = arrays(grid.GetCellData(), slice(None))
    labels = data.pop("face_label", np.empty((len(types), 1), int))
    faces = sorted_faces(corners[starts[triangles][:, None] + np.arange(3)],
                         labels[triangles, 0])
    return Mesh(vtk_to_numpy(grid.GetPoints().GetData()),
                corners[starts[tetrahedra][:, None] + np.arange(4)],
                arrays(grid.GetPointData(), slice(None)),
                {name: values[tetrahedra] for name, values in data.items()},
                faces)


def with_meshio(path):
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        mesh = meshio.read(path)

    def blocks(kind, lists):
        return [rows for block, rows in zip(mesh.cells, lists) if block.type == kind]

    def joined(kind, lists):
        parts = blocks(kind, lists)
        return np.concatenate(parts) if parts else np.empty((0, 3), int)

    corners = [block.data for block in mesh.cells]
    data = {name: rows_of(joined("tetra", lists)) for name, lists in mesh.cell_data.items()}
    faces = None
    of_faces = [name for name in ("face_label", *REGIONS) if name in mesh.cell_data]
    if of_faces:
        faces = sorted_faces(joined("triangle", corners),
                             joined("triangle", mesh.cell_data[of_faces[0]]).ravel()[:, None])
    data.pop("face_label", None)
    return Mesh(mesh.points, joined("tetra", corners),
                {name: rows_of(values) for name, values in mesh.point_data.items()}, data, faces)


def with_gmsh(path):
    gmsh.initialize(["", "-v", "0"])
    gmsh.open(path)
    tags, positions, _ = gmsh.model.mesh.getNodes()
    order = np.argsort(tags)
    of_kind = {2: [], 3: []}
    for dimension, entity in gmsh.model.getEntities():
        groups = gmsh.model.getPhysicalGroupsForEntity(dimension, entity)
        group = groups[0] if len(groups) > 0 else 0
        _, elements, nodes = gmsh.model.mesh.getElements(dimension, entity)
        for numbers, corners in zip(elements, nodes):
            rows = corners.reshape(len(numbers), -1).astype(int) - 1
            of_kind[dimension].append(np.column_stack([numbers, rows, np.full(len(rows), group)]))
    cells = np.concatenate(of_kind[3])
    cells = cells[np.argsort(cells[:, 0])].astype(int)
    faces = np.concatenate([np.empty((0, 5), int), *of_kind[2]]).astype(int)
    fields, cell_data = {}, {"gmsh:physical": cells[:, 5:]}
    for tag in gmsh.view.getTags():
        name = gmsh.option.getString(f"View[{gmsh.view.getIndex(tag)}].Name")
        kind, _, values, _, _ = gmsh.view.getModelData(tag, 0)
        (fields if kind == "NodeData" else cell_data)[name] = rows_of(values)
    gmsh.finalize()
    return Mesh(positions.reshape(-1, 3)[order], cells[:, 1:5], fields, cell_data,
                sorted_faces(faces[:, 1:4], faces[:, 4]))


def read_sol(path, rows):
    """The numbers of the section SolAtVertices of a text, one row each."""
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    if "SolAtVertices" not in words:
        return None
    at = words.index("SolAtVertices") + 1
    width = sum({1: 1, 2: 3, 3: 6, 4: 9}[int(word)]
                for word in words[at + 2:at + 2 + int(words[at + 1])])
    at += 2 + int(words[at + 1])
    return np.array(words[at:at + rows * width], float).reshape(rows, width)


def read_tetgen(path):
    """Points, cells and, where there is one, the attribute of the cells."""
    tables = []
    for ending in (".node", ".ele"):
        with open(os.path.splitext(path)[0] + ending, encoding="ascii") as file:
            lines = [line.split("#")[0].split() for line in file]
        lines = [words for words in lines if words]
        tables.append(np.array(lines[1:1 + int(lines[0][0])], float))
    nodes, elements = tables
    columns = {"region": elements[:, 5:]} if elements.shape[1] > 5 else {}
    return Mesh(nodes[:, 1:4], (elements[:, 1:5] - nodes[0, 0]).astype(int), {}, columns)


def read_su2(path):
    mesh = face_labels.read_su2(path)
    return Mesh(mesh.points, mesh.cells, {}, {"zone": mesh.regions[:, None]})


def read_exodus(path):
    """A classic netCDF file's points, cells and, of the first step, fields; of one block elements'."""
    with netcdf_file(path, mmap=False) as file:
        arrays = {name: variable.data for name, variable in file.variables.items()}
        kinds = {name: getattr(variable, "elem_type", b"").upper()
                 for name, variable in file.variables.items()}
    points = arrays.get("coord")
    if points is None:
        points = np.stack([arrays["coord" + axis] for axis in "xyz"])
    blocks = [name for name in sorted(arrays, key=lambda name: (len(name), name))
              if name.startswith("connect") and kinds[name] in (b"TETRA", b"TETRA4", b"TET4")]

    def values(names, first, last=""):
        names = [bytes(row).rstrip(b"\0 ").decode() for row in arrays.get(names, [])]
        return {name: rows_of(arrays[f"{first}{i + 1}{last}"][0]) for i, name in enumerate(names)
                if f"{first}{i + 1}{last}" in arrays}

    alone = blocks == ["connect1"]
    return Mesh(points.T, np.concatenate([arrays[name] for name in blocks]) - 1,
                values("name_nod_var", "vals_nod_var"),
                values("name_elem_var", "vals_elem_var", "eb1") if alone else {})


def read_original(path):
    """As others read it; None: they are not here."""
    if path.endswith(".node"):
        return read_tetgen(path)
    if path.endswith(".su2"):
        return read_su2(path)
    try:
        return with_meshio(path) if meshio else None
    except ImportError as missing:  # meshio needs netCDF4 for Exodus
        if path.endswith(".exo") and netcdf_file:
            return read_exodus(path)
        print("not compared with the file itself:", missing)
        return None


# ------------------------------------------------------------------------------------ checks


class Checks:
    def __init__(self):
        self.failed, self.passed = 0, 0

    def expect(self, holds, sentence):
        self.passed += 1
        if not holds:
            print("  FAILED:", sentence)
            self.failed += 1


def equal(found, sent):
    """A text with a float32's digits reads as another float64: back in the type that was sent."""
    found = rows_of(found)
    return found.shape == sent.shape and np.array_equal(found.astype(sent.dtype), sent)


class NativeMesh:
    def __init__(self, args):
        self.tetstream = harness.Tetstream(args.tetstream)
        self.path = os.path.join(harness.folder("TETSTREAM_MESHES"), "native", args.mesh)
        self.ratio, self.checks = args.ratio, Checks()
        self.simplify("sva")
        self.sent = read_sva(self.tetstream.path("small.sva"))
        self.faces = None

    def simplify(self, kind, *words):
        """The report, and what was said on standard error."""
        command = [self.tetstream.program, "simplify", self.path,
                   self.tetstream.path("small." + kind), "--ratio", str(self.ratio), *words]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              check=False)
        self.checks.expect(done.returncode == 0, done.stderr)
        return done.stdout, done.stderr

    def compare(self, who, found, names=True, columns=True):
        """`names`: all arrays are there under the names that they were sent with."""
        sent = self.sent
        self.checks.expect(equal(found.points, sent.points), f"{who}: other points")
        self.checks.expect(equal(found.cells, sent.cells), f"{who}: other cells")
        if found.faces is not None and self.faces is not None:
            self.checks.expect(np.array_equal(found.faces, self.faces),
                               f"{who}: {len(found.faces)} labelled faces, of {len(self.faces)}")
        for what, mine, theirs in (("field", sent.fields, found.fields),
                                   ("cell array", sent.cell_data, found.cell_data)):
            for name, values in mine.items() if columns else ():
                if names or name in theirs:
                    self.checks.expect(name in theirs and equal(theirs[name], values),
                                       f"{who}: {what} \"{name}\" differs or is not there")

    def check_region(self, who, found):
        """What labels cells in Gmsh and in MEDIT has their own name there."""
        for name in REGIONS:
            if name in found.cell_data:
                columns = [v for v in self.sent.cell_data.values() if v.dtype.kind == "i"]
                self.checks.expect(
                    not columns or any(equal(found.cell_data[name], v) for v in columns),
                    f"{who}: labels of cells differ")

    def check_vtk(self, kind, path):
        found = with_vtk(path)
        if kind == "vtu" and self.faces is None:
            counted = {int(v): int((found.faces[:, 3] == v).sum())
                       for v in np.unique(found.faces[:, 3])}
            self.simplify("tets")
            told = self.tetstream.info(self.tetstream.path("small.tets")).get("face_labels", [])
            told = {row["label"]: row["faces"] for row in told}
            self.checks.expect(counted == told, f"VTK: faces {counted}, in the stream {told}")
            self.faces = found.faces
        self.compare("VTK, " + kind, found)

    def check_meshio(self, kind, path, words):
        who = f"meshio, {kind} {' '.join(words)}"
        found = with_meshio(path)
        self.check_region(who, found)
        self.compare(who, found, names=kind == "vtu")

    def check_gmsh(self, path, words):
        who = "Gmsh " + " ".join(words)
        found = with_gmsh(path)
        self.check_region(who, found)
        self.compare(who, found, names=False)
        if "4.1" in words:
            self.checks.expect(set(self.sent.fields) <= set(found.fields),
                               f"{who}: fields are not there")

    def check_solution(self, path):
        sent = self.solutions(self.sent)
        if sent is None:
            return
        found = read_sol(path, len(sent))
        self.checks.expect(found is not None and equal(found, sent),
                           "the .sol file has other values")

    def read_by_us(self, path):
        back = self.tetstream.path("back.sva")
        self.tetstream.run("convert", path, back, "--quiet", "--order", "none")
        return read_sva(back)

    def check_cells(self, who, found, sent):
        """Cells in their order, with the values at their corners; true if they are as many."""
        used = len(np.unique(sent.cells))
        self.checks.expect(len(found.points) == used, f"{who}: other vertices")
        same = len(found.cells) == len(sent.cells)
        self.checks.expect(same and np.array_equal(
            found.points[found.cells].astype(sent.points.dtype), sent.points[sent.cells]),
            f"{who}: other cells")
        return same

    def check_at_corners(self, who, name, found, mine, sent, theirs):
        self.checks.expect(
            mine is not None
            and np.array_equal(mine[found.cells].astype(theirs.dtype), theirs[sent.cells]),
            f"{who}: field \"{name}\" differs")

    def check_ours(self, kind, path, words):
        found, sent, who = self.read_by_us(path), self.sent, f"ours, {kind} {' '.join(words)}"
        if not self.check_cells(who, found, sent):
            return
        if kind in ("mesh", "meshb"):  # those have no names
            mine, theirs = (self.solutions(mesh) for mesh in (found, sent))
            if theirs is not None:
                self.check_at_corners(who, "sol", found, mine, sent, theirs)
            return
        for name, values in sent.fields.items():
            self.check_at_corners(who, name, found, found.fields.get(name), sent, values)
        for name, values in sent.cell_data.items():
            self.checks.expect(name in found.cell_data and equal(found.cell_data[name], values),
                               f"{who}: cell array \"{name}\" differs")

    @staticmethod
    def solutions(mesh):
        columns = [v for name, v in mesh.fields.items() if name != "medit:ref"]
        return np.concatenate(columns, 1) if columns else None

    def check_reading(self):
        """The file itself. What others do not read, Exodus' block ids for one, is not compared."""
        sent = read_original(self.path)
        if sent is None:
            return
        found, who = self.read_by_us(self.path), "the file itself"
        if not self.check_cells(who, found, sent):
            return
        for name, values in sent.fields.items():
            if name in found.fields:
                self.check_at_corners(who, name, found, found.fields[name], sent, values)
            else:
                self.checks.expect(name == "gmsh:dim_tags" or not values.any(),
                                   f"{who}: field \"{name}\" is not read")
        for name, values in sent.cell_data.items():
            self.checks.expect(equal(found.cell_data.get(name, values * 0), values),
                               f"{who}: cell array \"{name}\" differs")

    def check_svb(self, path, said):
        """Rounded before it is simplified: only where nothing was is it the same mesh."""
        found = read_svb(path)
        if self.sent.points.dtype == np.float64:
            self.checks.expect("rounded to float32" in said, "svb: not told that it is rounded")
            report = [int(found.cells.max()) + 1, len(found.points)]
            self.checks.expect(report[0] == report[1], "svb: vertices that no cell uses")
        else:
            self.compare("svb", found, columns=False)
            if "" in found.fields:
                first = next(v for v in self.sent.fields.values() if v.shape[1] == 1)
                self.checks.expect(equal(found.fields[""], first), "svb: another scalar")
        for name in list(self.sent.fields)[1:] + list(self.sent.cell_data):
            self.checks.expect(f'"{name}" is left out' in said, f"svb: {name} is dropped")

    def run(self):
        self.check_reading()
        for kind, *words in WAYS:
            path = self.tetstream.path("small." + kind)
            _, said = self.simplify(kind, *words)
            if kind in ("vtu", "vtk", "vtkhdf"):
                self.check_vtk(kind, path)
            if meshio and (kind in ("mesh", "meshb", "msh") or "no" in words):
                self.check_meshio(kind, path, words)
            if gmsh and kind == "msh":
                self.check_gmsh(path, words)
            if kind == "mesh":
                self.check_solution(self.tetstream.path("small.sol"))
            if kind == "svb":
                self.check_svb(path, said)
            else:
                self.check_ours(kind, path, words)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tetstream", required=True, metavar="PROGRAM")
    parser.add_argument("--mesh", required=True, metavar="FILE")
    parser.add_argument("--ratio", type=float, default=0.1, metavar="R")
    mesh = NativeMesh(parser.parse_args())
    mesh.run()
    print(f"{os.path.basename(mesh.path)}: {len(mesh.sent.cells)} cells, {len(mesh.faces)} labelled "
          f"faces, {len(mesh.sent.fields)} fields, {len(mesh.sent.cell_data)} cell arrays; "
          f"{mesh.checks.passed} comparisons, {mesh.checks.failed} failed"
          + ("" if meshio else "; no meshio") + ("" if gmsh else "; no Gmsh"))
    sys.exit(mesh.checks.failed > 0)


if __name__ == "__main__":
    main()
