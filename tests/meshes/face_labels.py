#!/usr/bin/python3
"""face_labels.py --tetstream PROGRAM --mesh NAME [--ratio R]

Simplifies a mesh with labelled faces, once in core and once in a window of four fronts. NAME is
"generated", a box with labelled sides, two regions and a patch on one side, "sheets", the same with
labelled faces inside the regions, or a mesh in the folder of meshes: native/NAME.su2, of several
zones with markers, or native/NAME.msh, with physical surfaces, which meshio reads. It is written
here as a .vtu file of tetrahedra and triangles, goes through a .tets file, and comes out as .vtu,
which VTK reads. Every one of these must hold:
  faces       labelled triangles are the faces of the boundary, each of them once, as before, and
              faces inside where there were some
  area        each label's is kept within 1 %
  sheets      each label has as many parts as before, with their Euler characteristic
  curves      the graph of the curves where labels meet is that of the original
  shape       the Hausdorff distance of what is labelled inside is at most that of the boundary, or
              FLOOR
  regions     the judge of regions, where it is there, finds volumes and parts kept
  reached     the target is
  told        info and compare count the same faces, and find the same areas
"""
import argparse
import json
import os
import subprocess
import sys

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print("not run:", missing)
    sys.exit(77)

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402
import strata  # noqa: E402
from region_mesh import FLOOR, FRONTS, Checks, hausdorff  # noqa: E402

AREA = 0.01  # of a label, kept within
TRIANGLE, TETRAHEDRON = 5, 10


