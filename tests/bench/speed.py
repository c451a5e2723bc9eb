#!/usr/bin/python3
"""Speed of `tetstream simplify`, .tets file to .tets file, on generated meshes of several sizes.
`ns / cell` is of processor time, per cell of the input.

With VTK's filter (built when VTK was found), its time for the same mesh and ratio beside ours:
`Update()` alone of the run helped by scaling (see vtk_decimate.cpp), our whole process; both in
turn, medians of --rounds. VTK is left out above --vtk-cells, since it holds the mesh in memory.
With --calibrate two lines below the table say how fast the machine's memory was before and after.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

HEAD = ("mesh", "cells", "ratio", "threads", "got / asked", "s", "CPU s", "M cells/s", "ns / cell", "peak MB",
        "VTK got / asked", "VTK s", "VTK CPU s", "VTK peak MB", "speed / VTK")


def arguments():
    parser = harness.streams_parser(__doc__, [1e5, 1e6, 1e7])
    parser.add_argument("--ratio", nargs="+", type=float, default=[0.1], metavar="R")
    parser.add_argument("--threads", nargs="+", type=int, default=[1], metavar="N",
                        help="0: one for each core")
    parser.add_argument("--rounds", type=int, default=3, help="runs for the time; 5 is fair")
    parser.add_argument("--calibrate", action="store_true", help="measure the memory, too")
    return parser.parse_args()


class Speed(harness.Streams):
    def lines(self, name, stream, mesh, field):
        for ratio in self.args.ratio:
            for self.tetstream.threads in self.args.threads:
                self.line(name, stream, mesh, field, ratio)

    def line(self, name, stream, mesh, field, ratio):
        """`mesh` is the .vtu of `stream`, or None: VTK is left out."""
        words = [stream, self.tetstream.path("out.tets"), "--ratio", ratio, "--field", field,
                 *self.args.options]
        report, ours, run, theirs = harness.timed_in_turn(
            self.args.rounds, lambda: self.tetstream.simplify(*words),
            mesh and (lambda: self.vtk.decimate(mesh, field, ratio, "scaled")))
        wall, cpu = ours["seconds"], ours["cpu_seconds"]
        line = [name, report["cells_in"], f"{ratio:g}", self.tetstream.threads,
                f"{report['cells_out'] / report['target_cells']:.4f}", f"{wall:.3f}", f"{cpu:.3f}",
                f"{report['cells_in'] / wall / 1e6:.3f}", f"{1e9 * cpu / report['cells_in']:.0f}",
                f"{harness.megabytes(ours['peak_bytes']):.1f}"]
        if theirs:
            line += [f"{run['cells_out'] / report['target_cells']:.4f}",
                     f"{theirs['seconds']:.3f}", f"{theirs['cpu_seconds']:.3f}",
                     f"{harness.megabytes(theirs['peak_bytes']):.1f}",
                     f"{theirs['seconds'] / wall:.2f}"]
        else:
            line += ["-"] * 5
        harness.print_row(line)


def main():
    args = arguments()
    speed = Speed(args)
    before = harness.calibration(args.build) if args.calibrate else ""
    harness.print_head(HEAD)
    speed.all_lines()
    if args.calibrate:
        print(f"\nBefore: {before}.\nAfter: {harness.calibration(args.build)}.")


if __name__ == "__main__":
    main()
