#!/usr/bin/python3
"""What `--shape solver` makes of the cells' shapes, and what it costs.

For each row (a mesh and a scalar field of it): the default mode and the solver's, each judged; of
the cells the share in percent with a dihedral angle below 1, 5 and 10 degrees, in brackets the
input's, the least angle, the mean of the cells' least angles; RMS and maximum of the field's error
in percent of its range, in brackets in those of the default mode; Hausdorff distance in percent of
the diagonal, in brackets VTK's as compare.py takes it. Time: processor seconds of the whole process,
file to file, in those of the default mode; those of `Update()` alone of VTK's filter in them, and in
brackets the same of the wall's; medians of --rounds rounds in which a mode and VTK run in turn. With
--threads N as many threads, else one; 0: as many as the command takes by itself.

With --check it fails unless, in the solver's mode,
  - of an input with at most 1 % of cells below 10 degrees no more than 1 % are, at no more than 1.5
    times the RMS error of the default mode; with at most 0.1 %, no more than 0.1 %, at no more than
    2 times;
  - of any input the shares below 1 and 10 degrees are, within one part in a hundred, no larger than
    the larger of the default mode's and the input's;
  - the topology is kept and the result valid, and the target is reached.
"""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "support"))
sys.path.insert(0, HERE)
import compare  # noqa: E402
import harness  # noqa: E402

BELOW = (1, 5, 10)  # degrees
MODES = {"default": [], "solver": ["--shape", "solver"]}
# Of the input below 10 degrees at most, of the result below 10 at most (percent), times the RMS.
PROMISES = ((0.1, 0.1, 2.0), (1.0, 1.0, 1.5))
HEAD = ("mesh", "field", "ratio", "shape", "got / asked", "below 1 degree %", "below 5 %",
        "below 10 %", "least angle", "mean", "RMS %", "max %", "Hausdorff % (VTK)", "topology",
        "time / default", "speed / VTK (wall)")


def arguments():
    parser = compare.judged_parser(__doc__)
    parser.add_argument("--check", action="store_true", help="fail where the promises do not hold")
    parser.add_argument("--rounds", type=int, default=1, help="runs for the time; 5 is fair")
    parser.add_argument("--threads", type=int, default=1, metavar="N")
    parser.add_argument("--vtk-here", action="store_true", help="run and judge VTK's filter here")
    parser.add_argument("--no-vtk-time", action="store_true", help="do not run VTK for its time")
    parser.add_argument("--work", default="build/bench", help="where VTK's verdicts are kept")
    return parser.parse_args()


def share(described, degrees):
    return described[f"percent_min_dihedral_below_{degrees}"]


class Shapes:
    def __init__(self, args):
        self.args = args
        self.tetstream, vtk = harness.bench_programs(args.build)
        self.tetstream.threads = args.threads
        self.judge = harness.Judge(args.samples)
        self.vtk = compare.Vtk(args, vtk, self.judge)
        self.failures = []

    def row(self, name, path, field, ratio):
        stream = self.tetstream.convert(path, self.tetstream.path("in.tets"))
        runs = self.vtk.runs(name, path, field, ratio)
        variant = min(runs, key=lambda run: run["rms"])["run"] if runs else None
        results = {}
        for mode, words in MODES.items():
            results[mode] = self.run(path, stream, field, ratio, words, variant)
        for mode, result in results.items():
            harness.print_row([name, field, f"{ratio:g}", mode,
                               *self.cells(result, results["default"], runs)])
        if self.args.check:
            self.check(f"{name} {field} {ratio:g}", results["default"], results["solver"])

    def run(self, path, stream, field, ratio, words, variant):
        out = self.tetstream.path("out.tets")
        report, times, _, vtk_times = harness.timed_in_turn(
            self.args.rounds,
            lambda: self.tetstream.simplify(stream, out, "--ratio", ratio, "--field", field, *words,
                                            *self.args.options),
            variant and self.vtk.timed
            and (lambda: self.vtk.program.decimate(path, field, ratio, variant)))
        result = self.tetstream.convert(out, self.tetstream.path("out.vtu"))
        return {"report": report, "times": times, "vtk_times": vtk_times,
                "verdict": self.judge(path, result, field)}

    def cells(self, result, default, runs):
        verdict, report = result["verdict"], result["report"]
        before, after = verdict["original"], verdict["simplified"]
        ours, theirs = compare.errors(verdict), compare.errors(default["verdict"])
        hausdorff = min((run["hausdorff"] for run in runs), default=None)
        speed = "-"
        if result["vtk_times"]:
            processor, wall = (result["vtk_times"][kind] / result["times"][kind]
                               for kind in ("cpu_seconds", "seconds"))
            speed = f"{processor:.1f} ({wall:.1f})"
        return [f"{report['cells_out'] / report['target_cells']:.4f}",
                *(f"{share(after, d):.3g} ({share(before, d):.3g})" for d in BELOW),
                f"{after['min_dihedral_deg']:.3g}",
                f"{after['mean_min_dihedral_deg']:.1f} ({before['mean_min_dihedral_deg']:.1f})",
                *(f"{ours[k]:.3g} ({ours[k] / theirs[k]:.2f})" for k in ("rms", "max")),
                compare.with_vtk(ours["hausdorff"], hausdorff),
                ("kept" if verdict["reduction"]["topology_kept"] else "CHANGED")
                + ("" if verdict["valid"] else ", NOT VALID"),
                f"{result['times']['cpu_seconds'] / default['times']['cpu_seconds']:.2f}", speed]

    def expect(self, holds, sentence):
        if not holds:
            print("FAILED:", sentence, flush=True)
            self.failures.append(sentence)

    def check(self, row, default, solver):
        verdict, report = solver["verdict"], solver["report"]
        before, after = verdict["original"], verdict["simplified"]
        usual = default["verdict"]["simplified"]
        for of_input, of_result, times in PROMISES:
            if share(before, 10) > of_input:
                continue
            rms = verdict["field"]["rms"] / default["verdict"]["field"]["rms"]
            self.expect(share(after, 10) <= of_result,
                        f"{row}: {share(after, 10):.3g} % are below 10 degrees")
            self.expect(rms <= times, f"{row}: the RMS error is {rms:.2f} times the default's")
        for degrees in (1, 10):
            most = max(share(usual, degrees), share(before, degrees))
            self.expect(share(after, degrees) <= 1.01 * most + 0.05,
                        f"{row}: {share(after, degrees):.3g} % below {degrees}, not {most:.3g}")
        self.expect(verdict["valid"] and verdict["reduction"]["topology_kept"],
                    f"{row}: not valid, or another topology")
        asked, got = report["target_cells"], report["cells_out"]
        self.expect(harness.deepest_allowed(asked) <= got <= asked,
                    f"{row}: {got} cells, {asked} were asked for: {report['limited_by']}")


def main():
    args = arguments()
    shapes = Shapes(args)
    harness.print_head(HEAD)
    for name, field in args.rows:
        for ratio in args.ratios:
            shapes.row(name, harness.mesh_path(name), field, ratio)
    return 1 if shapes.failures else 0


if __name__ == "__main__":
    sys.exit(main())
