#!/usr/bin/python3
"""How fast the indexed formats are read: `open_file` of this folder, which scans a file and puts
its points, cells and data into temporary files, beside meshio's reading in turn, where that is
installed. Processor seconds, medians; MB is 10^6 bytes of the file. Ordering comes later and is
not in it."""
import contextlib
import io
import os
import statistics
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

HEAD = ("file", "MB", "s", "MB/s", "meshio s", "times meshio", "wall s")
WAYS = (("4.1 text.msh", "--encoding", "text"),
        ("2.2 text.msh", "--msh-version", "2.2", "--encoding", "text"),
        ("4.1 binary.msh",), ("2.2 binary.msh", "--msh-version", "2.2"),
        ("text.mesh",), ("binary.meshb",))


def meshio_seconds(path):
    try:
        import meshio
    except ImportError:
        return None
    before = time.process_time()
    with contextlib.redirect_stdout(io.StringIO()):
        meshio.read(path)
    return time.process_time() - before


def measure(program, path, rounds):
    """Medians of our processor and wall seconds and of meshio's, in turn."""
    ours, walls, theirs = [], [], []
    for _ in range(rounds):
        words = subprocess.run([program, path], check=True, stdout=subprocess.PIPE,
                               text=True).stdout.split()
        ours.append(float(words[0]))
        walls.append(float(words[1]))
        theirs.append(meshio_seconds(path))
    other = statistics.median(theirs) if theirs[0] is not None else None
    return statistics.median(ours), statistics.median(walls), other


def main():
    parser = harness.bench_parser(__doc__)
    parser.add_argument("--cells", type=float, default=2e6, metavar="N")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    tetstream = harness.bench_programs(options.build)[0]
    program = harness.bench_path(options.build, "open_file")
    tetstream.run("generate", "fluid", "--cells", str(int(options.cells)),
                  tetstream.path("mesh.tets"))
    print("| " + " | ".join(HEAD) + " |")
    print("|" + " --- |" * len(HEAD))
    for name, *words in WAYS:
        path = tetstream.path(name.replace(" ", "-"))
        tetstream.run("convert", tetstream.path("mesh.tets"), path, "--quiet", *words)
        size = os.path.getsize(path) / 1e6
        ours, wall, theirs = measure(program, path, options.rounds)
        print(f"| {name} | {size:.1f} | {ours:.2f} | "
              f"{size / max(ours, 1e-4):.0f} | " +
              (f"{theirs:.2f} | {theirs / max(ours, 1e-4):.1f}" if theirs else "- | -") +
              f" | {wall:.2f} |", flush=True)


if __name__ == "__main__":
    main()
