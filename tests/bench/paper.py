#!/usr/bin/python3
"""Repeats comparisons of Vo et al. 2007, one table each:

  choice    random edges against a priority queue against the sweep, in core (their Table 2)
  locked    fields that are constant in large parts, with and without the shape regulariser
  release   cells written in the order of the input against those of the largest error first
  quadric   the field's error against the distance to the cells' hyperplanes (Garland and Zhou)
  spending  the same ratio all along the stream against one threshold for all of it

Rows, ratios and errors are those of compare.py. Where several seeds are run, what is shown are
means. Columns `/ first`: divided by the first line of the same mesh and ratio, errors after raising
both to 0.001 %. CPU s: processor time of the whole process, .tets file to .tets file, smallest of
--rounds runs, all variants in turn.
"""
import os
import statistics
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "support")]
import compare  # noqa: E402
import harness  # noqa: E402
import homogeneous  # noqa: E402
import islands  # noqa: E402

IN_CORE = "in core"


class Variant:
    """Words for the command or, with `switches`, for the program `switched`; one run per seed."""

    def __init__(self, name, words, seeds=(1,), switches=None, fronts=None):
        self.name, self.words, self.seeds = name, list(map(str, words)), seeds
        self.switches, self.fronts = switches, fronts


class Runner:
    """Runs variants of a simplification in turn, and has them judged."""

    def __init__(self, args):
        self.args = args
        self.tetstream, _ = harness.bench_programs(args.build)
        measured = harness.bench_path(args.build, "measured")
        self.switched = harness.Switched(harness.bench_path(args.build, "switched"), measured)
        self.judge = harness.Judge(args.samples)

    def rows(self, with_regions=False):
        """Mesh, field, path of the mesh, path of its stream, what `info` says."""
        for name, field in self.args.rows:
            yield self.row(name, field, harness.mesh_path(name))
        for kind in self.args.generated:
            stream = self.tetstream.path("generated.tets")
            self.tetstream.run("generate", kind, "--cells", int(self.args.cells), stream, "--quiet")
            path = self.tetstream.convert(stream, self.tetstream.path(kind + ".vtu"))
            if not with_regions:
                yield self.row(kind, "density", path)
                continue
            for field in homogeneous.add_to(path):
                yield self.row(kind, field, path)

    def row(self, name, field, path):
        stream = self.tetstream.convert(path, self.tetstream.path("in.tets"))
        return name, field, path, stream, self.tetstream.info(stream)

    def window(self, variant, info):
        fronts = variant.fronts or self.args.fronts
        return info["cells"] if fronts == IN_CORE else compare.window_of(fronts, info)

    def run(self, variant, seed, row, ratio, out):
        _, field, _, stream, info = row
        words = ["--ratio", ratio, "--field", field, "--window", self.window(variant, info),
                 "--seed", seed, *variant.words]
        if variant.switches is None:
            return self.tetstream.simplify(stream, out, *words, *self.args.options)
        return self.switched.simplify(stream, out, *words, *variant.switches)

    def results(self, variants, row, ratio):
        """One per variant, means over its seeds."""
        runs = {}
        for turn in range(self.args.rounds):
            for variant in variants:
                for seed in variant.seeds:
                    out = self.tetstream.path(f"out-{seed}-{variants.index(variant)}.tets")
                    report = self.run(variant, seed, row, ratio, out)
                    taken = report["measured"]
                    run = runs.setdefault((variant, seed), {**report, "out": out, "cpu": []})
                    run["cpu"].append(taken["user"] + taken["system"])
                    run["peak"] = taken["peak_bytes"]
        return [self.mean([self.judged(runs[variant, seed], row) for seed in variant.seeds],
                          variant) for variant in variants]

    def judged(self, run, row):
        mesh = self.tetstream.convert(run["out"], self.tetstream.path("out.vtu"))
        verdict = self.judge(row[2], mesh, row[1])
        refused = run["rejected_orientation"] + run["rejected_link"] + run["rejected_other"]
        return {**compare.errors(verdict), "cpu": min(run["cpu"]), "refused": refused,
                "refused_each": refused / max(run["collapses"], 1),
                "got": run["cells_out"] / run["target_cells"], "peak": run["peak"],
                "valid": verdict["valid"] and verdict["reduction"]["topology_kept"],
                "out": run["out"]}

    @staticmethod
    def mean(runs, variant):
        numbers = [key for key, value in runs[0].items() if isinstance(value, (int, float))]
        return {"variant": variant, **runs[0],
                **{key: statistics.fmean(run[key] for run in runs) for key in numbers},
                "valid": all(run["valid"] for run in runs)}


# ---------------------------------------------------------------------------------- the columns
def shown(r, first):
    """The cells that all tables have, from the errors on."""
    to_first = compare.quotients(r, first)
    yield f"{r['got']:.4f}"
    yield from (f"{r[key]:.3g}" for key in compare.ERRORS)
    yield from (f"{r['cpu']:.3f}", f"{r['refused_each']:.2f}", "yes" if r["valid"] else "NO")
    yield from (f"{to_first[key]:.2f}" for key in compare.ERRORS)
    yield f"{r['cpu'] / first['cpu']:.2f}"


COMMON = ("mesh", "field", "ratio", "variant")
ERRORS_AND_TIME = ("got / asked", "RMS %", "max %", "Hausdorff %", "CPU s", "refused / collapse",
                   "valid", "RMS / first", "max / first", "Hausdorff / first", "CPU / first")


