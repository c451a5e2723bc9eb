"""faults.py COMMAND LIBRARY GROUP [POINTS [CELLS]]: commands whose calls fail, whose inputs change
while they are read, who are signalled, share an output, or have no place to write. Prints what was
tried and what was survived. GROUP is calls, transfers, memory, surroundings or limits."""
import errno
import os
import random
import signal
import subprocess
import sys
import threading
import time

import limits
import runs
from runs import BAD_DATA, CANCELLED, IO, MEMORY, OK


def points(count, wanted):
    """Up to `wanted` of the numbers 1 to count: the first, the last, and others evenly between."""
    if count <= wanted:
        return range(1, count + 1)
    return sorted({1 + round(i * (count - 1) / max(wanted - 1, 1)) for i in range(wanted)})


class Group:
    def __init__(self, bench, wanted):
        self.bench, self.wanted, self.tally = bench, wanted, runs.Tally()
        self.random = random.Random(1)
        self.commands, self.references, self.turn = runs.table(bench.tool), {}, 0

    def each(self, choose=lambda command: True):
        """The commands; where little is wanted every sixth, from another one on each time."""
        chosen = [command for command in self.commands if choose(command)]
        if self.wanted == 1:
            self.turn += 1
            chosen = chosen[self.turn % 6::6]
        for command in chosen:
            if command.name not in self.references:
                self.references[command.name] = self.bench.reference(command)
            yield command, *self.references[command.name]

    def call_fails(self, name, call, whats, allowed, choose=lambda command: True):
        """Number n of a call fails, for some n of each command."""
        for command, digest, calls in self.each(choose):
            for n in points(calls[call], self.wanted):
                what = whats[n % len(whats)]
                self.bench.fill()
                code, err = self.bench.run(command.words, f"{call} {n} {what}")
                self.tally.count(name, command.name, f"{call} {n} {what}",
                                 self.bench.complaint(command, digest, code, err, allowed))

    # ------------------------------------------------------------------------------- groups

    def calls(self):
        self.call_fails("open: no file left, or no permission", "open",
                        [errno.EMFILE, errno.EACCES], [IO])
        self.call_fails("close fails", "close", [f"only:{errno.EIO}"], [IO])
        self.call_fails("rename fails", "rename", [f"only:{errno.EPERM}"], [IO])
        self.call_fails("sync to the disk fails", "sync", [f"only:{errno.EIO}"], [IO])
        self.old_files_are_kept()

    def transfers(self):
        self.call_fails("write: no space left", "write", [errno.ENOSPC, errno.EDQUOT], [IO])
        self.call_fails("write: error once", "write", [f"only:{errno.EIO}"], [IO])
        self.call_fails("read: error", "read", [errno.EIO, f"only:{errno.EIO}"], [IO])
        self.short_transfers()

    def memory(self):
        def is_ours(command):  # libhdf5 ends the process itself when it gets no memory
            return "vtkhdf" not in command.name
        self.call_fails("memory ends", "memory", [errno.ENOMEM], [MEMORY], is_ours)
        self.call_fails("memory is short once", "memory", [f"only:{errno.ENOMEM}"], [MEMORY],
                        is_ours)
        self.no_memory_to_pack()

    def surroundings(self):
        self.changing_inputs()
        self.signals()
        self.killed_while_writing()
        self.same_output()
        self.unwritable_places()
        self.pipes()

    def limits(self):
        limits.system_limits(self, sanitized="TETSTREAM_SANITIZED" in os.environ)
        limits.strange_places(self)
        limits.stalled_inputs(self)
        limits.early_signals(self)
        limits.recovery(self)

    # ---------------------------------------------------------------------------- one by one

    def old_files_are_kept(self):
        """Of outputs that get their names together, where from some rename on none can be done: not
        even back."""
        for command in self.commands:
            for n in range(1, len(command.outputs) + 1) if len(command.outputs) > 1 else ():
                self.bench.fill()
                for name in command.outputs:
                    with open(os.path.join(self.bench.work, name), "w") as file:
                        file.write("old " + name)
                code, err = self.bench.run(command.words, f"rename {n} {errno.EPERM}")
                kept = {out: self.bench.keeper(out, err) for out in command.outputs}
                self.bench.run(command.words)  # which takes away what is abandoned
                complaint = "" if code == IO else f"exit code {code}: {err.strip()[-300:]}"
                for out, name in kept.items():
                    if name not in self.bench.written():
                        complaint = complaint or f"what {out} was is lost"
                self.tally.count("rename fails, and back", command.name, f"rename {n}", complaint)

    def no_memory_to_pack(self):
        """Each of the few large pieces of memory that are asked for, as by what compresses."""
        large = {"FAULT_LEAST": "4000"}
        for command in runs.packing(self.bench.tool):
            digest, calls = self.bench.reference(command, large)
            for n in range(1, calls["memory"] + 1):
                self.bench.fill()
                fault = f"memory {n} only:{errno.ENOMEM}"
                code, err = self.bench.run(command.words, fault, environment=large)
                self.tally.count("no large piece of memory", command.name, fault,
                                 self.bench.complaint(command, digest, code, err, [MEMORY]))

    def short_transfers(self):
        for command, digest, calls in self.each():
            for call in ("read", "write"):
                # One byte at a time from there on: not too many.
                begin = max(1, calls[call] - 4)
                self.bench.fill()
                code, err = self.bench.run(command.words, f"{call} {begin} short")
                self.tally.count(f"{call}: interrupted and short", command.name, f"from {begin}",
                                 self.bench.complaint(command, digest, code, err, []))

    def changing_inputs(self):
        """Half of the input goes, or as much again comes, while it is read."""
        for command, digest, calls in self.each():
            source = next(word for word in command.words if word.startswith("in."))
            for what in ("shrink", "grow"):
                for n in points(calls["read"], self.wanted):
                    self.bench.fill()
                    path = os.path.join(self.bench.work, source)
                    with open(path, "rb") as file:
                        data = file.read()
                    os.unlink(path)  # a copy, not the input of the other runs
                    with open(path, "wb") as file:
                        file.write(data)
                    code, err = self.bench.run(command.words, f"read {n} {what}",
                                               environment={"FAULT_FILE": path})
                    self.tally.count(f"input: {what}s while it is read", command.name, f"read {n}",
                                     self.bench.complaint(command, digest, code, err,
                                                          [BAD_DATA, IO]))

    def signals(self):
        """At random moments of a run."""
        for command, digest, _ in self.each(lambda command: command.outputs):
            self.bench.fill()
            begin = time.monotonic()
            self.bench.run(command.words)
            took = time.monotonic() - begin
            for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGKILL):
                for _ in range(self.wanted):
                    self.bench.fill()
                    process = self.bench.start(command.words)
                    time.sleep(self.random.random() * took)
                    process.send_signal(number)
                    err = process.communicate(timeout=runs.PATIENCE)[1].decode()
                    code = process.returncode
                    if code == -number and number != signal.SIGKILL:
                        # Before the process has begun to listen.
                        complaint = self.bench.written() and f"files {self.bench.written()}"
                    else:
                        complaint = self.bench.complaint(command, digest, code, err, [CANCELLED],
                                                         killed=number == signal.SIGKILL)
                    self.tally.count(f"{number.name} at a random moment", command.name, "",
                                     complaint)

    def killed_while_writing(self):
        """The next run on the same name removes what the killed one left."""
        for command, digest, calls in self.each(lambda command: command.outputs):
            for n in points(calls["write"], self.wanted):
                self.bench.fill()
                code, err = self.bench.run(command.words, f"write {n} kill")
                complaint = self.bench.complaint(command, digest, code, err, [], killed=True)
                if not complaint:
                    code, err = self.bench.run(command.words)
                    complaint = self.bench.complaint(command, digest, code, err, [])
                self.tally.count("killed while writing, and another run", command.name,
                                 f"write {n}", complaint)

    def same_output(self):
        """Two runs at once on one name: one of the two outputs is there, and whole."""
        for command, digest, _ in self.each(lambda command: len(command.outputs) == 1):
            for _ in range(self.wanted):
                self.bench.fill()
                both = [self.bench.start(command.words) for _ in range(2)]
                words = [process.communicate(timeout=runs.PATIENCE)[1].decode() for process in both]
                complaint = ""
                for process, err in zip(both, words):
                    complaint = complaint or self.bench.complaint(command, digest,
                                                                  process.returncode, err, [])
                self.tally.count("two runs on the same output", command.name, "", complaint)

    def unwritable_places(self):
        """A folder that is not there, one that is a file, one that may not be written to."""
        def nobody():
            if os.getuid() == 0:
                os.setgid(65534)
                os.setuid(65534)
        try:
            subprocess.run([self.bench.tool, "--version"], preexec_fn=nobody, capture_output=True,
                           check=True)
            reachable = True
        except (OSError, subprocess.CalledProcessError):  # as where it lies in root's folder
            reachable = False
        for command, _, _ in self.each(lambda command: command.outputs):
            for name, place in (("no such folder", "gone/"), ("a file in place of a folder",
                                                              "in.tets/"),
                                ("a folder without permission", "")):
                if not place and not reachable:  # by another user
                    continue
                self.bench.fill()
                words = [place + word if word in command.outputs else word
                         for word in command.words]
                more = {}
                if not place:
                    os.chmod(self.bench.work, 0o555)
                    os.chmod(self.bench.spool, 0o777)
                    more["preexec_fn"] = nobody
                code, err = self.bench.run(words, **more)
                os.chmod(self.bench.work, 0o755)
                self.tally.count(f"output: {name}", command.name, "",
                                 "it is written" if code == OK else
                                 self.bench.complaint(command, None, code, err, [IO]))

    def pipes(self):
        """Who reads the output goes away, or stops reading and the process is told to end."""
        for words in ("generate ball --cells 1000000 -", "convert in.vtu - --format tets",
                      "simplify in.tets - --ratio 0.9", "convert in.tets - --format sva"):
            command = runs.Command(words, words, [])
            self.bench.fill()
            process = self.bench.start(command.words, stdout=subprocess.PIPE)
            process.stdout.read(100)
            process.stdout.close()
            err = process.stderr.read().decode()
            process.wait(runs.PATIENCE)
            self.tally.count("pipe: the reader goes away", words, "",
                             self.bench.complaint(command, None, process.returncode, err, [IO]))
        for number in (signal.SIGTERM, signal.SIGINT):
            command = runs.Command("generate", "generate ball --cells 10000000 -", [])
            self.bench.fill()
            process = self.bench.start(command.words, stdout=subprocess.PIPE)
            process.stdout.read(100)
            time.sleep(0.2)
            process.send_signal(number)
            watch = threading.Timer(runs.PATIENCE, process.kill)
            watch.start()
            err = process.stderr.read().decode()  # its output is left where it is
            process.wait()
            watch.cancel()
            process.stdout.close()
            self.tally.count("pipe: the reader stalls, and a signal", command.name, number.name,
                             self.bench.complaint(command, None, process.returncode, err,
                                                  [CANCELLED]))


def main(tool, library, group, wanted=2, cells=3000):
    bench = runs.Bench(os.path.abspath(tool), os.path.abspath(library), int(cells))
    try:
        tried = Group(bench, int(wanted))
        getattr(tried, group)()
        return 0 if tried.tally.show() else 1
    finally:
        bench.close()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
