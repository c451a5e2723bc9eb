"""soak.py COMMAND [--seconds N] [--seed N] [--case N] [--keep FOLDER]: random meshes through random
options, and what has to hold of every result:
  valid       nothing crowded, folded or flat that was not before; finite values
  topology    Euler characteristics and components of the mesh and its boundary as before
  reached     never above the target, unless the exit code says so and the report why
  told        the report has the numbers of the file
  regions     every label is still there
  constant    a field that was constant is
  marks       labelled faces are faces, their labels and what surfaces they make are as before,
              locked vertices have not moved
  traced      the map has a row for each vertex that was used, the log one for each collapse
  same        the same bytes once more, on another number of threads, without a map
  goes on     the output is read, and simplified once more
--case runs one case again; --keep keeps the files of those that fail."""
import argparse
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time

import numpy

import facts
import marks
import medit_files
import shapes
import vtk_files

OK, TARGET_MISSED = 0, 5
FORMATS = ["tets", "vtu", "vtk", "sva", "svb", "msh", "mesh", "meshb"]
FLOAT32 = ["sva", "svb"]  # rounding is the format's
HOLD_FACES = ["tets", "vtu", "vtk", "vtkhdf", "msh", "mesh", "meshb"]
HOLD_LOCKS = ["tets", "mesh", "meshb"]


class Wrong(Exception):
    pass


def expect(holds, sentence):
    if not holds:
        raise Wrong(sentence)


class Case:
    def __init__(self, tool, seed, folder):
        self.tool, self.folder = tool, folder
        self.random = numpy.random.default_rng([seed, 1])
        self.mesh = shapes.make(seed)
        self.stream = bool(self.random.integers(2))
        self.marked = bool(self.random.integers(2))
        if self.marked:
            self.mesh.story.append(marks.choose(self.mesh, self.random))
        self.options, self.format = self.choose_options()
        self.traced = bool(self.random.integers(4) == 0)
        self.logged = self.traced and bool(self.random.integers(2))

    def story(self):
        return f"{'; '.join(self.mesh.story)}; {'stream' if self.stream else 'mesh'}; " + \
            " ".join(self.options) + f"; {self.format}"

    def choose_options(self):
        random, words = self.random, []
        cells = len(self.mesh.cells)
        kind = random.integers(4)
        if kind == 0:
            words += ["--cells", str(random.integers(1, cells + 2))]
        elif kind == 1 and any(v.dtype.kind == "f" for v in self.mesh.fields.values()):
            words += ["--error", f"{10 ** random.uniform(-3, 1.5):.4g}"]
        else:
            words += ["--ratio", f"{random.uniform(0.01, 1):.4f}"]

        def perhaps(share, *choices):
            if random.random() < share:
                words.extend(choices[random.integers(len(choices))])
        if "--error" not in words:
            perhaps(0.3, ["--mode", "paper"], ["--mode", "queue"])
        fields = [name for name, v in self.mesh.fields.items() if v.dtype.kind == "f"]
        if fields and not self.marked:  # MEDIT has no names of fields
            perhaps(0.3, *(["--field", name + weight] for name in fields
                           for weight in ("", ":0.1", ":100")))
        perhaps(0.5, *(["--window", str(n)] for n in (64, 100, 300, 1000, 5000)))
        if "--error" not in words:
            perhaps(0.2, ["--quadric", "garland-zhou"])
        if "--mode" not in words:
            perhaps(0.2, ["--shape", "solver"])
            perhaps(0.2, ["--balance", "none"])
            perhaps(0.2, ["--effort", "high"])
        perhaps(0.2, ["--release", "error"])
        perhaps(0.2, ["--field-range", "keep"])
        perhaps(0.3, *(["--feature-angle", str(n)] for n in (5, 30, 90, 180)))
        perhaps(0.3, *(["--boundary-weight", n] for n in ("0", "0.01", "1000", "1e9")))
        perhaps(0.2, ["--regions", "none"])
        perhaps(0.3, *(["--memory", n] for n in ("4M", "16M", "64M")))
        perhaps(0.2, ["--seed", str(random.integers(1000))])
        perhaps(0.2, ["--pilot", "none"])
        perhaps(0.2, ["--candidates", "1"], ["--candidates", "64"])
        if not self.stream:
            perhaps(0.4, *(["--order", n] for n in ("brick", "z-order", "hilbert", "breadth-first",
                                                    "spectral", "none")))
        return words, str(random.choice(FORMATS))

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, *words, codes=(OK,)):
        done = subprocess.run([self.tool, *words], capture_output=True, text=True, timeout=120,
                              cwd=self.folder, errors="replace")
        err = " ".join(done.stderr.split())
        expect(done.returncode in codes, f"{words[0]}: exit code {done.returncode}: {err[-400:]}")
        return done.returncode, done.stdout

    def make_input(self):
        """The file to simplify."""
        if self.marked:
            source, write = "in.mesh", medit_files.write
        else:
            source, write = "in.vtk", vtk_files.write
        write(self.path(source), self.mesh)
        if self.stream:
            self.run("convert", source, "in.tets")
            source = "in.tets"
        return source

    def check(self):
        out = "out." + self.format
        words = ["simplify", self.make_input(), out, "--report", "json", *self.options]
        traces = ["--map", "map.csv"] if self.traced else []
        traces += ["--collapse-log", "log.csv"] if self.logged else []
        code, text = self.run(*words, *traces, "--threads", "1", codes=(OK, TARGET_MISSED))
        report = json.loads(text)
        with open(self.path(out), "rb") as file:
            first = file.read()
        self.check_result(out, report, code)
        if self.traced:
            self.check_traces(report)
        # Without the map, unless its points take of a memory that has a bound; with the log, for
        # which no thin cells are flipped.
        traces = traces if "--memory" in words else traces[2:]
        self.run(*words, *traces, "--threads", str(self.random.integers(1, 5)), codes=(code,))
        with open(self.path(out), "rb") as file:
            expect(file.read() == first, "the same run gives other bytes")
        if report["cells_out"] > 0:
            self.run("simplify", out, "again.tets", "--ratio", "0.5", codes=(OK, TARGET_MISSED))

    def check_traces(self, report):
        with open(self.path("map.csv")) as file:
            rows = numpy.array([line.split(",") for line in file][1:], float)
        used = numpy.unique(self.mesh.cells)
        # Of points that the reader has joined, the first counts, whether a cell has that or not.
        _, first, place = numpy.unique(self.mesh.points, axis=0, return_index=True,
                                       return_inverse=True)
        joined = numpy.unique(first[place.ravel()[used]])
        expect(len(rows) in (len(used), len(joined)) if self.stream
               else any(numpy.array_equal(numpy.sort(rows[:, 0]), these) for these in (used, joined)),
               f"the map has {len(rows)} rows, which are not those of the vertices used")
        expect((rows[:, 1] >= 0).all() and (rows[:, 1] < report["cells_out"]).all(),
               "the map names a cell that is not there")
        expect((abs(rows[:, 2:].sum(1) - 1) < 1e-6).all(), "the weights of a vertex are not 1")
        if not self.logged:
            return
        with open(self.path("log.csv")) as file:
            collapses = len(file.readlines()) - 1
        expect(collapses == report["collapses"],
               f"the log has {collapses} collapses of {report['collapses']}")

    def check_result(self, out, report, code):
        self.run("convert", out, "out-read.vtk")
        result = vtk_files.Read(self.path("out-read.vtk"))
        before, after = facts.Facts(self.mesh), facts.Facts(result)
        expect(report["cells_in"] == before.cell_count,
               f"{report['cells_in']} cells in, {before.cell_count} written")
        expect(report["cells_out"] == after.cell_count,
               f"{report['cells_out']} cells out, {after.cell_count} in the file")
        expect(report["vertices_out"] == after.vertices == len(result.points),
               f"{report['vertices_out']} vertices out, {len(result.points)} in the file, "
               f"{after.vertices} used")
        self.check_target(report, after, code)
        self.check_shape(before, after)
        self.check_values(result)
        if self.marked and self.format in HOLD_FACES:
            self.check_marks(out)

    def check_marks(self, out):
        self.run("convert", out, "out-read.mesh")
        result = medit_files.Read(self.path("out-read.mesh"))
        if self.format not in HOLD_LOCKS:
            result.locked = None
        wrong = marks.complaint(marks.Marks(self.mesh), marks.Marks(result))
        expect(not wrong, wrong)

    def check_target(self, report, after, code):
        target = report.get("target_cells", 0)
        if "--error" in self.options:
            return
        expect(target > 0, "no target")
        if code == OK:
            expect(after.cell_count <= target, f"{after.cell_count} cells for {target}")
        else:
            expect(report["limited_by"], "the target is missed for no reason")

    def check_shape(self, before, after):
        for name, value in before.topology().items():
            expect(after.topology()[name] == value,
                   f"{name} was {value} and is {after.topology()[name]}")
        for name in ("crowded_faces", "branching_edges", "folds", "flat"):
            was, now = getattr(before, name), getattr(after, name)
            # Rounding to float32 is the format's: what it flattens is known beforehand.
            if self.format in FLOAT32 and name in ("folds", "flat"):
                continue
            expect(now <= was, f"{name}: {was} before, {now} now")

    def check_values(self, result):
        for name, values in result.fields.items():
            if values.dtype.kind == "f":
                expect(numpy.isfinite(values).all(), f"field {name} is not finite")
        constant = self.mesh.fields.get("constant")
        if constant is not None and "constant" in result.fields:
            close = numpy.abs(result.fields["constant"] - constant[0]) <= 1e-5 * abs(constant[0])
            expect(close.all(), "a constant field is not")
        if "region" in self.mesh.cell_data and "none" not in self.options \
                and "region" in result.cell_data:
            lost = set(self.mesh.cell_data["region"]) - set(result.cell_data["region"])
            expect(not lost, f"regions {sorted(map(int, lost))} are gone")


