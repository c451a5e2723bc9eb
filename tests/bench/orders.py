#!/usr/bin/python3
"""The orders that a mesh can be laid out in: the front that each gives, what it takes, and what a
simplification makes of it (the paper's Table 1, and what follows from it).

For every mesh and order: width and span of the front in vertices, its cells; time, peak memory and
temporary disk of `tetstream layout`; then `tetstream simplify` of its stream with a window of four
fronts: RMS error as the run estimates it, in percent of the range of the fields measured, and cells
per second.
"""
import argparse
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "support")]
import harness  # noqa: E402

ORDERS = ("none", "spatial", "brick", "z-order", "hilbert", "breadth-first", "spectral", "auto")
HEAD = ("mesh", "cells", "order", "width", "span", "front cells", "s", "peak MB", "disk MB",
        "simplified: RMS %", "M cells/s", "chosen")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/release")
    parser.add_argument("--mesh", nargs="+", metavar="MESH[:FIELD]",
                        help="names in TETSTREAM_MESHES or paths (default: all that are there)")
    parser.add_argument("--orders", nargs="+", default=ORDERS, choices=ORDERS)
    parser.add_argument("--memory", default="512M")
    parser.add_argument("--ratio", type=float, default=0.1)
    return parser.parse_args()


def all_meshes():
    names = sorted(os.listdir(harness.folder("TETSTREAM_MESHES")))
    fields = dict(reversed(harness.ROWS))  # the first of several
    meshes = [name[:-4] for name in names if name.endswith(".vtu")]
    return [f"{name}:{fields[name]}" if name in fields else name for name in meshes]


def row(tetstream, mesh, order, args):
    name, _, field = mesh.partition(":")
    out = tetstream.path("laid.tets")
    laid = tetstream.layout(harness.mesh_path(name), out, "--order", order, "--memory",
                            args.memory)
    words = ["--field", field] if field else []
    small = tetstream.simplify(out, tetstream.path("small.tets"), "--ratio", args.ratio,
                               "--window", 4 * laid["front_cells"], *words)
    taken, after = laid["measured"], small["measured"]
    return [name, str(laid["cells"]), order, str(laid["front_width"]), str(laid["front_span"]),
            str(laid["front_cells"]), f"{taken['wall']:.2f}",
            f"{harness.megabytes(taken['peak_bytes']):.0f}",
            f"{harness.megabytes(laid['temporary_bytes']):.0f}",
            f"{small['estimated_error']:.3g}" if field else "-",
            f"{small['cells_in'] / after['wall'] / 1e6:.2f}", laid["order"]]


def main():
    args = arguments()
    tetstream, _ = harness.bench_programs(args.build)
    harness.print_head(HEAD)
    for mesh in args.mesh or all_meshes():
        for order in args.orders:
            harness.print_row(row(tetstream, mesh, order, args))


if __name__ == "__main__":
    main()
