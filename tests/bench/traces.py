#!/usr/bin/python3
"""What a vertex map and a log of collapses cost: processor time and peak memory of `tetstream
simplify` with --map, and with --collapse-log, against the same run without, in turn; .tets to .tets,
binary files. "points": vertices of the input, which is as many rows as the map has.
"""
import os
import statistics
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "support")]
import harness  # noqa: E402

HEAD = ("mesh", "ratio", "points", "CPU s", "CPU s map", "CPU s log", "map / none", "log / none",
        "peak MB", "peak MB map", "peak MB log", "window MB", "window MB map")
MESHES = ("chaste_twin_flow:Pressure", "isabel:velocityMag", "colin27_brain:")


def arguments():
    parser = harness.bench_parser(__doc__)
    parser.add_argument("--meshes", nargs="+", default=MESHES, metavar="MESH:FIELD")
    parser.add_argument("--ratios", nargs="+", type=float, default=[0.5, 0.1, 0.02], metavar="R")
    parser.add_argument("--rounds", type=int, default=5)
    return parser.parse_args()


def main():
    args = arguments()
    tetstream, _ = harness.bench_programs(args.build)
    path = tetstream.path
    kinds = {"none": (), "map": ("--map", path("out.tetmap")),
             "log": ("--collapse-log", path("out.tetlog"))}
    harness.print_head(HEAD)
    for word in args.meshes:
        name, field = harness.mesh_and_field(word)
        stream = tetstream.convert(harness.mesh_path(name), path("in.tets"))
        words = ["--regions", "none", *args.options]
        if field:
            words += ["--field", field]
        for ratio in args.ratios:
            runs = {kind: [] for kind in kinds}
            for _ in range(args.rounds):
                for kind, more in kinds.items():
                    runs[kind].append(tetstream.simplify(stream, path("out.tets"), "--ratio", ratio,
                                                         *words, *more))
            cpu = {kind: statistics.median(r["measured"]["user"] + r["measured"]["system"]
                                           for r in taken) for kind, taken in runs.items()}
            peak = {kind: harness.megabytes(max(r["measured"]["peak_bytes"] for r in taken))
                    for kind, taken in runs.items()}
            window = {kind: harness.megabytes(taken[0]["peak_window_bytes"])
                      for kind, taken in runs.items()}
            harness.print_row((
                name, f"{ratio:g}", runs["none"][0]["vertices_in"],
                *(f"{cpu[kind]:.3f}" for kind in kinds),
                f"{cpu['map'] / cpu['none']:.2f}", f"{cpu['log'] / cpu['none']:.2f}",
                *(f"{peak[kind]:.1f}" for kind in kinds),
                f"{window['none']:.2f}", f"{window['map']:.2f}"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