def run_case(tool, seed, keep):
    folder = tempfile.mkdtemp(prefix="tetstream-soak-")
    story, wrong = "", ""
    try:
        case = Case(tool, seed, folder)
        story = case.story()
        case.check()
    except Wrong as error:
        wrong = str(error)
    except subprocess.TimeoutExpired:
        wrong = "takes more than two minutes"
    if wrong and keep:
        shutil.copytree(folder, os.path.join(keep, f"case-{seed}"), dirs_exist_ok=True)
    shutil.rmtree(folder)
    return story, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--seconds", type=float, default=math.inf)
    parser.add_argument("--cases", type=int, default=sys.maxsize)
    parser.add_argument("--seed", type=int, default=1, help="the first case's")
    parser.add_argument("--case", type=int, help="this one alone")
    parser.add_argument("--keep", help="a folder for the files of cases that fail")
    args = parser.parse_args()
    tool, begin = os.path.abspath(args.command), time.monotonic()
    seed, tried, failed = args.seed, 0, 0
    if args.case is not None:
        seed, args.cases = args.case, 1
    while tried < args.cases and time.monotonic() - begin < args.seconds:
        story, wrong = run_case(tool, seed, args.keep)
        tried += 1
        if wrong:
            failed += 1
            print(f"case {seed}: {wrong}\n  {story}", flush=True)
        seed += 1
    print(f"{tried} cases, {failed} failed, in {time.monotonic() - begin:.0f} s")
    return 1 if failed or tried == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
