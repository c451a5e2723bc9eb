#!/usr/bin/python3
"""compare.py --tetstream PROGRAM --mesh NAME --field NAME [--ratio R]

Simplifies a real mesh and compares the result with its original, by the command and by the
independent judge, which samples and shares no code with it. Every one of these must hold:
  RMS          of the field within 2 % of the judge's, or 1e-4 % of the range
  largest      error not below the judge's, which looks at points only, by more than 2 %
  outside      share of the volume as the judge's, within its sampling error
  Hausdorff    at most 3 % below the judge's and 15 % above, which looks at half as many points, or
               within 1e-4 % of the diagonal; the RMS of both distances within 5 %
  volume       and topology, orientation and dihedral angles the same
  memory       a small one gives the same figures, to 1e-9
Where one of the RMS does not, the judge is asked again, for other samples: of errors that are large
in few places they differ by more than that from each other. Ours must then be near the mean of all
in its square, or within four standard errors of it.
"""
import argparse
import json
import math
import os
import statistics
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

COUNTS = {"euler": "euler_tets", "boundary_euler": "euler_boundary", "components": "tet_components",
          "boundary_components": "boundary_components", "boundary_faces": "boundary_faces",
          "nonmanifold_faces": "nonmanifold_faces", "cells": "tets", "vertices": "points",
          "nonmanifold_edges": "boundary_nonmanifold_edges", "inverted_cells": "inverted",
          "nonmanifold_vertices": "boundary_nonmanifold_vertices", "flat_cells": "zero_volume",
          "folded_faces": "folded_faces", "duplicate_cells": "duplicate_tets"}
# Judged by cosines, which tell small angles from each other to about 1e-6 degrees.
SHAPES = {"least_angle": "min_dihedral_deg", "mean_least_angle": "mean_min_dihedral_deg",
          "median_aspect": "median_aspect", "p99_aspect": "p99_aspect"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tetstream", required=True, metavar="PROGRAM")
    parser.add_argument("--mesh", required=True, metavar="NAME")
    parser.add_argument("--field", required=True, metavar="NAME")
    parser.add_argument("--ratio", type=float, default=0.1)
    parser.add_argument("--samples", type=int, default=200000, help="of the judge")
    return parser.parse_args()


def compared(tetstream, *words):
    return json.loads(tetstream.run("compare", *words, "--quiet", "--report", "json")[0])


def close(a, b, share, least=0.0):
    return abs(a - b) <= max(share * max(abs(a), abs(b)), least)


def numbers(value, path=""):
    """Every number of a report by its place, but for what differs from run to run."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in ("seconds", "peak_bytes"):
                yield from numbers(inner, f"{path}.{key}")
    elif isinstance(value, list):
        for i, inner in enumerate(value):
            yield from numbers(inner, f"{path}[{i}]")
    else:
        yield path, value


def figures(report, verdict):
    """What both tell, as name: (ours, the judge's)."""
    field = report["fields"][0]
    judged, boundary = verdict["field"], verdict["boundary"]
    percent = 100 / report["diagonal"]
    return {"RMS %": (field["rms_percent"], judged["rms"]),
            "largest %": (field["largest_percent"], judged["max_incl_outside_by_nearest"]),
            "outside %": (100 * report["outside_volume"] / report["original"]["volume"],
                          judged["outside_percent_samples"]),
            "Hausdorff %": (percent * max(report["distance"], report["distance_back"]),
                            boundary["hausdorff"]),
            "boundary RMS %": (percent * report["rms_distance"],
                               boundary["original_to_simplified"]["rms"]),
            "back RMS %": (percent * report["rms_distance_back"],
                           boundary["simplified_to_original"]["rms"])}


JUDGED_AGAIN = 7  # times, with as many seeds
# How near ours must be to the judge's: as a share of it, or in percent.
SAMPLED = {"RMS %": (0.02, 1e-4), "boundary RMS %": (0.05, 1e-5), "back RMS %": (0.05, 1e-5)}


def far_samples(report, judged):
    """What differs from the judge's verdicts by more than their samples do from each other."""
    far = []
    for name, near in SAMPLED.items():
        ours = figures(report, judged[0])[name][0]
        squares = [figures(report, verdict)[name][1] ** 2 for verdict in judged]
        mean = statistics.mean(squares)
        error = statistics.stdev(squares) / math.sqrt(len(squares)) if len(squares) > 1 else 0
        if error:
            print(f"  {name:16} {ours:12.6g} mean  {math.sqrt(mean):12.6g}, "
                  f"standard error {error / (2 * math.sqrt(mean)):.2g}")
        if not close(ours, math.sqrt(mean), *near) and abs(ours ** 2 - mean) > 4 * error:
            far.append(name)
    return far


def check(report, verdict, samples):
    wrong = []
    expect = lambda holds, what: holds or wrong.append(what)
    told = figures(report, verdict)
    expect(told["largest %"][0] >= 0.98 * told["largest %"][1], "largest error")
    share = told["outside %"][0] / 100
    error = 100 * 4 * math.sqrt(share * (1 - share) / samples)
    # The judge counts as outside what is farther than 1e-6 of the diagonal.
    expect(told["outside %"][1] <= told["outside %"][0] + error + 1e-4, "share outside")
    ours, theirs = told["Hausdorff %"]
    expect(0.97 * theirs - 1e-4 <= ours <= 1.15 * theirs + 1e-4, "Hausdorff distance")
    expect(report["topology_kept"] == verdict["reduction"]["topology_kept"], "topology kept")
    for mesh in ("original", "simplified"):
        ours, theirs = report[mesh], verdict[mesh]
        for mine, judged in COUNTS.items():
            expect(ours[mine] == theirs[judged], f"{mesh}: {mine}")
        for mine, judged in SHAPES.items():
            # A percentile of few cells lies anywhere between two of them.
            share = 0.012 + (100 / ours["cells"] if "p99" in mine else 0)
            expect(close(ours[mine], theirs[judged], share, 1e-5), f"{mesh}: {mine}")
        expect(close(ours["volume"], theirs["volume"], 1e-9), f"{mesh}: volume")
        below = 100 * ours["share_below_10"]
        expect(close(below, theirs["percent_min_dihedral_below_10"], 0, 1e-3), f"{mesh}: angles")
    return wrong


def same_with_little_memory(tetstream, words, report):
    small = dict(numbers(compared(tetstream, *words, "--memory", "24M")))
    return [f"--memory changes {path}: {value} and {small[path]}"
            for path, value in numbers(report)
            if "place" not in path and small[path] != value and not
            (isinstance(value, float) and close(value, small[path], 1e-9, 1e-15))]


def main():
    args = arguments()
    tetstream = harness.Tetstream(args.tetstream)
    source = harness.mesh_path(args.mesh)
    target = tetstream.path("out.vtu")
    tetstream.simplify(source, target, "--ratio", args.ratio, "--field", args.field)
    words = (source, target, "--field", args.field)
    report = compared(tetstream, *words)
    judge = harness.Judge(args.samples)
    judged = [judge(source, target, args.field)]
    for name, (ours, theirs) in figures(report, judged[0]).items():
        print(f"  {name:16} {ours:12.6g} judge {theirs:12.6g}")
    print(f"  {report['original']['cells'] / report['seconds']:.0f} cells/s")
    if far_samples(report, judged):
        judged += [judge(source, target, args.field, seed) for seed in range(2, 2 + JUDGED_AGAIN)]
    wrong = far_samples(report, judged) + check(report, judged[0], args.samples)
    wrong += same_with_little_memory(tetstream, words, report)
    for what in wrong:
        print("  FAILED:", what)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
