#!/usr/bin/python3
"""How well, and how fast, the minimum of an edge is found: conjugate gradients (the paper's), LDLt
with a ridge (the default mode's), Cholesky, QR and SVD, on quadrics kept about their minimum,
(A, p, e), and about the origin, (A, b, c). The yardstick has about 34 digits.

Cases: smooth, homogeneous, linear, one-dimensional (synthetic), thin (smooth on cells flat at
1:1000), and MESH:FIELD, real ones. Places: OFFSET,UNIT,KIND; OFFSET in extents of the mesh; KIND
normalised (in units of a mean edge, as the library has it) or plain (coordinates as they are).

`off`: how far the place is from the nearest minimizer, in lengths of the edge. `excess`: how far
the error there is above the least, and `told`: how far from it the error is that the solver tells,
both in units of the error at the better end of the edge, but at least in what the type cannot tell
from 0. 50 %, 99 %: shares of the edges that are not above. `not finite`, `far` (from the middle by
more than ten edges), `worse` (than the better end): edges in percent. ns: per edge, quadric to
place and error.
"""
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "support"))
import harness  # noqa: E402

HEAD = ("case", "place", "type", "merged", "solver", "form", "edges", "off 50 %", "off 99 %",
        "excess 50 %", "excess 99 %", "told 99 %", "not finite %", "far %", "worse %", "ns")
SYNTHETIC = ["smooth", "homogeneous", "linear", "one-dimensional", "thin"]


def arguments():
    parser = harness.bench_parser(__doc__)
    parser.add_argument("--cases", nargs="+", default=SYNTHETIC, metavar="CASE")
    parser.add_argument("--places", nargs="+", default=["0,1,normalised"], metavar="PLACE")
    parser.add_argument("--types", nargs="+", default=["float32", "float64"],
                        choices=["float32", "float64"])
    parser.add_argument("--merged", nargs="+", type=int, default=[1], metavar="N",
                        help="vertices that each end of an edge stands for")
    parser.add_argument("--solvers", nargs="+", metavar="NAME", help="those only")
    parser.add_argument("--forms", nargs="+", metavar="FORM", help="those only: 'A p e', 'A b c'")
    parser.add_argument("--edges", type=int, default=1000)
    return parser.parse_args()


def case_path(case):
    """A synthetic case by its name, a real one by its path and field."""
    if ":" not in case:
        return case
    mesh, field = harness.mesh_and_field(case)
    return f"{harness.mesh_path(mesh)}:{field}"


def answers(program, *words):
    done = subprocess.run([program, *map(str, words)], stdout=subprocess.PIPE, text=True,
                          check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def cells_of(a):
    yield from (a["solver"], a["form"], a["edges"])
    for key in ("off_50", "off_99", "excess_50", "excess_99", "told_99"):
        yield f"{a[key]:.2g}" if key in a else "-"
    yield from (f"{a[key]:.3g}" for key in ("not_finite", "far", "worse"))
    yield f"{a['ns']:.0f}"


def main():
    args = arguments()
    program = os.path.join(args.build, "tests", "bench", "solvers")
    if not os.path.isfile(program):
        harness.not_run(f"there is no {program}: was Eigen found at configure time?")
    harness.print_head(HEAD)
    for case in args.cases:
        for place in args.places:
            for kind in args.types:
                for merged in args.merged:
                    for a in answers(program, case_path(case), place, kind, merged, args.edges):
                        if args.solvers and a["solver"] not in args.solvers:
                            continue
                        if args.forms and a["form"] not in args.forms:
                            continue
                        harness.print_row([case, place, kind, merged, *cells_of(a)])


if __name__ == "__main__":
    main()
