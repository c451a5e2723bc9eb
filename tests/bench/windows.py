#!/usr/bin/python3
"""What a small window costs: the errors of `tetstream simplify` with windows of some fronts, each
divided by that of the same simplification in core (a window that holds all cells).

Rows, ratios and errors are those of compare.py; ratios are taken after raising both sides to
0.001 %. Where the window of so many fronts holds the whole mesh, the two runs are the same.
"""
import os
import statistics
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "support")]
import compare  # noqa: E402
import harness  # noqa: E402

IN_CORE = "in core"
HEAD = ("mesh", "field", "ratio", "window", "window cells / cells", "got / asked", "RMS %", "max %",
        "Hausdorff %", "s", "peak MB", "RMS / in core", "max / in core", "Hausdorff / in core")


def arguments():
    parser = compare.judged_parser(__doc__)
    parser.add_argument("--fronts", nargs="+", type=float, default=[1, 2, 4, 8], metavar="N")
    return parser.parse_args()


class Windows:
    def __init__(self, args):
        self.args = args
        self.tetstream, _ = harness.bench_programs(args.build)
        self.judge = harness.Judge(args.samples)

    def result(self, path, field, ratio, stream, window_cells):
        """What came of one window."""
        out = self.tetstream.path("out.tets")
        report = self.tetstream.simplify(stream, out, "--ratio", ratio, "--field", field,
                                         "--window", window_cells, *self.args.options)
        mesh = self.tetstream.convert(out, self.tetstream.path("out.vtu"))
        return {**compare.errors(self.judge(path, mesh, field)), "report": report}

    def row(self, name, field):
        """The results of a row, those in core first."""
        path = harness.mesh_path(name)
        stream = self.tetstream.convert(path, self.tetstream.path("in.tets"))
        info = self.tetstream.info(stream)
        windows = {IN_CORE: info["cells"]}
        windows.update({f"{n:g}": compare.window_of(n, info) for n in self.args.fronts})
        for ratio in self.args.ratios:
            base = None
            for window, cells in windows.items():
                result = self.result(path, field, ratio, stream, cells)
                base = base or result
                result["to_core"] = compare.quotients(result, base)
                yield {"mesh": name, "field": field, "ratio": ratio, "window": window, **result}


def cells_of(r):
    report, taken = r["report"], r["report"]["measured"]
    return [r["mesh"], r["field"], f"{r['ratio']:g}", r["window"],
            f"{report['window_cells'] / report['cells_in']:.3f}",
            f"{report['cells_out'] / report['target_cells']:.4f}",
            *(f"{r[k]:.3g}" for k in compare.ERRORS), f"{taken['wall']:.3f}",
            f"{harness.megabytes(taken['peak_bytes']):.1f}",
            *(f"{r['to_core'][k]:.2f}" for k in compare.ERRORS)]


def print_means(results):
    """One line per ratio and window: the geometric means over the rows."""
    for ratio, window in dict.fromkeys((r["ratio"], r["window"]) for r in results):
        chosen = [r["to_core"] for r in results if (r["ratio"], r["window"]) == (ratio, window)]
        means = [f"{statistics.geometric_mean([c[k] for c in chosen]):.3f}" for k in compare.ERRORS]
        harness.print_row(["**geometric mean**", "", f"{ratio:g}", window] + [""] * 7 + means)


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
