#!/usr/bin/python3
"""The one-call form in Python against the command: `tetstream.simplify(points, cells, fields)` on
arrays in memory, and `tetstream simplify IN.vtu OUT.tets` on a file of the same arrays. Both in turn,
each in a process of its own, medians of --rounds, and whether the bytes are the same.

`s` and `CPU s` are, of Python, those of the call; of the command, those of the process. `more MB` is
what the call takes at most beyond what the process had before, the input's arrays among that;
`allowed MB` the arrays of the result, the window, and 16 bytes for each cell of the input. The exit
code is 1 if CPU seconds are more than --slower times the command's, more is taken than allowed, or bytes
differ. The package is that of the build, unless PYTHONPATH names another.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "support"))
import harness  # noqa: E402

HEAD = ("mesh", "cells", "cells' type", "Python s", "command s", "Python CPU s", "command CPU s",
        "CPU Python / command", "more MB", "allowed MB", "same bytes")
BYTES_PER_CELL = 16


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/release", help="the folder of the build")
    parser.add_argument("--mesh", nargs="+", default=["isabel"], metavar="MESH",
                        help="a name in TETSTREAM_MESHES or a path")
    parser.add_argument("--ratio", default="0.1")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--slower", type=float, default=1.05, metavar="TIMES")
    parser.add_argument("--base", type=float, default=0, metavar="MB",
                        help="allowed besides, for buffers that do not grow with the mesh")
    parser.add_argument("--threads", type=int, default=1, help="of both; 0 as by default")
    parser.add_argument("--types", nargs="+", default=["int64", "int32"], help="of the cells")
    parser.add_argument("--call", nargs=4, metavar=("ARRAYS", "RATIO", "THREADS", "OUT"),
                        help=argparse.SUPPRESS)
    return parser.parse_args()


# ------------------------------------------------------------------------------ in Python
def memory(name):
    """VmRSS or VmHWM, in bytes."""
    with open("/proc/self/status", encoding="ascii") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(name))


def call(path, ratio, threads, out):
    """One call, in this process; prints what it took."""
    import numpy
    import tetstream
    with numpy.load(path) as stored:
        arrays = {name: stored[name] for name in stored.files}
    points, cells = arrays.pop("points"), arrays.pop("cells")
    tetstream.simplify(points[:4], [[0, 1, 2, 3]], ratio=1)  # what is imported and set up once
    with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
        file.write("5")  # the peak counts from here
    before, clock, cpu = memory("VmRSS"), time.perf_counter(), resource.getrusage(0)
    result = tetstream.simplify(points, cells, arrays, ratio=float(ratio),
                                threads=int(threads))
    after = resource.getrusage(0)
    seconds, peak = time.perf_counter() - clock, memory("VmHWM")
    kept = sum(a.nbytes for a in (result.points, result.cells, *result.fields.values()))
    numpy.savez(out, points=result.points, cells=result.cells, **result.fields)
    print(json.dumps({
        "seconds": seconds, "more": peak - before, "cells": len(cells),
        "cpu": sum(getattr(after, kind) - getattr(cpu, kind) for kind in ("ru_utime", "ru_stime")),
        "allowed": kept + result.report.peak_window_bytes + BYTES_PER_CELL * len(cells)}))


# ------------------------------------------------------------------------------- both in turn
class Arrays:
    def __init__(self, args):
        self.args = args
        self.tetstream, _ = harness.bench_programs(args.build)
        self.tetstream.threads = args.threads
        self.environment = dict(os.environ)
        self.environment.setdefault("PYTHONPATH", os.path.join(args.build, "bindings", "python"))
        sys.path[:0] = self.environment["PYTHONPATH"].split(os.pathsep)

    def line(self, name, kind):
        import numpy
        import tetstream
        arrays, file, out = (self.tetstream.path(end) for end in ("a.npz", "in.vtu", "out"))
        mesh = tetstream.read(harness.mesh_path(name), cell_type=kind)
        mesh.cell_data = {}
        mesh.write(file, compress="no")
        numpy.savez(arrays, points=mesh.points, cells=mesh.cells, **mesh.fields)
        del mesh
        ours, theirs = [], []
        for _ in range(self.args.rounds):
            taken = self.tetstream.simplify(file, out + ".tets", "--ratio",
                                            self.args.ratio)["measured"]
            theirs.append((taken["wall"], taken["user"] + taken["system"]))
            text = subprocess.run([sys.executable, __file__, "--call", arrays, self.args.ratio,
                                   str(self.args.threads), out + ".npz"], env=self.environment, check=True,
                                  stdout=subprocess.PIPE, text=True).stdout
            ours.append(json.loads(text))
        stored, read = numpy.load(out + ".npz"), tetstream.read(out + ".tets", cell_type=kind)
        same = all(stored[key].tobytes() == values.tobytes() for key, values in
                   {"points": read.points, "cells": read.cells, **read.fields}.items())
        cpu = statistics.median(run["cpu"] for run in ours)
        command_cpu = statistics.median(run[1] for run in theirs)
        more = max(run["more"] for run in ours)
        allowed = ours[0]["allowed"] + self.args.base * 2 ** 20
        harness.print_row([
            os.path.basename(name), ours[0]["cells"], kind,
            f"{statistics.median(run['seconds'] for run in ours):.2f}",
            f"{statistics.median(run[0] for run in theirs):.2f}", f"{cpu:.2f}",
            f"{command_cpu:.2f}", f"{cpu / command_cpu:.3f}", f"{harness.megabytes(more):.1f}",
            f"{harness.megabytes(allowed):.1f}", "yes" if same else "NO"])
        return cpu <= self.args.slower * command_cpu and more <= allowed and same


def main():
    args = arguments()
    if args.call:
        return call(*args.call)
    bench = Arrays(args)
    harness.print_head(HEAD)
    kept = [bench.line(name, kind) for name in args.mesh for kind in args.types]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
