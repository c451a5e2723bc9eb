"""What the tests and measurements in Python share: running the command, asking the judge.

Real meshes come from the folder TETSTREAM_MESHES; the independent judge of results, judge.py, from
the folder TETSTREAM_JUDGE. Both are environment variables; what needs one that is not set is "not
run": exit code 77.
"""
import argparse
import importlib.util
import json
import os
import statistics
import subprocess
import sys
import tempfile

NOT_RUN = 77
TARGET_MISSED = 5  # exit code of a simplification that is complete but has too many cells

# Meshes with a scalar field each, on which results are compared.
ROWS = (("spx", "scalars"), ("vampy_artery_cfd", "p_t200"), ("fluidity_seamount", "Temperature"),
        ("fluidity_seamount", "Pressure"), ("bluntfin", "Density"), ("bracket", "xdsp"),
        ("chaste_twin_flow", "Pressure"), ("chaste_twin_flow", "temperature"),
        ("isabel", "velocityMag"), ("cylflow", "Temperature"))

NON_MANIFOLD = ("nonmanifold_faces", "boundary_nonmanifold_edges", "boundary_nonmanifold_vertices")


def not_run(reason):
    print("not run:", reason)
    sys.exit(NOT_RUN)


def is_slow():
    """Whether runs are many times slower than usual: with sanitizers, for one (slow_run.h)."""
    return "TETSTREAM_SLOW" in os.environ


def folder(variable):
    """The folder named by an environment variable; leaves with "not run" if there is none."""
    path = os.environ.get(variable, "")
    if not os.path.isdir(path):
        not_run(f"the environment variable {variable} names no folder")
    return path


def mesh_path(name):
    """A mesh by its name in the folder of real meshes, or by its path."""
    if os.path.isfile(name):
        return name
    path = os.path.join(folder("TETSTREAM_MESHES"), name + ".vtu")
    if not os.path.isfile(path):
        sys.exit(f"there is no mesh {path}")
    return path


