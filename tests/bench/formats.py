#!/usr/bin/python3
"""How fast the indexed formats are read: `open_file` of this folder, which scans a file and puts
its points, cells and data into temporary files, beside the readings of meshio and of gmsh in turn,
where those are installed. Processor seconds, medians; MB is 10^6 bytes of the file. Ordering comes
later and is not in it."""
import contextlib
import io
import os
import statistics
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

HEAD = ("file", "MB", "s", "MB/s", "wall s", "meshio s", "times meshio", "gmsh s", "times gmsh")
WAYS = (("4.1 text.msh", "--encoding", "text"),
        ("2.2 text.msh", "--msh-version", "2.2", "--encoding", "text"),
        ("4.1 binary.msh",), ("2.2 binary.msh", "--msh-version", "2.2"),
        ("text.mesh",), ("binary.meshb",))


def read_by_meshio(path):
    import meshio
    with contextlib.redirect_stdout(io.StringIO()):
        meshio.read(path)


def read_by_gmsh(path):
    import gmsh
    gmsh.initialize(["", "-v", "0"])
    try:
        gmsh.open(path)
        if len(gmsh.model.mesh.getElementTypes()) == 0:
            raise ValueError("nothing was read")
    except Exception as error:  # gmsh has no other class for a syntax that it does not know
        raise ValueError(path) from error
    finally:
        gmsh.finalize()


OTHERS = (read_by_meshio, read_by_gmsh)


def seconds(read, path):
    """None where that is not installed, or does not read the file."""
    before = time.process_time()
    try:
        read(path)
    except (ImportError, ValueError):
        return None
    return time.process_time() - before


def measure(program, path, rounds):
    """Medians of our processor and wall seconds and of the others', in turn."""
    ours, walls, theirs = [], [], [[] for _ in OTHERS]
    for _ in range(rounds):
        words = subprocess.run([program, path], check=True, stdout=subprocess.PIPE,
                               text=True).stdout.split()
        ours.append(float(words[0]))
        walls.append(float(words[1]))
        for read, taken in zip(OTHERS, theirs):
            taken.append(seconds(read, path))
    return (statistics.median(ours), statistics.median(walls),
            [None if None in taken else statistics.median(taken) for taken in theirs])


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
        cells = [name, f"{size:.1f}", f"{ours:.2f}", f"{size / max(ours, 1e-4):.0f}", f"{wall:.2f}"]
        for other in theirs:
            cells += [f"{other:.2f}", f"{other / max(ours, 1e-4):.1f}"] if other else ["-", "-"]
        print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
