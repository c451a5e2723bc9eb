"""Runs of the command that are made to fail, and what has to hold after each: either the complete
output under its name and exit code 0, or none, one sentence and the exit code for it; and no other
file, neither beside the output nor in the folder of temporary files."""
import hashlib
import os
import shutil
import signal
import subprocess
import tempfile

import read_only

OK, BAD_DATA, IO, MEMORY, UNSUPPORTED, CANCELLED = 0, 2, 3, 4, 6, 7
PATIENCE = 120  # seconds; a run takes a fraction of one


class Command:
    """A row of the table: the words, and the files that they write."""

    def __init__(self, name, words, outputs):
        self.name, self.words, self.outputs = name, words.split(), outputs


def formats_written(tool):
    """Of each, how names of its files end."""
    text = subprocess.run([tool, "--version"], capture_output=True, text=True).stdout
    return [line.split()[1][1:] for line in text.splitlines() if "writes" in line]


def table(tool):
    rows = [Command("simplify a stream", "simplify in.tets out.tets --ratio 0.3 --window 4000",
                    ["out.tets"]),
            Command("simplify, read ahead and written behind",
                    "simplify in.long.tets out.tets --ratio 0.9 --window 4000 --threads 4",
                    ["out.tets"]),
            Command("simplify a mesh", "simplify in.vtu out.vtu --ratio 0.3", ["out.vtu"]),
            Command("simplify, map and log",
                    "simplify in.tets out.vtu --ratio 0.3 --map out.tetmap --collapse-log out.csv",
                    ["out.vtu", "out.tetmap", "out.csv"]),
            Command("layout", "layout in.vtu out.tets --order hilbert --memory 1M", ["out.tets"]),
            Command("compare", "compare in.tets in.vtu --samples 1000 --memory 4M", []),
            Command("info", "info in.vtu --memory 1M", [])]
    beside = {"mesh": ["out.sol"], "meshb": ["out.solb"]}
    for name in formats_written(tool):
        rows.append(Command(f"convert to {name}", f"convert in.tets out.{name}",
                            [f"out.{name}"] + beside.get(name, [])))
        if name != "tets":
            rows.append(Command(f"convert from {name}", f"convert in.{name} out.tets",
                                ["out.tets"]))
    for source in read_only.WRITERS:
        rows.append(Command(f"convert from {source}", f"convert {source} out.tets", ["out.tets"]))
    return rows


def has_zstd(tool):
    text = subprocess.run([tool, "--version"], capture_output=True, text=True).stdout
    return "no zstd" not in text


def packing(tool):
    """What compresses or decompresses."""
    rows = [Command("convert to tets", "convert in.tets out.tets", ["out.tets"]),
            Command("convert from vtu", "convert in.vtu out.tets", ["out.tets"]),
            Command("layout", "layout in.tets out.tets --order brick", ["out.tets"]),
            Command("wrap", "convert in.tets out.tets.gz", ["out.tets.gz"]),
            Command("unwrap", "convert in.tets.gz out.tets", ["out.tets"])]
    if has_zstd(tool):
        rows += [Command("wrap by zstd", "convert in.tets out.tets.zst", ["out.tets.zst"]),
                 Command("unwrap by zstd", "convert in.tets.zst out.tets", ["out.tets"])]
    return rows


