"""What a system may deny, inputs that stall or end, streams that were cut: parts of faults.py."""
import contextlib
import os
import resource
import signal
import subprocess
import threading
import time

import runs
from runs import BAD_DATA, CANCELLED, IO, MEMORY, OK, UNSUPPORTED


def tried(group, name, command, where, run, allowed):
    code, err = run()
    group.tally.count(name, command.name, where,
                      group.bench.complaint(command, None, code, err, allowed))
    return code


def limit(kind, value):
    return lambda: resource.setrlimit(kind, (value, value))


def system_limits(group, sanitized):
    """Files of a kilobyte, few descriptors, little address space, no folder for temporary files."""
    bench = group.bench
    for command, digest, _ in group.each(lambda command: command.outputs):
        rows = [("limit: the size of files", resource.RLIMIT_FSIZE, [1, 1000], [IO])]
        if not sanitized:  # which take of both themselves
            rows += [("limit: descriptors", resource.RLIMIT_NOFILE, [4, 5, 6, 8], [IO]),
                     ("limit: address space", resource.RLIMIT_AS, [15 << 20, 25 << 20, 60 << 20],
                      [MEMORY, IO])]
        for name, kind, values, allowed in rows:
            for value in values:
                bench.fill()
                code, err = bench.run(command.words, preexec_fn=limit(kind, value))
                complaint = "" if lacks_libraries(code, err, kind) else bench.complaint(
                    command, digest, code, err, allowed)
                group.tally.count(name, command.name, str(value), complaint)
        bench.fill()
        code, err = bench.run(command.words, environment={"TMPDIR": "/nowhere"})
        group.tally.count("no folder for temporary files", command.name, "",
                          bench.complaint(command, digest, code, err, [IO]))


def lacks_libraries(code, err, kind):
    """The process does not begin, or libhdf5 cannot be loaded."""
    began = "error while loading shared libraries" not in err
    return kind != resource.RLIMIT_FSIZE and (not began or (code == UNSUPPORTED and "HDF5" in err))


def strange_places(group):
    """Folders in place of files, an empty input, a device that is full."""
    bench = group.bench
    for command, _, _ in group.each(lambda command: command.outputs):
        source = next(word for word in command.words if word.startswith("in."))
        kind = source.rsplit(".", 1)[1]
        os.makedirs(os.path.join(bench.root, "folder." + kind), exist_ok=True)
        for name, place, allowed in (("input: a folder", f"../folder.{kind}", [IO, BAD_DATA]),
                                     ("input: empty", f"../empty.{kind}", [IO, BAD_DATA])):
            if name == "input: empty":
                with open(os.path.join(bench.root, f"empty.{kind}"), "w"):
                    pass
            bench.fill()
            words = [place if word == source else word for word in command.words]
            code = tried(group, name, command, place, lambda: bench.run(words), allowed)
            if code == OK:
                group.tally.complaints.append(f"{name}: {command.name} succeeds")
        bench.fill()
        out = command.outputs[0]
        folder = os.path.join(bench.root, "out." + out.split(".")[1])
        os.makedirs(folder, exist_ok=True)
        words = ["../" + out if word == out else word for word in command.words]
        tried(group, "output: a folder of its name", command, out, lambda: bench.run(words), [IO])
        if os.path.exists("/dev/full") and kind == "tets" and "convert" in command.words:
            bench.fill()
            words = command.words[:2] + ["-", "--format", format_of(out.split(".")[1])]
            with open("/dev/full", "wb") as full:
                tried(group, "output: a device that is full", command, "",
                      lambda: bench.run(words, stdout=full), [IO])


def format_of(ending):
    return {"exo": "exodus"}.get(ending, ending)