def judge_module():
    """judge.py; raises ImportError if it, or what it reads meshes with, is not here."""
    path = os.path.join(os.environ.get("TETSTREAM_JUDGE", ""), "judge.py")
    if not os.path.isfile(path):
        raise ImportError("the environment variable TETSTREAM_JUDGE names no folder with judge.py")
    importlib.import_module("vtk")
    spec = importlib.util.spec_from_file_location("judge", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Judge:
    """The judge, with the original that was judged last kept in memory; leaves with "not run" if it
    is not here."""

    def __init__(self, samples):
        try:
            self.module = judge_module()
        except ImportError as missing:
            not_run(missing)
        self.samples = samples
        self.path, self.original = None, None

    def __call__(self, original, simplified, field=None, seed=1):
        if self.path != original:
            self.path, self.original = original, self.module.load(original)
        return self.module.judge(self.original, self.module.load(simplified), field, self.samples,
                                 seed)


def new_non_manifold(verdict):
    """How many non-manifold faces, edges and vertices the simplified mesh has more of."""
    before, after = verdict["original"], verdict["simplified"]
    return sum(max(0, after[kind] - before[kind]) for kind in NON_MANIFOLD)


def deepest_allowed(target):
    """The smallest number of cells that counts as having reached the target."""
    return target - max(0.002 * target, 10)


class Program:
    """A program; its runs are measured if `measured`, the program of tests/bench, is given."""

    def __init__(self, program, measured=None):
        for path in (program, measured):
            if path and not os.path.isfile(path):
                sys.exit(f"there is no program {path}")
        self.program, self.measured = program, measured
        self.scratch = tempfile.TemporaryDirectory(prefix="tetstream-")

    def path(self, name):
        """A file that lives as long as this object."""
        return os.path.join(self.scratch.name, name)

    def run(self, *words, allowed=(0,), stdin=None):
        """Standard output of a run, and its measurements if they are taken."""
        command = [self.program, *map(str, words)]
        report = self.path("measured.json")
        if self.measured:
            command = [self.measured, report, *command]
        done = subprocess.run(command, stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, check=False)
        if done.returncode not in allowed:
            sys.exit(f"{' '.join(command)}\nended with {done.returncode}: {done.stderr}")
        if not self.measured:
            return done.stdout, {}
        with open(report, encoding="ascii") as file:
            return done.stdout, json.load(file)


class Tetstream(Program):
    """The command, which simplifies with so many threads, 0 as by default."""

    def __init__(self, program, measured=None, threads=0):
        super().__init__(program, measured)
        self.threads = threads

    def info(self, path):
        return json.loads(self.run("info", path, "--json", "--quiet")[0])

    def convert(self, source, target):
        self.run("convert", source, target, "--quiet")
        return target

    def layout(self, source, target, *words):
        """The report of a layout, with the measurements under "measured"."""
        text, taken = self.run("layout", source, target, "--quiet", "--report", "json", *words)
        return {**json.loads(text), "measured": taken}

    def simplify(self, source, target, *words, stdin=None):
        """The report of a run, with the measurements under "measured"."""
        text, taken = self.run("simplify", source, target, "--quiet", "--report", "json",
                               "--threads", self.threads, *words,
                               allowed=(0, TARGET_MISSED), stdin=stdin)
        return {**json.loads(text), "measured": taken}


class VtkFilter(Program):
    """VTK's filter, as vtk_decimate of tests/bench runs it."""

    def decimate(self, mesh, field, ratio, run):
        """What the program says and what was measured; the result is in self.path("out.vtu")."""
        text, taken = self.run(mesh, field, ratio, run, self.path("out.vtu"))
        return {**json.loads(text), "measured": taken}


class Switched(Program):
    """The simplification with switches of its own, as switched of tests/bench runs it."""

    def simplify(self, source, target, *words):
        """As that of the command."""
        text, taken = self.run(source, target, *words)
        return {**json.loads(text), "measured": taken}


def bench_programs(build):
    """From the folder of a build: the command with one thread, as VTK's filter has, and that filter
    or None, both measured."""
    bench = os.path.join(build, "tests", "bench")
    measured = os.path.join(bench, "measured")
    filter_path = os.path.join(bench, "vtk_decimate")
    vtk = VtkFilter(filter_path, measured) if os.path.isfile(filter_path) else None
    return Tetstream(os.path.join(build, "bindings", "cli", "tetstream"), measured, threads=1), vtk


def streams_parser(description, cells):
    """The arguments of a measurement on .tets files, which `Streams` takes; `cells` by default."""
    parser = bench_parser(description)
    parser.add_argument("--kinds", nargs="+", default=["fluid", "ball"], metavar="KIND")
    parser.add_argument("--cells", nargs="+", type=float, default=cells, metavar="N")
    parser.add_argument("--mesh", nargs="+", type=mesh_and_field, default=[], metavar="MESH:FIELD",
                        help="real meshes, too: a name in TETSTREAM_MESHES or a path")
    parser.add_argument("--vtk-cells", type=float, default=4e6,
                        help="VTK is left out for generated meshes of more")
    return parser


class Streams:
    """The meshes of such arguments as .tets files, one after the other. What is measured on each is
    lines(name, stream, mesh, field); `mesh` is the .vtu of `stream`, or None: VTK is left out."""

    def __init__(self, args):
        self.args = args
        self.tetstream, self.vtk = bench_programs(args.build)

    def all_lines(self):
        for name, field in self.args.mesh:
            self.real(name, field)
        for kind in self.args.kinds:
            for cells in self.args.cells:
                self.generated(kind, cells)

    def generated(self, kind, cells):
        stream, mesh = self.tetstream.path("in.tets"), None
        self.tetstream.run("generate", kind, "--cells", int(cells), stream, "--quiet")
        if self.vtk and cells <= self.args.vtk_cells:
            mesh = self.tetstream.convert(stream, self.tetstream.path("in.vtu"))
        self.lines(kind, stream, mesh, "density")

    def real(self, name, field):
        mesh = mesh_path(name)
        stream = self.tetstream.convert(mesh, self.tetstream.path("in.tets"))
        self.lines(f"{name} {field}", stream, mesh if self.vtk else None, field)


def bench_path(build, name):
    """A program of tests/bench."""
    path = os.path.join(build, "tests", "bench", name)
    if not os.path.isfile(path):
        sys.exit(f"there is no program {path}")
    return path


def bench_parser(description):
    """The arguments that every measurement has."""
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/release", help="the folder of the build")
    parser.add_argument("options", nargs="*", metavar="-- OPTION", help="more words for simplify")
    return parser


def mesh_and_field(word):
    """An argument MESH:FIELD; MESH is a name in TETSTREAM_MESHES or a path."""
    mesh, field = word.rsplit(":", 1)
    return mesh, field


def median_times(runs):
    """Of runs (wall seconds, processor seconds, peak): medians, and the largest peak."""
    walls, cpus, peaks = zip(*runs)
    return {"seconds": statistics.median(walls), "cpu_seconds": statistics.median(cpus),
            "peak_bytes": max(peaks)}


def timed_in_turn(rounds, simplify, decimate=None):
    """Runs both in turn. Of each: what the last run says, and the times of all; of VTK's filter
    None without `decimate`."""
    ours, theirs = [], []
    run = None
    for _ in range(rounds):
        report = simplify()
        taken = report["measured"]
        ours.append((taken["wall"], taken["user"] + taken["system"], taken["peak_bytes"]))
        if decimate:
            run = decimate()
            theirs.append((run["seconds"], run["cpu_seconds"], run["measured"]["peak_bytes"]))
    return report, median_times(ours), run, median_times(theirs) if theirs else None


def calibration(build):
    """What the machine's memory does now, as a sentence."""
    found = json.loads(subprocess.run([bench_path(build, "calibrate")], check=True,
                                      stdout=subprocess.PIPE, text=True).stdout)
    loads = ", ".join(f"{time:.1f} in {int(size) / 1024:g} MB"
                      for size, time in found["load_ns"].items())
    return f"ns per dependent load: {loads}; memcpy {found['memcpy_gb_per_s']:.1f} GB/s"


def print_row(cells):
    """A line of a Markdown table."""
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def print_head(names):
    print_row(names)
    print_row(["---"] * len(names))


def megabytes(count):
    return count / 2 ** 20