class Bench:
    """Folders with the inputs, the command, and the fault library."""

    def __init__(self, tool, preloaded, cells):
        self.tool, self.preloaded = tool, preloaded
        self.root = tempfile.mkdtemp(prefix="tetstream-faults-")
        os.chmod(self.root, 0o755)
        self.inputs = os.path.join(self.root, "in")
        self.work = os.path.join(self.root, "work")
        self.spool = os.path.join(self.root, "spool")
        for folder in (self.inputs, self.work, self.spool):
            os.mkdir(folder)
        self.make_inputs(cells)

    def close(self):
        shutil.rmtree(self.root, ignore_errors=True)

    def make_inputs(self, cells):
        def run(*words):
            subprocess.run([self.tool, *words], cwd=self.inputs, check=True, capture_output=True)
        run("generate", "ball", "--cells", str(cells), "in.tets")
        run("generate", "ball", "--cells", str(40 * cells), "in.long.tets")
        for name in formats_written(self.tool):
            if name != "tets":
                run("convert", "in.tets", f"in.{name}")
        for ending in ["gz"] + (["zst"] if has_zstd(self.tool) else []):
            run("convert", "in.tets", f"in.tets.{ending}")
        read_only.make(self.inputs)

    def environment(self, fault=None, counts=None):
        env = dict(os.environ, TMPDIR=self.spool)
        if fault or counts:
            env["LD_PRELOAD"] = self.preloaded
            options = env.get("ASAN_OPTIONS", "")
            env["ASAN_OPTIONS"] = (options + ":" if options else "") + "verify_asan_link_order=0"
        if fault:
            env["FAULT"] = fault
        if counts:
            env["FAULT_COUNTS"] = counts
        return env

    def fill(self):
        """The inputs, as the only files of the work folder."""
        for folder in (self.work, self.spool):
            for name in os.listdir(folder):
                os.unlink(os.path.join(folder, name))
        for name in os.listdir(self.inputs):
            os.link(os.path.join(self.inputs, name), os.path.join(self.work, name))

    def start(self, words, fault=None, counts=None, environment=None, **more):
        env = self.environment(fault, counts)
        env.update(environment or {})
        return subprocess.Popen([self.tool, *words], cwd=self.work, env=env,
                                stdout=more.pop("stdout", subprocess.DEVNULL),
                                stderr=subprocess.PIPE, **more)

    def run(self, words, fault=None, counts=None, environment=None, **more):
        process = self.start(words, fault, counts, environment, **more)
        err = process.communicate(timeout=PATIENCE)[1].decode(errors="replace")
        return process.returncode, err

    def written(self):
        return sorted(set(os.listdir(self.work)) - set(os.listdir(self.inputs)))

    def digest(self, command):
        parts = []
        for name in command.outputs:
            with open(os.path.join(self.work, name), "rb") as file:
                parts.append(hashlib.sha256(file.read()).hexdigest())
        return parts

    def reference(self, command, environment=None):
        """What the command writes, and how often it makes each call."""
        counts = os.path.join(self.root, "counts")
        self.fill()
        code, err = self.run(command.words, counts=counts, environment=environment)
        if code != OK:
            raise AssertionError(f"{command.name} fails by itself: {err}")
        with open(counts) as file:
            calls = {line.split()[0]: int(line.split()[1]) for line in file}
        return self.digest(command), calls

    def complaint(self, command, digest, code, err, allowed, killed=False):
        """What is wrong after a run; empty: nothing."""
        if code == OK:
            if "out of memory" in err:
                return "exit code 0 and a failure"
            if self.written() != sorted(command.outputs):
                return f"exit code 0 and the files {self.written()}"
            if digest is not None and self.digest(command) != digest:
                return "exit code 0 and another output"
        elif killed and code == -signal.SIGKILL:
            # Outputs are whole or not there; what is beside them has a name that tells.
            for name in self.written():
                if name in command.outputs:
                    if digest and self.digest_of(name) not in digest:
                        return f"killed, and {name} is not whole"
                elif not any(name.startswith(out + ".") for out in command.outputs):
                    return f"killed, and there is {name}"
        else:
            if code not in allowed:
                return f"exit code {code}: {err.strip()[-300:]}"
            sentence = [line for line in err.splitlines() if line.startswith("tetstream: ")
                        and not line.startswith("tetstream: note:")]
            if len(sentence) != 1:
                return f"no sentence, or several: {err.strip()[-300:]}"
            # Where there is no memory left for the report, the outputs are there already.
            if self.written() and not (code == MEMORY and self.is_complete(command, digest)):
                return f"exit code {code} and the files {self.written()}"
        left = os.listdir(self.spool)
        return f"left in the temporary folder: {left}" if left else ""

    def keeper(self, out, err):
        """The file with "old OUT": of its name, or of one that the error tells; or None."""
        for name in self.written():
            with open(os.path.join(self.work, name), "rb") as file:
                if file.read(300) == f"old {out}".encode() and (name == out or name in err):
                    return name
        return None

    def is_complete(self, command, digest):
        return self.written() == sorted(command.outputs) and self.digest(command) == digest

    def digest_of(self, name):
        with open(os.path.join(self.work, name), "rb") as file:
            return hashlib.sha256(file.read()).hexdigest()


class Tally:
    """Tried and survived, fault by fault; prints the table."""

    def __init__(self):
        self.rows, self.complaints = {}, []

    def count(self, fault, command, where, complaint):
        tried, survived = self.rows.get(fault, (0, 0))
        self.rows[fault] = tried + 1, survived + (not complaint)
        if complaint:
            self.complaints.append(f"{fault}, {command}, {where}: {complaint}")

    def show(self):
        print(f"{'fault':44} {'tried':>6} {'survived':>9}")
        for fault, (tried, survived) in self.rows.items():
            print(f"{fault:44} {tried:6} {survived:9}")
        for complaint in self.complaints[:20]:
            print("not survived:", complaint)
        return not self.complaints and bool(self.rows)
