#!/usr/bin/python3
"""make_bracket.py [OUT.vtu]

Makes the example mesh of the README: meshes bracket.geo with gmsh and computes on it how the
bracket bends under a load, by linear elastic finite elements on the same tetrahedra. Needs the
Debian packages gmsh, python3-numpy and python3-scipy. Run once; the result is kept beside it.

Units: mm, N, N/mm2. Steel. The bracket is held where the heads of its two screws press on the
wall plate; 400 N press on the upper face of the shelf plate.
"""
import os
import subprocess
import sys
import tempfile
import zlib

import numpy as np
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import cg

HERE = os.path.dirname(os.path.abspath(__file__))
YOUNG, POISSON = 210000.0, 0.3
LOAD = 400.0
THICK, SCREWS, WASHER = 6.0, ((13.0, 52.0), (47.0, 52.0)), 7.5  # as in bracket.geo


def mesh(geo):
    """The points and tetrahedra that gmsh makes of a .geo file."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "bracket.msh")
        subprocess.run(["gmsh", "-3", "-format", "msh2", "-v", "2", geo, "-o", path], check=True)
        lines = open(path, encoding="ascii").read().split("\n")
    at = lines.index("$Nodes") + 1
    count = int(lines[at])
    points = np.array([line.split()[1:] for line in lines[at + 1:at + 1 + count]], float)
    at = lines.index("$Elements") + 1
    rows = [line.split() for line in lines[at + 1:at + 1 + int(lines[at])]]
    tets = np.array([row[-4:] for row in rows if row[1] == "4"], np.int64) - 1
    used = np.unique(tets)
    new = np.full(count, -1)
    new[used] = np.arange(len(used))
    points = points[used].astype(np.float32).astype(float)  # as they will be written
    return points, new[tets]


def gradients(points, tets):
    """Of the four linear shape functions of each tetrahedron, [m][4][3], and the volumes."""
    edges = points[tets[:, 1:]] - points[tets[:, :1]]
    inner = np.transpose(np.linalg.inv(edges), (0, 2, 1))
    grads = np.concatenate([-inner.sum(1, keepdims=True), inner], 1)
    return grads, np.abs(np.linalg.det(edges)) / 6


def strain_matrices(grads):
    """[m][6][12]: from the displacements of four corners to xx yy zz xy yz zx."""
    b = np.zeros((len(grads), 6, 12))
    for corner in range(4):
        x, y, z = grads[:, corner].T
        c = 3 * corner
        b[:, 0, c], b[:, 1, c + 1], b[:, 2, c + 2] = x, y, z
        b[:, 3, c], b[:, 3, c + 1] = y, x
        b[:, 4, c + 1], b[:, 4, c + 2] = z, y
        b[:, 5, c], b[:, 5, c + 2] = z, x
    return b


def elasticity():
    lam = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    shear = YOUNG / (2 * (1 + POISSON))
    d = np.diag([2 * shear] * 3 + [shear] * 3)
    d[:3, :3] += lam
    return d


def boundary_faces(tets):
    faces = tets[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3)
    _, first, count = np.unique(np.sort(faces, 1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def load_vector(points, tets):
    faces = boundary_faces(tets)
    corners = points[faces]
    up = np.abs(corners[:, :, 2] - THICK).max(1) < 1e-4
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                          axis=1) / 2
    force = np.zeros((len(points), 3))
    share = LOAD * area[up] / area[up].sum() / 3
    np.subtract.at(force[:, 2], faces[up].ravel(), np.repeat(share, 3))
    return force.ravel()


def held(points):
    near = [np.hypot(points[:, 0] - x, points[:, 2] - z) < WASHER for x, z in SCREWS]
    return np.logical_or(*near) & (np.abs(points[:, 1] - THICK) < 1e-4)


def solve(points, tets):
    """Displacement of each vertex, and von Mises' stress, averaged from cells to vertices."""
    grads, volume = gradients(points, tets)
    b, d = strain_matrices(grads), elasticity()
    stiff = np.einsum("mki,kl,mlj,m->mij", b, d, b, volume, optimize=True)
    unknowns = (3 * tets[:, :, None] + np.arange(3)).reshape(-1, 12)
    i, j = np.repeat(unknowns, 12, 1).ravel(), np.tile(unknowns, (1, 12)).ravel()
    size = 3 * len(points)
    matrix = coo_matrix((stiff.ravel(), (i, j)), (size, size)).tocsr()
    free = np.repeat(~held(points), 3)
    matrix, force = matrix[free][:, free], load_vector(points, tets)[free]
    moved = np.zeros(size)
    moved[free], failed = cg(matrix, force, tol=1e-8, M=diags(1 / matrix.diagonal()))
    if failed:
        sys.exit("make_bracket: the solver did not converge")
    stress = np.einsum("kl,mlj,mj->mk", d, b, moved[unknowns], optimize=True)
    xx, yy, zz, xy, yz, zx = stress.T
    mises = np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2
                    + 3 * (xy ** 2 + yz ** 2 + zx ** 2))
    total, weight = np.zeros(len(points)), np.zeros(len(points))
    np.add.at(total, tets.ravel(), np.repeat(mises * volume, 4))
    np.add.at(weight, tets.ravel(), np.repeat(volume, 4))
    return moved.reshape(-1, 3), total / weight


def block(data):
    """An array as VTK's appended data holds it: counts, then blocks compressed with zlib."""
    size = 1 << 15
    parts = [zlib.compress(data[k:k + size], 9) for k in range(0, len(data), size)]
    header = [len(parts), size, len(data) % size] + [len(part) for part in parts]
    return np.array(header, "<u8").tobytes() + b"".join(parts)


def write_vtu(path, points, tets, fields):
    arrays = [("Points", "Float32", 3, points.astype("<f4"))]
    arrays += [("connectivity", "Int32", 1, tets.astype("<i4")),
               ("offsets", "Int32", 1, 4 * np.arange(1, len(tets) + 1, dtype="<i4")),
               ("types", "UInt8", 1, np.full(len(tets), 10, np.uint8))]
    arrays += [(name, "Float32", 1 if field.ndim == 1 else 3, field.astype("<f4"))
               for name, field in fields.items()]
    tags, data = {}, b""
    for name, kind, components, values in arrays:
        tags[name] = (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" '
                      f'format="appended" offset="{len(data)}"/>')
        data += block(values.tobytes())
    with open(path, "wb") as out:
        out.write(f"""<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64" \
compressor="vtkZLibDataCompressor">
<UnstructuredGrid>
<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(tets)}">
<Points>{tags["Points"]}</Points>
<Cells>{tags["connectivity"]}{tags["offsets"]}{tags["types"]}</Cells>
<PointData>{"".join(tags[name] for name in fields)}</PointData>
</Piece>
</UnstructuredGrid>
<AppendedData encoding="raw">
_""".encode("ascii") + data + b"\n</AppendedData>\n</VTKFile>\n")


def main():
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(HERE, "bracket.vtu")
    points, tets = mesh(os.path.join(HERE, "bracket.geo"))
    moved, mises = solve(points, tets)
    write_vtu(out, points, tets, {"displacement": moved, "von_mises": mises})
    print(f"{out}: {len(tets)} cells, {len(points)} vertices, bends {-moved[:, 2].min():.4f} mm, "
          f"{mises.max():.1f} N/mm2, {os.path.getsize(out)} bytes")


if __name__ == "__main__":
    main()
