#!/usr/bin/env python3
"""Simplifies a mesh and draws a cut through it before and after:

    before_after.py bracket.vtu bracket.png --field von_mises --ratio 0.1

Each polygon is a cell that the plane cuts, in the colour of the field there. Needs numpy, matplotlib
and tetstream.
"""
import argparse

import matplotlib

matplotlib.use("Agg")  # into a file, without a screen

import numpy  # noqa: E402
from matplotlib import cm, collections, colors, pyplot  # noqa: E402

import tetstream  # noqa: E402

AXES = "xyz"

# viridis without its darkest part, on which edges would not be seen.
PALE = colors.ListedColormap(cm.viridis(numpy.linspace(0.25, 1, 256)))


def cut(mesh, values, axis, place):
    """Polygons [k][corners][2] of the plane through the cells, and the value of each."""
    height = mesh.points[:, axis] - place
    above = (height > 0)[mesh.cells]
    # Corners of each cell, those below the plane first.
    corners = numpy.take_along_axis(mesh.cells, numpy.argsort(above, axis=1), axis=1)
    plane = [i for i in range(3) if i != axis]
    polygons, colours = [], []
    # The edges that are cut, in the order in which a polygon has them, by the number above.
    for count, edges in ((1, ((3, 0), (3, 1), (3, 2))), (2, ((2, 0), (3, 0), (3, 1), (2, 1))),
                         (3, ((0, 1), (0, 2), (0, 3)))):
        chosen = corners[above.sum(axis=1) == count]
        ends = chosen[:, numpy.array(edges)]
        share = height[ends[..., 0]] / (height[ends[..., 0]] - height[ends[..., 1]])

        def there(rows):
            weight = share.reshape(share.shape + (1,) * (rows.ndim - 1))
            return (1 - weight) * rows[ends[..., 0]] + weight * rows[ends[..., 1]]

        polygons += list(there(mesh.points[:, plane]))
        colours.append(there(values).mean(axis=1))
    return polygons, numpy.concatenate(colours)


def middle(mesh, axis):
    """Where the plane of a normal is."""
    return (mesh.points[:, axis].min() + mesh.points[:, axis].max()) / 2


def area(polygons):
    """Of all polygons together."""
    return sum(abs(p[:, 0] @ numpy.roll(p[:, 1], 1) - p[:, 1] @ numpy.roll(p[:, 0], 1)) / 2
               for p in polygons)


def length(values):
    """Of vectors and tensors the norm, of scalars themselves."""
    values = numpy.asarray(values, float)
    return values if values.ndim == 1 else numpy.linalg.norm(values.reshape(len(values), -1), axis=1)


def draw(axes, mesh, field, axis, place, limits=None):
    """Draws the cut; `limits` of the colours, or None: those of the values that are seen."""
    polygons, colours = cut(mesh, length(mesh.fields[field]), axis, place)
    drawn = collections.PolyCollection(polygons, array=colours, cmap=PALE, edgecolors="black",
                                       linewidths=0.15)
    drawn.set_clim(*(limits or (colours.min(), colours.max())))
    axes.add_collection(drawn)
    axes.autoscale()
    axes.set_aspect("equal")
    axes.set_xlabel(AXES.replace(AXES[axis], "")[0])
    axes.set_ylabel(AXES.replace(AXES[axis], "")[1])
    return drawn


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", help="a file that tetstream reads")
    parser.add_argument("picture", help="a PNG, SVG or PDF")
    parser.add_argument("--field", help="the field that is kept and drawn; the first one")
    parser.add_argument("--ratio", type=float, default=0.1, help="cells out / cells in")
    parser.add_argument("--axis", choices=AXES,
                        help="the normal of the plane; that of the largest cut")
    arguments = parser.parse_args()

    mesh = tetstream.read(arguments.mesh)
    if not mesh.fields:
        parser.error(f"{arguments.mesh} has no field at its points")
    field = arguments.field or next(iter(mesh.fields))
    if field not in mesh.fields:
        parser.error(f"there is no field {field}; there are {', '.join(mesh.fields)}")
    small = mesh.simplify(ratio=arguments.ratio, weights={field: 1})
    error = tetstream.compare(mesh, small, weights={field: 1}).fields[field]

    values = length(mesh.fields[field])
    axes = [AXES.index(arguments.axis)] if arguments.axis else range(3)
    cuts = {i: cut(mesh, values, i, middle(mesh, i))[0] for i in axes}
    axis = max(axes, key=lambda i: area(cuts[i]))
    place = middle(mesh, axis)
    if not cuts[axis]:
        parser.error(f"the plane {AXES[axis]} = {place:g} cuts no cell")
    # What is wide comes one above the other.
    width, height = numpy.ptp(numpy.concatenate(cuts[axis]), axis=0)
    is_wide = width > 2 * height
    shape, size = ((2, 1), (11, 2.5 + 18 * height / width)) if is_wide else (
        (1, 2), (13, min(1.5 + 5.5 * height / width, 10)))
    figure, panels = pyplot.subplots(*shape, figsize=size, layout="constrained")
    drawn = draw(panels[0], mesh, field, axis, place)
    draw(panels[1], small, field, axis, place, drawn.get_clim())
    panels[0].set_title(f"before: {len(mesh.cells)} cells")
    panels[1].set_title(f"after: {len(small.cells)} cells, RMS error {error.rms_percent:.2g} % "
                        "of the range")
    figure.colorbar(drawn, ax=panels, label=field, shrink=0.8)
    figure.savefig(arguments.picture, dpi=150)
    print(f"{arguments.picture}: {len(mesh.cells)} -> {len(small.cells)} cells, "
          f"RMS error {error.rms_percent:.3g} %")


if __name__ == "__main__":
    main()
