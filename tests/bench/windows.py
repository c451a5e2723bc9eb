#!/usr/bin/python3
"""What a small window costs: the errors of `tetstream simplify` with windows of some fronts, each
divided by that of the same simplification in core (a window that holds all cells).

Rows, ratios and errors are those of compare.py; ratios are taken after raising both sides to
0.001 %. Where the window of so many fronts holds the whole mesh, the two runs are the same.
"""
import itertools
import os
import statistics
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "support")]
import compare  # noqa: E402
import harness  # noqa: E402

IN_CORE = "in core"
HEAD = ("mesh", "field", "ratio", "mode", "window", "window cells / cells", "got / asked", "RMS %",
        "max %", "Hausdorff %", "s", "CPU s", "peak MB", "RMS / in core", "max / in core",
        "Hausdorff / in core", "CPU / in core")


def arguments():
    parser = compare.judged_parser(__doc__)
    parser.add_argument("--fronts", nargs="+", type=float, default=[1, 2, 4, 8], metavar="N")
    parser.add_argument("--modes", nargs="+", default=["default"], metavar="MODE",
                        help="of simplify; default: the one that it has if none is named")
    return parser.parse_args()


class Windows:
    def __init__(self, args):
        self.args = args
        self.tetstream, _ = harness.bench_programs(args.build)
        self.judge = harness.Judge(args.samples)

    def result(self, path, field, ratio, mode, stream, window_cells):
        """What came of one window."""
        out = self.tetstream.path("out.tets")
        report = self.tetstream.simplify(stream, out, "--ratio", ratio, "--field", field,
                                         "--window", window_cells,
                                         *([] if mode == "default" else ["--mode", mode]),
                                         *self.args.options)
        taken = report["measured"]
        mesh = self.tetstream.convert(out, self.tetstream.path("out.vtu"))
        return {**compare.errors(self.judge(path, mesh, field)), "report": report,
                "cpu": taken["user"] + taken["system"]}

    def row(self, name, field):
        """The results of a row, those in core first."""
        path = harness.mesh_path(name)
        stream = self.tetstream.convert(path, self.tetstream.path("in.tets"))
        info = self.tetstream.info(stream)
        windows = {IN_CORE: info["cells"]}
        windows.update({f"{n:g}": compare.window_of(n, info) for n in self.args.fronts})
        for ratio, mode in itertools.product(self.args.ratios, self.args.modes):
            base = None
            for window, cells in windows.items():
                result = self.result(path, field, ratio, mode, stream, cells)
                base = base or result
                result["to_core"] = {**compare.quotients(result, base),
                                     "cpu": result["cpu"] / base["cpu"]}
                yield {"mesh": name, "field": field, "ratio": ratio, "mode": mode,
                       "window": window, **result}


def cells_of(r):
    report, taken = r["report"], r["report"]["measured"]
    return [r["mesh"], r["field"], f"{r['ratio']:g}", r["mode"], r["window"],
            f"{report['window_cells'] / report['cells_in']:.3f}",
            f"{report['cells_out'] / report['target_cells']:.4f}",
            *(f"{r[k]:.3g}" for k in compare.ERRORS), f"{taken['wall']:.3f}",
            f"{r['cpu']:.3f}", f"{harness.megabytes(taken['peak_bytes']):.1f}",
            *(f"{r['to_core'][k]:.2f}" for k in (*compare.ERRORS, "cpu"))]


def print_means(results):
    """One line per ratio, mode and window: the geometric means over the rows."""
    def of(r):
        return r["ratio"], r["mode"], r["window"]
    for ratio, mode, window in dict.fromkeys(map(of, results)):
        chosen = [r["to_core"] for r in results if of(r) == (ratio, mode, window)]
        means = [f"{statistics.geometric_mean([c[k] for c in chosen]):.3f}"
                 for k in (*compare.ERRORS, "cpu")]
        harness.print_row(["**geometric mean**", "", f"{ratio:g}", mode, window] + [""] * 8 + means)


def main():
    args = arguments()
    windows = Windows(args)
    harness.print_head(HEAD)
    results = []
    for name, field in args.rows:
        for result in windows.row(name, field):
            results.append(result)
            harness.print_row(cells_of(result))
    print_means(results)
    compare.save(args.json, results)


if __name__ == "__main__":
    main()
