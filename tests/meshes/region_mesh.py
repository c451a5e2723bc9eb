#!/usr/bin/python3
"""region_mesh.py --tetstream PROGRAM --mesh NAME [--ratio R]

Simplifies a real mesh with labelled regions, once in core and once in a window of four fronts, and
has independent programs look at the results. Every one of these must hold:
  regions     the judge of regions finds volumes and numbers of parts kept
  strata      parts, Euler characteristics, contacts of regions and the graph of the curves where
              they meet are those of the original (strata.py)
  shape       the interfaces' Hausdorff distance is at most that of the outer boundary, or FLOOR
  valid       the judge finds nothing newly inverted, folded or non-manifold
  reached     the target is
"""
import argparse
import os
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402
import strata  # noqa: E402

FRONTS = 4
# Percent of the diagonal: what an interface may be off where the outer boundary is plane, and so
# kept but for rounding. Gently curved faults are.
FLOOR = 0.01


def load(path):
    """Points, cells, and the first integer cell array of several values: strata.Strata takes them."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    data = grid.GetCellData()
    for i in range(data.GetNumberOfArrays()):
        values = vtk_to_numpy(data.GetArray(i))
        if np.issubdtype(values.dtype, np.integer) and len(np.unique(values)) > 1:
            return vtk_to_numpy(grid.GetPoints().GetData()).astype(float), cells, values
    sys.exit(f"{path} has no regions")


def hausdorff(judge, before, after, kind, samples=20000):
    """Between two surfaces, in percent of the diagonal; 0 where there is none."""
    rng = np.random.default_rng(1)
    one, other = getattr(before, kind), getattr(after, kind)
    if len(one) == 0 and len(other) == 0:
        return 0.0
    diagonal = np.linalg.norm(np.ptp(before.points, axis=0))
    worst = 0.0
    for p, f, q, g in ((before.points, one, after.points, other),
                       (after.points, other, before.points, one)):
        at = np.concatenate([judge.sample_surface(p, f, samples, rng), p[np.unique(f)]])
        worst = max(worst, float(judge.SurfaceDistance(q, g).closest(at)[0].max()))
    return 100 * worst / diagonal


class Checks:
    def __init__(self):
        self.failed = 0

    def expect(self, holds, sentence):
        if not holds:
            print("  FAILED:", sentence)
            self.failed += 1


def check(args, tetstream, judge, before, stream, window, checks):
    original, out = harness.mesh_path(args.mesh), tetstream.path("out.vtu")
    report = tetstream.simplify(stream, out, "--ratio", args.ratio, "--window", window)
    print(f"{args.mesh}, window {window}: {report['cells_in']} -> {report['cells_out']} cells in "
          f"{report['seconds']:.2f} s, regions {report['regions']} {report['limited_by']}",
          flush=True)
    asked, got = report["target_cells"], report["cells_out"]
    checks.expect(harness.deepest_allowed(asked) <= got <= asked,
                  f"{got} cells where {asked} were asked for: {report['limited_by']}")
    regions = os.path.join(harness.folder("TETSTREAM_JUDGE"), "regions.py")
    told = subprocess.run([sys.executable, regions, original, out], stdout=subprocess.PIPE,
                          text=True, check=False)
    print(" ", told.stdout.strip(), flush=True)
    checks.expect(told.returncode == 0, "the judge of regions objects")
    after = strata.Strata(*load(out))
    for sentence in strata.differences(before, after):
        checks.expect(False, sentence)
    inner, outer = (hausdorff(judge.module, before, after, k) for k in ("interface", "outer"))
    print(f"  Hausdorff: interfaces {inner:.4f} %, outer boundary {outer:.4f} %", flush=True)
    checks.expect(inner <= max(outer, FLOOR), "the interfaces are farther off than the boundary")
    verdict = judge(original, out)
    checks.expect(verdict["valid"] and harness.new_non_manifold(verdict) == 0,
                  "the judge finds the mesh not valid")
    checks.expect(verdict["reduction"]["topology_kept"], "the topology has changed")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tetstream", required=True, metavar="PROGRAM")
    parser.add_argument("--mesh", required=True, metavar="NAME")
    parser.add_argument("--ratio", type=float, default=0.1, metavar="R")
    args = parser.parse_args()
    judge = harness.Judge(20000)
    tetstream = harness.Tetstream(args.tetstream)
    stream = tetstream.convert(harness.mesh_path(args.mesh), tetstream.path("in.tets"))
    before = strata.Strata(*load(harness.mesh_path(args.mesh)))
    info = tetstream.info(stream)
    checks = Checks()
    for window in (info["cells"], FRONTS * info["front_cells"]):
        check(args, tetstream, judge, before, stream, window, checks)
    sys.exit(checks.failed > 0)


if __name__ == "__main__":
    main()
