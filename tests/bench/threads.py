#!/usr/bin/python3
"""What threads give: `tetstream simplify`, .tets file to .tets file, with several numbers of threads.

For each mesh and window, each round runs all numbers of threads once, in turn; times are medians of
the rounds, in brackets the least. *Gain* is over the first number of threads. All must write the
same bytes: other ones make the exit code 1. With VTK's filter (built when VTK was found; meshes of
up to --vtk-cells cells) its `Update()`, once in a round, beside them. Two lines below the table say
how fast the machine's memory was before and after.
"""
import hashlib
import os
import statistics
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

HEAD = ("mesh", "cells", "ratio", "window cells", "threads", "s", "gain", "CPU s", "M cells/s",
        "peak MB", "same bytes", "VTK s", "speed / VTK")


def arguments():
    parser = harness.streams_parser(__doc__, [3e6])
    parser.add_argument("--ratio", type=float, default=0.1)
    parser.add_argument("--windows", nargs="+", type=int, default=[0], metavar="CELLS",
                        help="0: as by default")
    parser.add_argument("--threads", nargs="+", type=int, metavar="N",
                        help="by default 1, 2, 4, ... up to the cores that may be used")
    parser.add_argument("--rounds", type=int, default=5)
    args = parser.parse_args()
    if not args.threads:
        cores = len(os.sched_getaffinity(0))
        args.threads = [n for n in (2 ** k for k in range(10)) if n < cores] + [cores]
    return args


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


class Curve(harness.Streams):
    def __init__(self, args):
        super().__init__(args)
        self.same = True

    def run(self, threads, stream, field, window):
        """The report of a run, and what it wrote."""
        self.tetstream.threads = threads
        out = self.tetstream.path("out.tets")
        words = ["--window", window] if window else []
        report = self.tetstream.simplify(stream, out, "--ratio", self.args.ratio, "--field", field,
                                         *words, *self.args.options)
        return report, digest(out)

    def lines(self, name, stream, mesh, field):
        """`mesh` is the .vtu of `stream`, or None: VTK is left out."""
        for window in self.args.windows:
            runs = {threads: [] for threads in self.args.threads}
            theirs = []
            for _ in range(self.args.rounds):
                for threads, so_far in runs.items():
                    so_far.append(self.run(threads, stream, field, window))
                if mesh:
                    theirs.append(self.vtk.decimate(mesh, field, self.args.ratio, "scaled"))
            self.print_lines(name, runs, [run["seconds"] for run in theirs])

    def print_lines(self, name, runs, vtk_seconds):
        first_wall = first_bytes = None
        vtk = statistics.median(vtk_seconds) if vtk_seconds else None
        for threads, of_threads in runs.items():
            reports = [report for report, _ in of_threads]
            taken = [report["measured"] for report in reports]
            walls = [run["wall"] for run in taken]
            wall, least = statistics.median(walls), min(walls)
            written = {wrote for _, wrote in of_threads}
            first_wall, first_bytes = first_wall or (wall, least), first_bytes or written
            same = len(written) == 1 and written == first_bytes
            self.same &= same
            harness.print_row([
                name, reports[0]["cells_in"], f"{self.args.ratio:g}", reports[0]["window_cells"],
                threads, f"{wall:.3f} ({least:.3f})",
                f"{first_wall[0] / wall:.2f} ({first_wall[1] / least:.2f})",
                f"{statistics.median(run['user'] + run['system'] for run in taken):.3f}",
                f"{reports[0]['cells_in'] / wall / 1e6:.3f}",
                f"{harness.megabytes(max(run['peak_bytes'] for run in taken)):.1f}",
                "yes" if same else "NO", f"{vtk:.3f}" if vtk else "-",
                f"{vtk / wall:.2f}" if vtk else "-"])


def main():
    args = arguments()
    curve = Curve(args)
    before = harness.calibration(args.build)
    harness.print_head(HEAD)
    curve.all_lines()
    print(f"\nBefore: {before}.\nAfter: {harness.calibration(args.build)}.")
    return 0 if curve.same else 1


if __name__ == "__main__":
    sys.exit(main())