def stalled_inputs(group):
    """An input that does not go on, and a signal; one that ends in its middle."""
    bench = group.bench
    for kind in sorted(name.split(".")[1] for name in os.listdir(bench.inputs)
                       if name.startswith("in.") and name.count(".") == 1):
        if kind in ("ele", "sol", "solb", "node", "pvtu", "pvd"):  # not of one file
            continue
        name = format_of(kind)
        with open(os.path.join(bench.inputs, "in." + kind), "rb") as file:
            data = file.read()
        words = f"convert - out.tets --format-in {name}".split()
        command = runs.Command(f"convert from a pipe, {name}", " ".join(words), ["out.tets"])
        ways = [(share, number) for share in (0, 0.5, 0.99) for number in (signal.SIGTERM, None)]
        for share, number in group.random.sample(ways, min(len(ways), 1 if group.wanted == 1 else 6)):
            bench.fill()
            process = bench.start(words, stdin=subprocess.PIPE)
            delay = group.random.choice([0.002, 0.005, 0.01, 0.05])
            err = feed(process, data[:int(share * len(data))], number, delay)
            group.tally.count("pipe: the input stalls, and a signal" if number else
                              "pipe: the input ends too early", command.name, str(share),
                              signal_complaint(group, command, process.returncode, err)
                              if number else bench.complaint(command, None, process.returncode, err,
                                                             [BAD_DATA, IO]))


def early_signals(group):
    """A signal while the run begins, whose input never comes."""
    bench = group.bench
    words = "convert - out.tets --format-in mesh".split()
    begin = time.monotonic()
    bench.run(["--version"])
    took = time.monotonic() - begin
    command = runs.Command("convert", " ".join(words), ["out.tets"])
    for _ in range(10 * group.wanted):
        bench.fill()
        process = bench.start(words, stdin=subprocess.PIPE)
        err = feed(process, b"", signal.SIGTERM, group.random.random() * 2 * took)
        group.tally.count("pipe: no input, and a signal as it begins", command.name, "",
                          signal_complaint(group, command, process.returncode, err))


def signal_complaint(group, command, code, err):
    if code == -signal.SIGTERM:  # before it had begun to listen
        return group.bench.written() and f"files {group.bench.written()}"
    return group.bench.complaint(command, None, code, err, [CANCELLED])


def feed(process, data, number, delay):
    """Gives the process the data; then it is told to end, or the input ends."""
    watch = threading.Timer(runs.PATIENCE, process.kill)
    watch.start()
    with contextlib.suppress(BrokenPipeError):  # what is wrong at once has been said
        process.stdin.write(data)
        process.stdin.flush()
    if number:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(delay)
        process.send_signal(number)
    else:
        with contextlib.suppress(BrokenPipeError):
            process.stdin.close()
    err = process.stderr.read().decode(errors="replace")
    process.wait()
    with contextlib.suppress(BrokenPipeError):
        process.stdin.close()
    watch.cancel()
    return err


def recovery(group):
    """What was whole of a .tets stream that was cut, or whose writer was killed, is read again."""
    bench = group.bench
    words = f"generate ball --cells {70000 + 65000 * group.wanted} out.tets".split()
    command = runs.Command("generate", " ".join(words), ["out.tets"])
    _, calls = bench.reference(command)
    with open(os.path.join(bench.work, "out.tets"), "rb") as file:
        whole = file.read()
    before = vertices_of(bench, whole, [])
    count = 2 * group.wanted
    for place in range(1, count + 1):
        part = whole[:len(whole) * place // (count + 1)]
        group.tally.count("a stream that was cut, recovered", command.name,
                          f"{len(part)} bytes of {len(whole)}",
                          recovery_complaint(bench, before, part, 2 * place > count))
        bench.fill()
        number = max(2, calls["write"] * place // (count + 1))
        bench.run(words, f"write {number} kill")
        part = b""
        for name in bench.written():
            with open(os.path.join(bench.work, name), "rb") as file:
                part = file.read()
        group.tally.count("killed while writing, recovered", command.name, f"write {number}",
                          recovery_complaint(bench, before, part, 2 * place > count))


def recovery_complaint(bench, before, part, has_whole_chunks):
    found = vertices_of(bench, part, ["--recover"])
    if found is None:
        return "it cannot be read" if has_whole_chunks else ""
    if found != before[:len(found)] or (has_whole_chunks and not found):
        return f"{len(found)} vertices, other ones than before"
    return ""


def vertices_of(bench, data, words):
    """The lines of vertices, as text; None where there is a failure."""
    process = subprocess.Popen([bench.tool, "convert", "-", "-", "--format-in", "tets", "--format",
                                "sva", *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, cwd=bench.work)
    out, _ = process.communicate(data)
    if process.returncode != OK:
        return None
    return [line for line in out.splitlines() if line.startswith(b"v ")]
