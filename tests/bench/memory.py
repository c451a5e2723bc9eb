#!/usr/bin/python3
"""Peak memory of `tetstream simplify` on streams that are made on the fly and never on disk.

Each line of the table is

    tetstream generate KIND --cells N - |
    tetstream simplify - OUT.tets --ratio R --field density ...

and shows the peak resident set of the simplifier as the system reports it (1 MB = 2^20 bytes), its
wall time while both processes run, and whether the target was reached; missing it, or more than
--limit, makes the exit code 1. The first line, of a mesh
of some dozens of cells, is what the program takes anyway.

With --slope: what a cell of the window takes. Streams that the program `stream` of this folder
makes are simplified with the smaller and the larger of --windows; the slope is the difference of
the peaks over that of the windows. The larger one is filled --fills times.
"""
import math
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

HEAD = ("kind", "cells", "options", "peak MB", "bytes / front cell", "cells out", "target",
        "s", "CPU s", "M cells/s", "front cells", "window cells")

# What the window holds: type of the numbers, fields in the stream, fields measured.
SLOPES = (("float32, 1 component", "float32", ("density",), ("density",)),
          ("float32, 1 component and 3 carried", "float32", ("density", "velocity"), ("density",)),
          ("float32, 4 components", "float32", ("density", "velocity"), ("density", "velocity")),
          ("float64, 1 component", "float64", ("density",), ("density",)),
          ("float64, 4 components", "float64", ("density", "velocity"), ("density", "velocity")))
SLOPE_HEAD = ("stream", "cells", "front cells", "window cells", "peak MB", "bytes / cell of window",
              "bytes / cell of its arrays", "s")


def arguments():
    parser = harness.bench_parser(__doc__)
    parser.add_argument("--kinds", nargs="+", default=["fluid"], metavar="KIND")
    parser.add_argument("--cells", nargs="+", type=float, default=[2e6, 2e7], metavar="N")
    parser.add_argument("--slope", action="store_true", help="between two windows")
    parser.add_argument("--windows", nargs=2, type=float, default=[5e5, 2e6], metavar="CELLS")
    parser.add_argument("--fills", type=float, default=3, help="cells over the larger window")
    parser.add_argument("--ratio", type=float, default=0.1)
    parser.add_argument("--window", type=int, metavar="CELLS", help="the same for all sizes")
    parser.add_argument("--compress", choices=("yes", "no"), default="yes", help="OUT.tets")
    parser.add_argument("--limit", type=float, metavar="MB", help="more than this is a failure")
    return parser.parse_args()


def piped(tetstream, generator, words):
    """The report of a simplification that reads from a generator through a pipe."""
    with subprocess.Popen(generator, stdout=subprocess.PIPE) as source:
        report = tetstream.simplify("-", tetstream.path("out.tets"), *words, stdin=source.stdout)
        source.stdout.close()
    if source.returncode != 0:
        sys.exit(f"{' '.join(generator)} ended with {source.returncode}")
    return report


# ------------------------------------------------------------------------- bytes per cell
def cells_of(name, report, before):
    """The cells of a line; `before` is the report with the smaller window, or None."""
    peak, account, window = (report["measured"]["peak_bytes"], report["peak_window_bytes"],
                             report["window_cells"])
    slopes = ["", ""]
    if before:
        more = window - before["window_cells"]
        slopes = [f"{(peak - before['measured']['peak_bytes']) / more:.1f}",
                  f"{(account - before['peak_window_bytes']) / more:.1f}"]
    return [name, report["cells_in"], report["front_cells"], window,
            f"{harness.megabytes(peak):.1f}", *slopes, f"{report['measured']['wall']:.1f}"]


def print_slopes(args, tetstream):
    cells = int(args.fills * max(args.windows))
    harness.print_head(SLOPE_HEAD)
    for kind in args.kinds:
        for name, scalar, carried, measured in SLOPES:
            generator = [harness.bench_path(args.build, "stream"), kind, str(cells), scalar,
                         *carried]
            words = [word for field in measured for word in ("--field", field)]
            before = None
            for window in sorted(args.windows):
                report = piped(tetstream, generator,
                               ["--ratio", args.ratio, *words, "--window", int(window),
                                "--compress", args.compress, *args.options])
                harness.print_row(cells_of(f"{kind}, {name}", report, before))
                before = report
    return 0


# ------------------------------------------------------------------------- peak by size
def main():
    args = arguments()
    tetstream, _ = harness.bench_programs(args.build)
    if args.slope:
        return print_slopes(args, tetstream)
    words = ["--ratio", args.ratio, "--field", "density", "--compress", args.compress]
    words += args.options
    if args.window:
        words += ["--window", args.window]
    failures = 0
    harness.print_head(HEAD)
    for kind in args.kinds:
        for cells in [50, *args.cells]:
            generator = [tetstream.program, "generate", kind, "--cells", str(int(cells)), "-"]
            report = piped(tetstream, generator, words)
            taken = report["measured"]
            missed = report["cells_out"] > report["target_cells"]
            line = [kind, report["cells_in"], " ".join(map(str, words[4:])) or "-",
                    f"{harness.megabytes(taken['peak_bytes']):.1f}",
                    f"{taken['peak_bytes'] / max(report['front_cells'], 1):.0f}",
                    report["cells_out"], "MISSED" if missed else "reached", f"{taken['wall']:.2f}",
                    f"{taken['user'] + taken['system']:.2f}",
                    f"{report['cells_in'] / taken['wall'] / 1e6:.3f}", report["front_cells"],
                    report["window_cells"]]
            harness.print_row(line)
            failures += missed or taken["peak_bytes"] > (args.limit or math.inf) * 2 ** 20
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