class Labelled:
    """points, cells with their regions, faces with their labels."""

    def __init__(self, points, cells, regions, faces, labels):
        self.points, self.cells, self.regions = points, cells, regions
        self.faces, self.labels = faces, labels

    def areas(self):
        a, b, c = (self.points[self.faces[:, j]] for j in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        return {int(v): area[self.labels == v].sum() for v in np.unique(self.labels)}


def read_su2(path):
    """All zones, each a region with points of its own; markers are numbered as they come."""
    with open(path, encoding="ascii") as file:
        lines = [line.strip() for line in file if line.strip() and not line.startswith("%")]
    points, cells, regions, faces, labels = [], [], [], [], []
    at = zone = marker = before = 0
    while at < len(lines):
        key, _, value = lines[at].partition("=")
        at += 1
        if key.strip() == "IZONE":
            zone, before = int(value), len(points)
        elif key.strip() == "NELEM":
            for line in lines[at:at + int(value)]:
                words = list(map(int, line.split()))
                assert words[0] == TETRAHEDRON
                cells.append([before + v for v in words[1:5]])
                regions.append(zone)
            at += int(value)
        elif key.strip() == "NPOIN":
            count = int(value.split()[0])
            points += [list(map(float, line.split()[:3])) for line in lines[at:at + count]]
            at += count
        elif key.strip() == "MARKER_ELEMS":
            marker += 1
            for line in lines[at:at + int(value)]:
                words = list(map(int, line.split()))
                assert words[0] == TRIANGLE
                faces.append([before + v for v in words[1:4]])
                labels.append(marker)
            at += int(value)
    return Labelled(*map(np.array, (points, cells, regions, faces, labels)))


def read_msh(path):
    """Physical volumes as regions, physical surfaces as labels."""
    try:
        import meshio
    except ImportError as missing:
        print("not run:", missing)
        sys.exit(77)
    mesh = meshio.read(path)

    def rows(kind):
        blocks = [(block.data, groups) for block, groups
                  in zip(mesh.cells, mesh.cell_data["gmsh:physical"]) if block.type == kind]
        return (np.concatenate(part).astype(int) for part in zip(*blocks))

    return Labelled(mesh.points, *rows("tetra"), *rows("triangle"))


def faces_of(cells, count):
    """The faces of so many cells, with sorted vertices."""
    faces = np.sort(cells[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3), 1)
    unique, found = np.unique(faces, axis=0, return_counts=True)
    return unique[found == count]


def sheet_of(middle, axis, at, low, high):
    """Faces of the plane where their middles lie in a rectangle."""
    others = np.delete(middle, axis, 1)
    return ((np.abs(middle[:, axis] - at) < 1e-9)
            & (others > low).all(1) & (others < high).all(1))


def add_sheets(mesh, n):
    """Labels 201 to 204 inside: a square, one that crosses it, one that ends at three sides, and
    the surface of a box."""
    faces = faces_of(mesh.cells, 2)
    middle = mesh.points[faces].mean(1)
    plane = (np.ptp(mesh.points[faces], axis=1) < 1e-9).any(1)
    h = n / 2
    box = np.abs(middle - [h, h, 1.5 * n]).max(1)
    labels = np.select(
        [sheet_of(middle, 2, h, [1, 1], [n - 1, n - 1]),
         sheet_of(middle, 0, h, [2, h - 2], [n - 2, h + 2]),
         sheet_of(middle, 2, n - 1, [-1, -1], [h, n + 1]),
         np.abs(box - 2) < 1e-9], [201, 202, 203, 204])
    chosen = plane & (labels > 0)
    return Labelled(mesh.points, mesh.cells, mesh.regions,
                    np.concatenate([mesh.faces, faces[chosen]]),
                    np.concatenate([mesh.labels, labels[chosen]]))


def generate(n, shake=0.2):
    """A box of n x n x 2n cubes of six cells, moved a little inside; two regions along z; sides
    labelled 1 to 6, and on the last a patch in the middle, labelled 100."""
    side = np.array([n, n, 2 * n])
    grid = np.stack(np.meshgrid(*[np.arange(s + 1) for s in side], indexing="ij"), -1)
    points = grid.reshape(-1, 3).astype(float)
    inside = ((points > 0) & (points < side)).all(1)
    points[inside] += np.random.default_rng(1).uniform(-shake, shake, (inside.sum(), 3))
    number = np.arange(len(points)).reshape(side + 1)
    corner = np.stack(np.meshgrid(*[np.arange(s) for s in side], indexing="ij"), -1).reshape(-1, 3)
    steps = np.eye(3, dtype=int)
    cells, regions = [], []
    for order in ((0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)):
        path = np.cumsum([np.zeros(3, int)] + [steps[k] for k in order], axis=0)
        cells.append(np.stack([number[tuple((corner + step).T)] for step in path], 1))
        regions.append(1 + (corner[:, 2] >= n))
    cells, regions = np.concatenate(cells), np.concatenate(regions)
    faces = faces_of(cells, 1)
    at = points[faces]
    labels = np.zeros(len(faces), int)
    for axis in range(3):
        labels[(at[:, :, axis] == 0).all(1)] = 2 * axis + 1
        labels[(at[:, :, axis] == side[axis]).all(1)] = 2 * axis + 2
    middle = (np.abs(at[:, :, :2] - n / 2) <= n / 4).all((1, 2))
    labels[(labels == 6) & middle] = 100
    order = np.random.default_rng(2).permutation(len(cells))
    return Labelled(points, cells[order], regions[order], faces, labels)


def write_vtu(path, mesh, with_faces=True):
    """Tetrahedra, and triangles in front of and behind them; one array labels both."""
    kinds = [(mesh.cells, TETRAHEDRON, mesh.regions)]
    if with_faces:
        half = len(mesh.faces) // 2
        kinds = [(mesh.faces[:half], TRIANGLE, mesh.labels[:half]), *kinds,
                 (mesh.faces[half:], TRIANGLE, mesh.labels[half:])]
    sizes = np.concatenate([np.full(len(rows), rows.shape[1]) for rows, _, _ in kinds])

    def array(kind, name, values, more=""):
        text = " ".join(map(str, np.concatenate([np.ravel(v) for v in values])))
        return (f'<DataArray type="{kind}" Name="{name}" {more}format="ascii">{text}'
                "</DataArray>\n")

    with open(path, "w", encoding="ascii") as file:
        file.write('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">\n'
                   f'<UnstructuredGrid><Piece NumberOfPoints="{len(mesh.points)}" '
                   f'NumberOfCells="{len(sizes)}">\n<Points>'
                   + array("Float64", "Points", [mesh.points], 'NumberOfComponents="3" ')
                   + "</Points><Cells>"
                   + array("Int64", "connectivity", [rows for rows, _, _ in kinds])
                   + array("Int64", "offsets", [np.cumsum(sizes)])
                   + array("UInt8", "types", [np.full(len(r), t) for r, t, _ in kinds])
                   + "</Cells><CellData>" + array("Int32", "zone", [v for _, _, v in kinds])
                   + "</CellData></Piece></UnstructuredGrid></VTKFile>\n")


def read_vtu(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    types = vtk_to_numpy(grid.GetCellTypesArray())
    values = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    starts = vtk_to_numpy(grid.GetCells().GetOffsetsArray())[:-1]
    data = {grid.GetCellData().GetArrayName(i): vtk_to_numpy(grid.GetCellData().GetArray(i))
            for i in range(grid.GetCellData().GetNumberOfArrays())}
    tets, triangles = types == TETRAHEDRON, types == TRIANGLE
    assert (tets | triangles).all()
    return Labelled(vtk_to_numpy(grid.GetPoints().GetData()).astype(float),
                    values[starts[tets][:, None] + np.arange(4)], data["zone"][tets],
                    values[starts[triangles][:, None] + np.arange(3)],
                    data["face_label"][triangles])


class Surface(strata.Strata):
    """The labelled faces as sheets: curves are where labels meet or a sheet ends."""

    def __init__(self, mesh):  # pylint: disable=super-init-not-called
        self.points = mesh.points
        self.sheets, self.labels = np.sort(mesh.faces, 1), mesh.labels
        edges = self.sheets[:, [[0, 1], [0, 2], [1, 2]]].reshape(-1, 2)
        unique, back = np.unique(edges, axis=0, return_inverse=True)
        around = [[] for _ in unique]
        for edge, label in zip(back.ravel(), np.repeat(self.labels, 3)):
            around[edge].append(int(label))
        chosen = [i for i, a in enumerate(around) if len(a) != 2 or a[0] != a[1]]
        self.curves = unique[chosen]
        self.curve_regions = [tuple(sorted(around[i])) for i in chosen]

    def regions(self):
        found = {}
        for label in np.unique(self.labels):
            faces = self.sheets[self.labels == label]
            edges = faces[:, [[0, 1], [0, 2], [1, 2]]].reshape(-1, 2)
            order = np.lexsort(edges.T[::-1])
            equal = (edges[order][1:] == edges[order][:-1]).all(1)
            links = np.stack([order[:-1][equal] // 3, order[1:][equal] // 3], 1)
            parts = strata.components(len(faces), links)
            found[int(label)] = (len(np.unique(parts)), int(strata.euler_of(faces)))
        return found

    def contacts(self):
        return {}


def judge_regions(tetstream, before, after, checks):
    path = os.path.join(os.environ.get("TETSTREAM_JUDGE", ""), "regions.py")
    if not os.path.isfile(path) or len(np.unique(before.regions)) == 1:
        return
    files = [tetstream.path("judged-before.vtu"), tetstream.path("judged-after.vtu")]
    for file, mesh in zip(files, (before, after)):
        write_vtu(file, mesh, with_faces=False)
    told = subprocess.run([sys.executable, path, *files], stdout=subprocess.PIPE, text=True,
                          check=False)
    print(" ", told.stdout.strip(), flush=True)
    checks.expect(told.returncode == 0, "the judge of regions objects")


class Surfaces:
    """For hausdorff: the boundary, and what is labelled inside."""

    def __init__(self, mesh):
        self.points, self.outer = mesh.points, faces_of(mesh.cells, 1)
        self.inner = np.sort(mesh.faces, 1)[~rows_in(np.sort(mesh.faces, 1), self.outer)]


def rows_in(rows, others):
    known = set(map(tuple, others))
    return np.array([tuple(row) in known for row in rows], bool)


def check_faces(before, after, checks):
    faces = np.sort(after.faces, 1)
    checks.expect(len(np.unique(faces, axis=0)) == len(faces), "a face is there twice")
    outer, inner = faces_of(after.cells, 1), faces_of(after.cells, 2)
    checks.expect(rows_in(outer, faces).all(), "a face of the boundary has lost its label")
    inside = faces[~rows_in(faces, outer)]
    checks.expect(rows_in(inside, inner).all(), "a labelled face is one of no cell")
    had_some = len(before.faces) > len(faces_of(before.cells, 1))
    checks.expect((len(inside) > 0) == had_some, f"{len(inside)} labelled faces inside")


def check_shape(before, after, checks):
    if not os.environ.get("TETSTREAM_JUDGE"):
        return
    judge, surfaces = harness.Judge(20000), (Surfaces(before), Surfaces(after))
    inner, outer = (hausdorff(judge.module, *surfaces, k) for k in ("inner", "outer"))
    print(f"  Hausdorff: inside {inner:.4f} %, boundary {outer:.4f} %", flush=True)
    checks.expect(inner <= max(outer, FLOOR), "what is labelled inside has moved too far")


def check_told(tetstream, original, out, before, after, checks):
    told = {row["label"]: row["faces"] for row in tetstream.info(out)["face_labels"]}
    counted = {int(v): int((after.labels == v).sum()) for v in np.unique(after.labels)}
    checks.expect(told == counted, f"info counts other faces: {told}, not {counted}")
    words = ("compare", original, out, "--report", "json", "--quiet")
    compared = json.loads(tetstream.run(*words)[0])
    areas = (before.areas(), after.areas())
    rows = {row["label"]: row for row in compared["face_labels"]}
    checks.expect(sorted(rows) == sorted(areas[0]), f"compare knows other labels: {sorted(rows)}")
    for label, row in rows.items():
        for mine, theirs in zip(areas, (row["original_area"], row["simplified_area"])):
            checks.expect(abs(mine[label] - theirs) <= 1e-6 * mine[label],
                          f"compare finds another area of label {label}: {theirs}")


def check(args, tetstream, before, original, stream, window, checks):
    out = tetstream.path("out.vtu")
    report = tetstream.simplify(stream, out, "--ratio", args.ratio, "--window", window)
    print(f"{args.mesh}, window {window}: {report['cells_in']} -> {report['cells_out']} cells in "
          f"{report['seconds']:.2f} s {report['limited_by']}", flush=True)
    asked, got = report["target_cells"], report["cells_out"]
    checks.expect(harness.deepest_allowed(asked) <= got <= asked,
                  f"{got} cells where {asked} were asked for: {report['limited_by']}")
    after = read_vtu(out)
    check_faces(before, after, checks)
    areas, kept = before.areas(), after.areas()
    worst = max(abs(kept.get(v, 0) / areas[v] - 1) for v in areas)
    print(f"  {len(before.faces)} -> {len(after.faces)} faces of {len(areas)} labels, worst area "
          f"off by {100 * worst:.3f} %", flush=True)
    checks.expect(set(kept) == set(areas) and worst <= AREA, "the area of a label is not kept")
    for sentence in strata.differences(Surface(before), Surface(after)):
        checks.expect(False, sentence)
    check_shape(before, after, checks)
    judge_regions(tetstream, before, after, checks)
    check_told(tetstream, original, out, before, after, checks)


def read(name):
    if name == "generated":
        return generate(8)
    if name == "sheets":
        return add_sheets(generate(8, 0), 8)
    path = os.path.join(harness.folder("TETSTREAM_MESHES"), "native", name)
    return read_msh(path + ".msh") if os.path.isfile(path + ".msh") else read_su2(path + ".su2")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tetstream", required=True, metavar="PROGRAM")
    parser.add_argument("--mesh", required=True, metavar="NAME")
    parser.add_argument("--ratio", type=float, default=0.1, metavar="R")
    args = parser.parse_args()
    tetstream = harness.Tetstream(args.tetstream)
    before = read(args.mesh)
    original = tetstream.path("in.vtu")
    write_vtu(original, before)
    stream = tetstream.convert(original, tetstream.path("in.tets"))
    info = tetstream.info(stream)
    checks = Checks()
    checks.expect(info["faces"] == len(before.faces), f"{info['faces']} faces were converted")
    for window in (info["cells"], FRONTS * info["front_cells"]):
        check(args, tetstream, before, original, stream, window, checks)
    sys.exit(checks.failed > 0)


if __name__ == "__main__":
    main()
