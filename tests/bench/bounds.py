#!/usr/bin/python3
"""How well the error of the fields is known that `tetstream simplify` tells, and that `--error`
bounds: beside the RMS error that `tetstream compare` finds over the volume, of all measured fields
together. For each mesh a line for each ratio and each bound.
"""
import json
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "support"))
import harness  # noqa: E402

HEAD = ("mesh", "field", "asked", "cells kept %", "told %", "RMS %", "told / RMS", "CPU s")
FIELDS = [(name, "") for name in ("bluntfin", "bracket", "cylflow", "mmg_tinyBoxt")]


def arguments():
    parser = harness.bench_parser(__doc__)
    parser.add_argument("--rows", nargs="+", type=harness.mesh_and_field,
                        default=[*harness.ROWS, *FIELDS], metavar="MESH:FIELD",
                        help="MESH is a name in TETSTREAM_MESHES or a path; without FIELD all")
    parser.add_argument("--ratios", nargs="*", type=float, default=[0.5, 0.1, 0.02], metavar="R")
    parser.add_argument("--errors", nargs="*", type=float, default=[0.1, 0.5], metavar="E")
    parser.add_argument("--samples", type=int, default=50000, help="of compare; 0: exact")
    return parser.parse_args()


def found(tetstream, original, simplified, chosen, samples):
    """RMS error of the fields in percent of their range, all together."""
    text, _ = tetstream.run("compare", original, simplified, "--samples", samples, "--json",
                            "--quiet", *chosen)
    return math.sqrt(sum(field["rms_percent"] ** 2 for field in json.loads(text)["fields"]))


def main():
    args = arguments()
    tetstream, _ = harness.bench_programs(args.build)
    out = tetstream.path("out.tets")
    harness.print_head(HEAD)
    for name, field in args.rows:
        stream = tetstream.convert(harness.mesh_path(name), tetstream.path("in.tets"))
        chosen = ("--field", field) if field else ()
        for flag, value in [("--ratio", r) for r in args.ratios] + [("--error", e)
                                                                    for e in args.errors]:
            report = tetstream.simplify(stream, out, flag, value, *chosen, *args.options)
            told, rms = report["estimated_error"], found(tetstream, stream, out, chosen,
                                                         args.samples)
            taken = report["measured"]
            harness.print_row((os.path.basename(name), field or "all", f"{flag} {value:g}",
                               f"{100 * report['cells_out'] / report['cells_in']:.3g}",
                               f"{told:.3g}", f"{rms:.3g}", f"{told / max(rms, 1e-9):.2f}",
                               f"{taken['user'] + taken['system']:.2f}"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
