#!/usr/bin/env python3
"""Reads a mesh with meshio, simplifies it and draws its surface before and after:

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


def view(turn, tilt):
    """A rotation: rows are right, up and towards the eye."""
    t, p = numpy.radians([turn, tilt])
    right = numpy.array([-numpy.sin(t), numpy.cos(t), 0])
    eye = numpy.array([numpy.cos(p) * numpy.cos(t), numpy.cos(p) * numpy.sin(t), numpy.sin(p)])
    return numpy.stack([right, numpy.cross(eye, right), eye])


def draw(axes, mesh, values, turned, norm):
    """Draws what is seen of the surface, from the back to the front, in the field's colours."""
    faces = surface(mesh)
    corners = mesh.points[faces] @ turned.T
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)[:, None]
    seen = normals[:, 2] > 0
    order = numpy.argsort(corners[seen, :, 2].mean(axis=1))
    colour = cm.viridis(norm(values[faces].mean(axis=1)))[seen][order]
    colour[:, :3] *= 0.45 + 0.55 * normals[seen][order][:, 2:]
    axes.add_collection(collections.PolyCollection(corners[seen][order][..., :2], facecolors=colour,
                                                   edgecolors=(0, 0, 0, 0.5), linewidths=0.15))
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
    small = mesh.simplify(ratio=arguments.ratio, weights={field: 1})
    if arguments.out:
        small.to_meshio().write(arguments.out)

    figure, panels = pyplot.subplots(1, 2, figsize=(14, 6.5), layout="constrained")
    turned = view(arguments.turn, arguments.tilt)
    norm = None
    for axes, shown, when in zip(panels, (mesh, small), ("before", "after")):
        values = numpy.asarray(shown.fields[field], float)
        if values.ndim > 1:
            values = numpy.linalg.norm(values, axis=1)
        # A few peaks are not to leave everything else in one colour.
        norm = norm or colors.Normalize(values.min(), numpy.percentile(values, 99), clip=True)
        draw(axes, shown, values, turned, norm)
        axes.set_title(f"{when}: {len(shown.cells)} cells, {len(surface(shown))} on the surface")
    figure.colorbar(cm.ScalarMappable(norm, "viridis"), ax=panels, label=field, shrink=0.8,
                    extend="max")
    figure.savefig(arguments.picture, dpi=150)
    print(f"{arguments.picture}: {len(mesh.cells)} -> {len(small.cells)} cells, "
          f"estimated error {small.report.estimated_error:.2g} % of the range")


if __name__ == "__main__":
    main()
