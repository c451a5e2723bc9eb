#!/usr/bin/python3
"""orders.py --tetstream PROGRAM --mesh NAME

Lays a real mesh out in every order. Each time every one of these must hold:
  same mesh   the points that cells use, with their values, and the cells, as an independent reader
              sees them in the file before and after
  stream      the front that `layout` tells is the one that `info` finds in the file
  narrow      spectral is not wider than 1.15 times the narrowest other order; auto not than 1.1
              times the narrowest of all; the span of breadth-first at most 1.5 times its width
"""
import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

ORDERS = ("none", "spatial", "brick", "z-order", "hilbert", "breadth-first", "spectral", "auto")


def canonical(np, mesh):
    """The used points, with their values, in an order of their own, and the cells by them."""
    columns = [mesh.P] + [v.reshape(len(mesh.P), -1) for _, v in sorted(mesh.fields.items())]
    rows = np.ascontiguousarray(np.hstack([np.asarray(c, dtype=float) for c in columns]))
    used = np.zeros(len(rows), dtype=bool)
    used[mesh.T.ravel()] = True
    points, place = np.unique(rows[used], axis=0, return_inverse=True)
    number = np.full(len(rows), -1)
    number[used] = place
    cells = np.sort(number[mesh.T], axis=1)
    counts = np.bincount(place)
    return points, counts, cells[np.lexsort(cells.T[::-1])]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tetstream", required=True, metavar="PROGRAM")
    parser.add_argument("--mesh", required=True, metavar="NAME")
    args = parser.parse_args()
    judge = harness.Judge(1)
    np = judge.module.np
    tetstream = harness.Tetstream(args.tetstream)
    path = harness.mesh_path(args.mesh)
    before = canonical(np, judge.module.load(path))
    width, failures = {}, []

    def expect(holds, sentence):
        if not holds:
            print("FAILED:", sentence)
            failures.append(sentence)

    for order in ORDERS:
        out = tetstream.path("out.tets")
        told = tetstream.layout(path, out, "--order", order)
        print(args.mesh, order, told["order"], told["front_width"], told["front_span"], flush=True)
        found = tetstream.info(out)
        for figure in ("front_width", "front_span", "front_cells", "cells", "vertices"):
            expect(told[figure] == found[figure], f"{order}: {figure} is told as it is")
        tetstream.run("convert", out, tetstream.path("out.vtu"), "--order", "none", "--quiet")
        after = canonical(np, judge.module.load(tetstream.path("out.vtu")))
        same = all(np.array_equal(a, b) for a, b in zip(before, after))
        expect(same, f"{order}: the same mesh")
        width[order] = told["front_width"]
        if order == "breadth-first":
            expect(told["front_span"] <= 1.5 * width[order], "breadth-first: a short span")
    others = [w for order, w in width.items() if order not in ("spectral", "auto")]
    expect(width["spectral"] <= 1.15 * min(others), f"spectral: a narrow front: {width}")
    expect(width["auto"] <= 1.1 * min(width.values()), f"auto: a narrow front: {width}")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
