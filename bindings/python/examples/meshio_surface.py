#!/usr/bin/env python3
"""Reads a mesh with meshio, simplifies it and draws its surface before and after, and where the
field has changed:

    meshio_surface.py bracket.vtu bracket.png --field von_mises --ratio 0.1

Any format that meshio reads will do. The simplified mesh goes back to meshio, which writes it with
--out. Needs meshio, numpy, matplotlib and tetstream.
"""
import argparse

import matplotlib

matplotlib.use("Agg")  # into a file, without a screen

import meshio  # noqa: E402
import numpy  # noqa: E402
from matplotlib import cm, collections, colors, pyplot  # noqa: E402

import tetstream  # noqa: E402

# The faces of a cell, each with the corner across from it.
FACES = numpy.array([(1, 2, 3, 0), (0, 2, 3, 1), (0, 1, 3, 2), (0, 1, 2, 3)])

# viridis without its darkest part, on which edges would not be seen.
PALE = colors.ListedColormap(cm.viridis(numpy.linspace(0.25, 1, 256)))


def surface(mesh):
    """[k][3] corners of the faces of one cell only, turned so that their normals point outwards."""
    faces = mesh.cells[:, FACES].reshape(-1, 4)
    _, first, count = numpy.unique(numpy.sort(faces[:, :3], axis=1), axis=0, return_index=True,
                                   return_counts=True)
    outer = faces[first[count == 1]]
    a, b, c, inside = (mesh.points[outer[:, i]] for i in range(4))
    inward = numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), inside - a) > 0
    outer[inward, 1], outer[inward, 2] = outer[inward, 2], outer[inward, 1].copy()
    return outer[:, :3]


def length(values):
    """Of vectors and tensors the norm, of scalars themselves."""
    values = numpy.asarray(values, float)
    return values if values.ndim == 1 else numpy.linalg.norm(values, axis=1)


def view(turn, tilt):
    """A rotation: rows are right, up and towards the eye."""
    t, p = numpy.radians([turn, tilt])
    right = numpy.array([-numpy.sin(t), numpy.cos(t), 0])
    eye = numpy.array([numpy.cos(p) * numpy.cos(t), numpy.cos(p) * numpy.sin(t), numpy.sin(p)])
    return numpy.stack([right, numpy.cross(eye, right), eye])


def quarters(rows):
    """[k][3][...] of triangles' corners, as [4 k][3][...]: each in four, at its place in the order."""
    a, b, c = rows[:, 0], rows[:, 1], rows[:, 2]
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    parts = [numpy.stack(part, axis=1) for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c),
                                                    (ab, bc, ca))]
    return numpy.stack(parts, axis=1).reshape(-1, *rows.shape[1:])


def draw(axes, mesh, values, turned, colours):
    """Draws what is seen of the surface, from the back to the front, in the colours of the values,
    which are linear on each triangle, with its edges."""
    faces = surface(mesh)
    corners = mesh.points[faces] @ turned.T
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)[:, None]
    seen = numpy.flatnonzero(normals[:, 2] > 0)
    seen = seen[numpy.argsort(corners[seen, :, 2].mean(axis=1))]
    outlines, light = corners[seen][..., :2], 0.55 + 0.45 * normals[seen, 2]
    pieces, values, count = outlines, values[faces[seen]], 1
    while 0 < len(pieces) < 60000 and count < 64:
        pieces, values, count = quarters(pieces), quarters(values), 4 * count
    fill = colours.to_rgba(values.mean(axis=1))
    fill[:, :3] *= numpy.repeat(light, count)[:, None]
    # Each triangle's pieces, then its outline: what lies before it hides both.
    polygons = numpy.concatenate([pieces.reshape(len(seen), count, 3, 2), outlines[:, None]], axis=1)
    empty = numpy.zeros((len(seen), 1, 4))
    fill = fill.reshape(len(seen), count, 4)
    black = numpy.broadcast_to([0, 0, 0, 0.6], empty.shape)
    axes.add_collection(collections.PolyCollection(
        polygons.reshape(-1, 3, 2), linewidths=0.2,
        facecolors=numpy.concatenate([fill, empty], axis=1).reshape(-1, 4),
        edgecolors=numpy.concatenate([fill, black], axis=1).reshape(-1, 4)))
    axes.autoscale()
    axes.set_aspect("equal")
    axes.set_axis_off()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", help="a file that meshio reads")
    parser.add_argument("picture", help="a PNG, SVG or PDF")
    parser.add_argument("--field", help="the field that is kept and drawn; the first one")
    parser.add_argument("--ratio", type=float, default=0.1, help="cells out / cells in")
    parser.add_argument("--turn", type=float, default=40, help="degrees around z")
    parser.add_argument("--tilt", type=float, default=30, help="degrees above the plane of x and y")
    parser.add_argument("--out", help="a file for the simplified mesh, which meshio writes")
    arguments = parser.parse_args()

    mesh = tetstream.from_meshio(meshio.read(arguments.mesh))
    if not mesh.fields:
        parser.error(f"{arguments.mesh} has no field at its points")
    field = arguments.field or next(iter(mesh.fields))
    if field not in mesh.fields:
        parser.error(f"there is no field {field}; there are {', '.join(mesh.fields)}")
    small = mesh.simplify(ratio=arguments.ratio, weights={field: 1}, vertex_map=True)
    if arguments.out:
        small.to_meshio().write(arguments.out)

    before, after = (length(shown.fields[field]) for shown in (mesh, small))
    # The vertex map brings the simplified field back to where the original has its points.
    error = length(small.vertex_map.prolong(small.fields[field]) - mesh.fields[field])
    error = 100 * numpy.nan_to_num(error) / (numpy.ptp(before) or 1)
    # A few peaks are not to leave everything else in one colour.
    scale = cm.ScalarMappable(colors.Normalize(before.min(), numpy.percentile(before, 99)), PALE)
    errors = cm.ScalarMappable(colors.Normalize(0, max(numpy.percentile(error, 99), 1e-9)), "Reds")

    figure, panels = pyplot.subplots(1, 3, figsize=(19, 6.5), layout="constrained")
    turned = view(arguments.turn, arguments.tilt)
    draw(panels[0], mesh, before, turned, scale)
    draw(panels[1], small, after, turned, scale)
    draw(panels[2], mesh, error, turned, errors)
    for axes, shown, when in zip(panels, (mesh, small), ("before", "after")):
        axes.set_title(f"{when}: {len(shown.cells)} cells, {len(surface(shown))} on the surface")
    panels[2].set_title(f"what changed: {error.max():.2g} % at most, "
                        f"{numpy.sqrt((error ** 2).mean()):.2g} % RMS, at the points before")
    figure.colorbar(scale, ax=panels[:2], label=field, shrink=0.8, extend="max")
    figure.colorbar(errors, ax=panels[2], label="difference, % of the range", shrink=0.8,
                    extend="max")
    figure.savefig(arguments.picture, dpi=150)
    print(f"{arguments.picture}: {len(mesh.cells)} -> {len(small.cells)} cells, "
          f"estimated error {small.report.estimated_error:.2g} % of the range")


if __name__ == "__main__":
    main()
