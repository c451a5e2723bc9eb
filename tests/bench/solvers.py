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
more than ten edges), `worse` (than the better end): edges in percent. ns: per edge, quadric
to place and error. With --brief a line per case and place: excess 99 %, the edges that failed in
any of these three ways, and ns, for each solver and form.
"""
import itertools
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
    parser.add_argument("--brief", action="store_true", help="one line per case and place")
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


def brief(a):
    excess = f"{a['excess_99']:.1g}" if "excess_99" in a else "-"
    return f"{excess}, {a['failed']:.3g} %, {a['ns']:.0f}"


def chosen(args):
    """Of each case, place, type and number of merged vertices the answers that were asked for."""
    program = os.path.join(args.build, "tests", "bench", "solvers")
    if not os.path.isfile(program):
        harness.not_run(f"there is no {program}: was Eigen found at configure time?")
    for row in itertools.product(args.cases, args.places, args.types, args.merged):
        found = answers(program, case_path(row[0]), *row[1:], args.edges)
        yield row, [a for a in found if a["solver"] in (args.solvers or [a["solver"]])
                    and a["form"] in (args.forms or [a["form"]])]


def main():
    args = arguments()
    with_head = False
    for row, found in chosen(args):
        if not with_head:
            harness.print_head((*HEAD[:4], *(f"{a['solver']}, {a['form']}" for a in found))
                               if args.brief else HEAD)
            with_head = True
        if args.brief:
            harness.print_row([*row, *map(brief, found)])
            continue
        for a in found:
            harness.print_row([*row, *cells_of(a)])


if __name__ == "__main__":
    main()
