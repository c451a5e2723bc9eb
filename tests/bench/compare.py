#!/usr/bin/python3
"""Compares `tetstream simplify` with VTK's vtkUnstructuredGridQuadricDecimation on real meshes.

For each row (a mesh and a scalar field of it) and each ratio: simplify, judge the result, print a
line of one Markdown table, and the geometric means at its end. Errors are the judge's: RMS and
maximum of the field in percent of its range, Hausdorff distance of the boundary in percent of the
diagonal of the bounding box.

VTK's run is, of its two runs (plain: as it is; scaled: helped by scaling, see vtk_decimate.cpp),
the one with the lower RMS among those that kept at most 1.05 times the target. For Hausdorff it is
the smaller of those runs. Ratios to it are taken after raising both sides to 0.001 %. Its errors
are those recorded in vtk_runs.csv, or with --vtk-here those of runs on this machine, which are
kept in the folder --work.

Shapes: the share of cells whose smallest dihedral angle is below 1 and below 10 degrees, beside it
the input's and, with --vtk-here, that of VTK's run.

Speed is the wall time of the whole process, .tets file to .tets file, against that of VTK's filter
alone, for the same ratio: medians of --rounds rounds in which both run in turn.
"""
import csv
import hashlib
import json
import math
import os
import statistics
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "support"))
import harness  # noqa: E402

FLOOR = 0.001  # percent, below which two errors count as the same
ERRORS = ("rms", "max", "hausdorff")
SHAPES = ("percent_min_dihedral_below_1", "percent_min_dihedral_below_10")  # as the judge says
HEAD = ("mesh", "field", "ratio", "mode", "asked", "got", "RMS % (VTK)", "max % (VTK)",
        "Hausdorff % (VTK)", "below 1 degree % (input, VTK)", "below 10 degrees % (input, VTK)",
        "topology", "new non-manifold", "s", "CPU s", "M cells/s", "peak MB (VTK)", "RMS / VTK",
        "max / VTK", "Hausdorff / VTK", "speed / VTK")


def judged_parser(description):
    """The arguments of all that judges rows."""
    parser = harness.bench_parser(description)
    parser.add_argument("--rows", nargs="*", type=harness.mesh_and_field, default=harness.ROWS,
                        metavar="MESH:FIELD", help="default: all; MESH is a name in "
                        "TETSTREAM_MESHES or a path")
    parser.add_argument("--ratios", nargs="+", type=float, default=[0.1], metavar="R")
    parser.add_argument("--samples", type=int, default=200000, help="of the judge")
    parser.add_argument("--json", metavar="FILE", help="also write all that was found there")
    return parser


def arguments():
    parser = judged_parser(__doc__)
    parser.add_argument("--modes", nargs="+", default=["default"], metavar="MODE",
                        help="of simplify; default: the one that it has if none is named")
    parser.add_argument("--fronts", type=float, metavar="N",
                        help="the window holds N times the front (default: as the command does)")
    parser.add_argument("--rounds", type=int, default=1, help="runs for the time; 5 is fair")
    parser.add_argument("--vtk-here", action="store_true", help="run and judge VTK's filter here")
    parser.add_argument("--no-vtk-time", action="store_true", help="do not run VTK for its time")
    parser.add_argument("--work", default="build/bench", help="where VTK's verdicts are kept")
    return parser.parse_args()


# ------------------------------------------------------------------------------------ VTK's run
def recorded_runs():
    runs = {}
    with open(os.path.join(HERE, "vtk_runs.csv"), encoding="ascii") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            key = (row["mesh"], row["field"], float(row["ratio"]))
            run = {name: float(row[name]) for name in ("kept", *ERRORS)}
            runs.setdefault(key, []).append({"run": row["run"], **run})
    return runs


def digest(*paths_and_words):
    total = hashlib.sha256()
    for item in paths_and_words:
        if os.path.isfile(item):
            with open(item, "rb") as file:
                total.update(hashlib.file_digest(file, "sha256").digest())
        else:
            total.update(item.encode() + b"\0")
    return total.hexdigest()[:24]


class Vtk:
    """VTK's filter: what was recorded of it, and runs here."""

    def __init__(self, args, program, judge):
        if args.vtk_here and not program:
            sys.exit(f"there is no vtk_decimate in {args.build}: was VTK found at configure time?")
        self.program = program
        self.timed = program is not None and not args.no_vtk_time
        self.judged_here, self.work = args.vtk_here, args.work
        self.judge, self.recorded = judge, recorded_runs()

    def judged_run(self, path, field, ratio, variant):
        name = digest(path, self.program.program, field, str(ratio), variant,
                      str(self.judge.samples), *SHAPES)
        kept = os.path.join(self.work, f"vtk-{name}.json")
        if os.path.isfile(kept):
            with open(kept, encoding="ascii") as file:
                return json.load(file)
        run = self.program.decimate(path, field, ratio, variant)
        verdict = self.judge(path, self.program.path("out.vtu"), field)
        result = {"run": variant, "kept": run["cells_out"] / run["cells_in"], **errors(verdict),
                  **shapes(verdict["simplified"])}
        os.makedirs(self.work, exist_ok=True)
        with open(kept, "w", encoding="ascii") as file:
            json.dump(result, file)
        return result

    def runs(self, name, path, field, ratio):
        """Those that count: that reached the target, nearly."""
        if self.judged_here:
            found = [self.judged_run(path, field, ratio, run) for run in ("plain", "scaled")]
        else:
            found = self.recorded.get((name, field, ratio), [])
        return [run for run in found if run["kept"] <= 1.05 * ratio]


def errors(verdict):
    return {"rms": verdict["field"]["rms"],
            "max": verdict["field"]["max_incl_outside_by_nearest"],
            "hausdorff": verdict["boundary"]["hausdorff"]}


