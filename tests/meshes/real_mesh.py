#!/usr/bin/python3
"""real_mesh.py --tetstream PROGRAM --mesh NAME [--field NAME] --ratios R...

Simplifies a real mesh at each ratio, by the error of one field or (without --field) by its geometry
alone, and has an independent judge look at the result. Every one of these must hold:
  valid       no cell inverted, flat or folded, none twice, none upon another, unless it was before
  topology    Euler characteristics, components and counts of non-manifold elements as before; no
              new non-manifold face, edge or vertex
  reached     never above the target, and at most the larger of 0.2 % and 10 cells below it; the
              exceptions are in LIMITED with what limits them
  in order    the front of the output, as it was written, is at most 1.5 times as wide as that of
              the same mesh when a plane sweeps through it anew, along the axis along which one swept
              through the input: the output keeps that order, although cells that become long may
              make another axis better. (Its width relative to its vertices cannot be that of the
              input: cells twice as long leave an eighth of the vertices but a quarter of a front,
              which is a surface.)
  goes on     the output is simplified once more, to half
"""
import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

# (mesh, field or None, ratio): what keeps the target from being reached.
LIMITED = {}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tetstream", required=True, metavar="PROGRAM")
    parser.add_argument("--mesh", required=True, metavar="NAME")
    parser.add_argument("--field", metavar="NAME")
    parser.add_argument("--ratios", nargs="+", type=float, required=True, metavar="R")
    parser.add_argument("--samples", type=int, default=20000, help="of the judge")
    return parser.parse_args()


class Checks:
    """What did not hold, as sentences."""

    def __init__(self):
        self.failures = []

    def expect(self, holds, sentence):
        if not holds:
            print("  FAILED:", sentence)
            self.failures.append(sentence)


class RealMesh:
    def __init__(self, args):
        self.mesh, self.field = args.mesh, args.field
        self.path = harness.mesh_path(args.mesh)
        self.judge = harness.Judge(args.samples)
        self.tetstream = harness.Tetstream(args.tetstream)
        self.stream = self.tetstream.convert(self.path, self.tetstream.path("in.tets"))
        self.before = self.tetstream.info(self.stream)
        self.axis = self.axis_of_input()
        self.words = ["--regions", "none"]
        if args.field:
            self.words += ["--field", args.field]
        else:
            for column in self.before["fields"]:  # carried, not measured
                self.words += ["--field", column["name"] + ":0"]

    def sweep(self, path, axis):
        return self.tetstream.layout(path, self.tetstream.path("swept.tets"), "--order", "spatial",
                                     "--axis", axis)

    def axis_of_input(self):
        """x, y or z; auto if the input was swept through along none, or put into another order."""
        report = self.sweep(self.path, "auto")
        is_swept = report["front_width"] == self.before["front_width"]
        axis = report["order"].removeprefix("spatial, along ")
        return axis if is_swept and axis in ("x", "y", "z") else "auto"

    def check(self, ratio, checks):
        out = self.tetstream.path("out.tets")
        report = self.tetstream.simplify(self.stream, out, "--ratio", ratio, *self.words)
        print(f"{self.mesh}, {self.field or 'geometry'}, ratio {ratio:g}: {report['cells_in']} -> "
              f"{report['cells_out']} cells in {report['seconds']:.2f} s, target "
              f"{report['target_cells']} {report['limited_by']}", flush=True)
        self.check_target(ratio, report, checks)
        self.check_verdict(out, checks)
        self.check_front(out, checks)
        again = self.tetstream.simplify(out, self.tetstream.path("again.tets"), "--ratio", 0.5,
                                        *self.words)
        checks.expect(again["cells_in"] == report["cells_out"], "read again, all cells are there")

    def check_target(self, ratio, report, checks):
        asked, got = report["target_cells"], report["cells_out"]
        checks.expect(got >= harness.deepest_allowed(asked), f"{got} cells are too few")
        limit = LIMITED.get((self.mesh, self.field, ratio))
        if limit and got > asked:
            print("  target missed, as known:", limit)
        elif limit:
            print("  target reached, although LIMITED says:", limit)
        else:
            checks.expect(got <= asked, f"the target is {asked}, the result has {got} cells: "
                          + report["limited_by"])

    def check_verdict(self, out, checks):
        result = self.tetstream.convert(out, self.tetstream.path("out.vtu"))
        verdict = self.judge(self.path, result, self.field)
        before, after = verdict["original"], verdict["simplified"]
        for kind in ("inverted", "zero_volume", "folded_faces", "duplicate_tets",
                     "repeated_vertex_tets", *harness.NON_MANIFOLD):
            checks.expect(after[kind] <= before[kind], f"{kind}: {before[kind]} -> {after[kind]}")
        for kind in ("euler_tets", "euler_boundary", "tet_components", "boundary_components"):
            checks.expect(after[kind] == before[kind], f"{kind}: {before[kind]} -> {after[kind]}")
        checks.expect(verdict["valid"], "the judge calls it valid")
        checks.expect(verdict["reduction"]["topology_kept"], "the judge calls the topology kept")
        line = f"  volume {verdict['reduction']['volume_difference_percent']:+.3g} %"
        if self.field:
            line += f", RMS {verdict['field']['rms']:.3g} %"
        print(f"{line}, Hausdorff {verdict['boundary']['hausdorff']:.3g} %", flush=True)

    def check_front(self, out, checks):
        after = self.tetstream.info(out)
        swept = self.sweep(self.tetstream.path("out.vtu"), self.axis)["front_width"]
        print(f"  front {self.before['front_width']} of {self.before['vertices']} -> "
              f"{after['front_width']} of {after['vertices']} vertices; swept anew, axis "
              f"{self.axis}: {swept}")
        checks.expect(after["front_width"] <= 1.5 * swept, "the output's front is too wide")


def main():
    args = arguments()
    mesh, checks = RealMesh(args), Checks()
    for ratio in args.ratios:
        mesh.check(ratio, checks)
    return 1 if checks.failures else 0


if __name__ == "__main__":
    sys.exit(main())