def print_means(ratio, variant, results):
    """Geometric means of the quotients over the rows."""
    means = [f"{statistics.geometric_mean(values):.3f}" for values in zip(*results)]
    harness.print_row(["**geometric mean**", "", f"{ratio:g}", variant.name] + [""] * 7 + means)


def print_table(runner, variants, head, more=lambda result, row: ()):
    """`more` are the cells of the columns named in `head`, after all others."""
    harness.print_head((*COMMON, *ERRORS_AND_TIME, *head))
    kept = {}
    for row in runner.rows():
        for ratio in runner.args.ratios:
            results = runner.results(variants, row, ratio)
            first = results[0]
            for r in results:
                harness.print_row([row[0], row[1], f"{ratio:g}", r["variant"].name,
                                   *shown(r, first), *more(r, row)])
                quotients = compare.quotients(r, first)
                kept.setdefault((ratio, r["variant"]), []).append(
                    [*(quotients[key] for key in compare.ERRORS), r["cpu"] / first["cpu"]])
    for (ratio, variant), values in kept.items():
        print_means(ratio, variant, values)


# ------------------------------------------------------------------------------ the experiments
def choice(runner):
    """Random edges against a priority queue against the sweep."""
    variants = [Variant("queue", ["--mode", "queue"])]
    variants += [Variant(f"random, best of {n}", ["--mode", "paper", "--candidates", n],
                         range(1, runner.args.seeds + 1)) for n in runner.args.candidates]
    variants.append(Variant("sweep", ["--mode", "sweep"]))
    print_table(runner, variants, ("peak MB",),
                lambda r, _: (f"{harness.megabytes(r['peak']):.1f}",))


def locked(runner):
    """How far a run gets where large parts are constant, and what it refuses."""
    modes = {"queue, each edge once": ["--mode", "queue", "--no-retries"],
             "queue": ["--mode", "queue"], "random": ["--mode", "paper"],
             "sweep": ["--mode", "sweep"]}
    variants = [Variant(f"{name}, weight {weight}", [],
                        switches=[*words, "--shape-weight", weight, "--no-last-resort"])
                for name, words in modes.items() for weight in ("0", "1e-6", "1e-4")]
    harness.print_head(("mesh", "field", "ratio", "variant", "got / asked", "refused",
                        "refused / collapse", "RMS %", "max %", "Hausdorff %", "CPU s", "valid"))
    for row in runner.rows(with_regions=True):
        for ratio in runner.args.ratios:
            for r in runner.results(variants, row, ratio):
                harness.print_row([row[0], row[1], f"{ratio:g}", r["variant"].name,
                                   f"{r['got']:.3f}", f"{r['refused']:.0f}",
                                   f"{r['refused_each']:.2f}",
                                   *(f"{r[key]:.3g}" for key in compare.ERRORS),
                                   f"{r['cpu']:.3f}", "yes" if r["valid"] else "NO"])


def release(runner):
    """In the order of the input, and the largest error first."""
    variants = [Variant(f"{mode}, {order}", ["--mode", mode, "--release", order])
                for mode in ("paper", "sweep") for order in ("order", "error")]

    def more(r, row):
        info = runner.tetstream.info(r["out"])
        left = islands.of(runner.tetstream.convert(r["out"], runner.tetstream.path("out.sva")))
        return (info["front_width"], info["front_span"], f"{info['mean_width']:.0f}",
                f"{row[4]['front_width']}, {row[4]['front_span']}", left["most"],
                f"{left['most_cells_percent']:.3g}")
    print_table(runner, variants, ("front width", "span", "mean width", "input's width, span",
                                   "islands", "cells in them %"), more)


def quadric(runner):
    """The field's error and the distance in space and field."""
    print_table(runner, [Variant(f"{mode}, {form}", ["--mode", mode, "--quadric", form])
                         for mode in ("sweep", "paper")
                         for form in ("determinant", "garland-zhou")], ())


def spending(runner):
    """The same ratio all along, and one threshold."""
    sweep = ["--mode", "sweep"]
    print_table(runner, [Variant("sweep, one threshold", sweep, switches=[]),
                         Variant("sweep, uniform ratio", sweep, switches=["--uniform-ratio"]),
                         Variant("sweep, one threshold, pilot", sweep),
                         Variant("random, uniform ratio", ["--mode", "paper"]),
                         Variant("queue, uniform ratio", ["--mode", "queue"]),
                         Variant("sweep in core", sweep, fronts=IN_CORE)], ())


EXPERIMENTS = {function.__name__: function
               for function in (choice, locked, release, quadric, spending)}
WINDOWS = {"choice": IN_CORE, "locked": IN_CORE, "quadric": IN_CORE}  # others: four fronts


def arguments():
    parser = compare.judged_parser(__doc__)
    parser.add_argument("--compare", required=True, choices=EXPERIMENTS, dest="experiment")
    parser.add_argument("--generated", nargs="*", default=[], metavar="KIND",
                        help="meshes of `tetstream generate`, too")
    parser.add_argument("--cells", type=float, default=1e5, help="of those")
    parser.add_argument("--fronts", type=float, metavar="N",
                        help="the window holds N times the front; default: of choice, locked and "
                        "quadric all cells, of others 4")
    parser.add_argument("--rounds", type=int, default=1, help="runs for the time")
    parser.add_argument("--seeds", type=int, default=3, help="of choice")
    parser.add_argument("--candidates", type=int, nargs="+", default=[8], help="of choice")
    args = parser.parse_args()
    args.fronts = args.fronts or WINDOWS.get(args.experiment, 4)
    return args


def main():
    args = arguments()
    EXPERIMENTS[args.experiment](Runner(args))


if __name__ == "__main__":
    main()
