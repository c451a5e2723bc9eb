#!/usr/bin/python3
"""Peak memory of `tetstream simplify` on streams that are made on the fly and never on disk.

Each line of the table is

    tetstream generate KIND --cells N - |
    tetstream simplify - OUT.tets --ratio R --field density ...

and shows the peak resident set of the simplifier as the system reports it (1 MB = 2^20 bytes), its
wall time while both processes run, and whether the target was reached; missing it, or more than
--limit, makes the exit code 1. The first line, of a mesh
of some dozens of cells, is what the program takes anyway.
"""
import argparse
import math
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

HEAD = ("kind", "cells", "options", "peak MB", "bytes / front cell", "cells out", "target",
        "s", "CPU s", "M cells/s", "front cells", "window cells")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/release", help="the folder of the build")
    parser.add_argument("--kinds", nargs="+", default=["fluid"], metavar="KIND")
    parser.add_argument("--cells", nargs="+", type=float, default=[2e6, 2e7], metavar="N")
    parser.add_argument("--ratio", type=float, default=0.1)
    parser.add_argument("--window", type=int, metavar="CELLS", help="the same for all sizes")
    parser.add_argument("--compress", choices=("yes", "no"), default="yes", help="OUT.tets")
    parser.add_argument("--limit", type=float, metavar="MB", help="more than this is a failure")
    parser.add_argument("options", nargs="*", metavar="-- OPTION", help="more words for simplify")
    return parser.parse_args()


def piped(tetstream, kind, cells, words):
    """The report of a simplification that reads from a generator through a pipe."""
    with subprocess.Popen([tetstream.program, "generate", kind, "--cells", str(int(cells)), "-"],
                          stdout=subprocess.PIPE) as source:
        report = tetstream.simplify("-", tetstream.path("out.tets"), *words, stdin=source.stdout)
        source.stdout.close()
    if source.returncode != 0:
        sys.exit(f"generate {kind} ended with {source.returncode}")
    return report


def main():
    args = arguments()
    tetstream, _ = harness.bench_programs(args.build)
    words = ["--ratio", args.ratio, "--field", "density", "--compress", args.compress]
    words += args.options
    if args.window:
        words += ["--window", args.window]
    failures = 0
    harness.print_head(HEAD)
    for kind in args.kinds:
        for cells in [50, *args.cells]:
            report = piped(tetstream, kind, cells, words)
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