def shapes(described):
    return {name: described[name] for name in SHAPES}


def quotients(ours, theirs):
    """Errors divided by others, both raised to what counts as the same."""
    return {k: max(ours[k], FLOOR) / max(theirs[k], FLOOR) for k in ERRORS}


def against(ours, runs):
    """The errors of VTK's run, and ours divided by them."""
    if not runs:
        return {}, {}
    theirs = dict(min(runs, key=lambda run: run["rms"]))
    theirs["hausdorff"] = min(run["hausdorff"] for run in runs)
    return theirs, quotients(ours, theirs)


def window_of(fronts, info):
    """Cells of a window that holds so many fronts of a mesh."""
    return math.ceil(fronts * info["front_cells"])


def save(path, results):
    """For --json, if it was given."""
    if path:
        with open(path, "w", encoding="utf-8") as file:
            json.dump(results, file, indent=1)


# ------------------------------------------------------------------------------------- one line
class Comparison:
    def __init__(self, args):
        self.args = args
        self.tetstream, vtk = harness.bench_programs(args.build)
        self.judge = harness.Judge(args.samples)
        self.vtk = Vtk(args, vtk, self.judge)

    def stream_of(self, path):
        """The mesh as a .tets file, and the words that set the window."""
        stream = self.tetstream.convert(path, self.tetstream.path("in.tets"))
        if not self.args.fronts:
            return stream, []
        return stream, ["--window", window_of(self.args.fronts, self.tetstream.info(stream))]

    def line(self, name, path, field, ratio, mode, stream, window):
        out = self.tetstream.path("out.tets")
        words = [stream, out, "--ratio", ratio, "--field", field, *window,
                 *([] if mode == "default" else ["--mode", mode]), *self.args.options]
        runs = self.vtk.runs(name, path, field, ratio)
        variant = min(runs, key=lambda run: run["rms"])["run"] if runs else None
        report, times, _, vtk_times = harness.timed_in_turn(
            self.args.rounds, lambda: self.tetstream.simplify(*words),
            variant and self.vtk.timed
            and (lambda: self.vtk.program.decimate(path, field, ratio, variant)))
        verdict = self.judge(path, self.tetstream.convert(out, self.tetstream.path("out.vtu")),
                             field)
        ours = errors(verdict)
        theirs, ratios = against(ours, runs)
        result = {"mesh": name, "field": field, "ratio": ratio, "mode": mode,
                  "asked": report["target_cells"], "got": report["cells_out"], **ours,
                  "shapes": shapes(verdict["simplified"]),
                  "shapes_of_input": shapes(verdict["original"]),
                  "vtk": theirs, "to_vtk": ratios, "valid": verdict["valid"],
                  "topology_kept": verdict["reduction"]["topology_kept"],
                  "new_non_manifold": harness.new_non_manifold(verdict), **times,
                  "cells_per_second": report["cells_in"] / times["seconds"], "report": report}
        if vtk_times:
            result.update({"vtk_" + name: value for name, value in vtk_times.items()})
            result["to_vtk"]["speed"] = vtk_times["seconds"] / times["seconds"]
        return result


# --------------------------------------------------------------------------------------- table
def with_vtk(ours, theirs):
    return f"{ours:.3g} ({theirs:.3g})" if theirs is not None else f"{ours:.3g} (-)"


def shape_cells(r):
    for name in SHAPES:
        beside = [r["shapes_of_input"][name], r["vtk"].get(name)]
        texts = ["-" if share is None else f"{share:.3g}" for share in beside]
        yield f"{r['shapes'][name]:.3g} ({', '.join(texts)})"


def cells_of(r):
    """The cells of a line of the table."""
    vtk_peak = harness.megabytes(r["vtk_peak_bytes"]) if "vtk_peak_bytes" in r else None
    ratios = [f"{r['to_vtk'][k]:.2f}" if k in r["to_vtk"] else "-" for k in (*ERRORS, "speed")]
    return [r["mesh"], r["field"], f"{r['ratio']:g}", r["mode"], str(r["asked"]), str(r["got"]),
            *(with_vtk(r[k], r["vtk"].get(k)) for k in ERRORS), *shape_cells(r),
            ("kept" if r["topology_kept"] else "CHANGED") + ("" if r["valid"] else ", NOT VALID"),
            str(r["new_non_manifold"]), f"{r['seconds']:.3f}", f"{r['cpu_seconds']:.3f}",
            f"{r['cells_per_second'] / 1e6:.3f}",
            with_vtk(harness.megabytes(r["peak_bytes"]), vtk_peak), *ratios]


def print_means(results, ratio, mode):
    """The geometric means of the ratios to VTK over the rows that have them."""
    chosen = [r for r in results if (r["ratio"], r["mode"]) == (ratio, mode)]
    means = []
    for k in (*ERRORS, "speed"):
        values = [r["to_vtk"][k] for r in chosen if k in r["to_vtk"]]
        means.append(f"{statistics.geometric_mean(values):.3f}" if values else "-")
    harness.print_row(["**geometric mean**", "", f"{ratio:g}", mode] + [""] * 13 + means)


def main():
    args = arguments()
    comparison = Comparison(args)
    harness.print_head(HEAD)
    results = []
    for name, field in args.rows:
        path = harness.mesh_path(name)
        stream, window = comparison.stream_of(path)
        for ratio in args.ratios:
            for mode in args.modes:
                results.append(comparison.line(name, path, field, ratio, mode, stream, window))
                harness.print_row(cells_of(results[-1]))
    for ratio in args.ratios:
        for mode in args.modes:
            print_means(results, ratio, mode)
    save(args.json, results)


if __name__ == "__main__":
    main()
