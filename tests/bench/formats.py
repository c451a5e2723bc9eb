#!/usr/bin/python3
"""How fast the indexed formats are read: `reading --once` of this folder beside the readings of
meshio, gmsh and VTK in turn, where those are installed and read the format. Wall seconds, with one
thread and with --threads: medians, or with --least the least, for machines that others use, too. MB
is 10^6 bytes of the file. "s" is the scan, after which points, cells and data are arrays in temporary
files; of what is such where it lies (vtu, vtk, vtkhdf, binary msh and meshb) it is opening and the
reading of all columns. "and columns s": with their reading in any case, with all threads. Ordering
comes later and is not in it. "times": against all threads, the others as they are."""
import contextlib
import io
import os
import statistics
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import harness  # noqa: E402

HEAD = ("file", "MB", "1 thread s", "{} threads s", "MB/s", "and columns s", "meshio s",
        "times meshio", "gmsh s", "times gmsh", "VTK s", "times VTK")
WAYS = (("4.1 text.msh", "--encoding", "text"),
        ("2.2 text.msh", "--msh-version", "2.2", "--encoding", "text"),
        ("4.1 binary.msh",), ("2.2 binary.msh", "--msh-version", "2.2"),
        ("text.mesh",), ("binary.meshb",), ("tetgen.node",), ("text.su2",),
        ("raw.vtu", "--compress", "no"), ("zlib.vtu",), ("text.vtu",), ("binary.vtk",),
        ("text.vtk",), ("raw.vtkhdf", "--compress", "no"))


def read_by_meshio(path):
    import meshio
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            meshio.read(path)
        except meshio.ReadError as error:
            raise ValueError(path) from error


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


def read_by_vtk(path):
    if not path.endswith((".vtu", ".vtk", ".vtkhdf")):
        raise ValueError(path)
    from vtk_files import grid_of
    if grid_of(path).GetNumberOfCells() == 0:
        raise ValueError("nothing was read")


OTHERS = (read_by_meshio, read_by_gmsh, read_by_vtk)


# ---------------------------------------------------------- what we do not write, made of a .vtk


def write_text_vtk(source, target):
    import vtk
    from vtk_files import grid_of
    writer = vtk.vtkXMLUnstructuredGridWriter() if target.endswith(".vtu") \
        else vtk.vtkUnstructuredGridWriter()
    writer.SetInputData(grid_of(source))
    if target.endswith(".vtu"):
        writer.SetDataModeToAscii()
    writer.SetFileName(target)
    writer.Write()


def points_and_cells(source):
    from vtk.util.numpy_support import vtk_to_numpy
    from vtk_files import grid_of
    grid = grid_of(source)
    return (vtk_to_numpy(grid.GetPoints().GetData()).tolist(),
            vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4).tolist())


def write_tetgen(source, target):
    points, cells = points_and_cells(source)
    with open(target, "w", encoding="ascii") as file:
        file.write(f"{len(points)} 3 0 0\n")
        file.writelines(f"{i} {x} {y} {z}\n" for i, (x, y, z) in enumerate(points))
    with open(target[:-5] + ".ele", "w", encoding="ascii") as file:
        file.write(f"{len(cells)} 4 0\n")
        file.writelines(f"{i} {a} {b} {c} {d}\n" for i, (a, b, c, d) in enumerate(cells))


def write_su2(source, target):
    points, cells = points_and_cells(source)
    with open(target, "w", encoding="ascii") as file:
        file.write(f"NDIME= 3\nNELEM= {len(cells)}\n")
        file.writelines(f"10 {a} {b} {c} {d} {i}\n" for i, (a, b, c, d) in enumerate(cells))
        file.write(f"NPOIN= {len(points)}\n")
        file.writelines(f"{x} {y} {z} {i}\n" for i, (x, y, z) in enumerate(points))
        file.write("NMARK= 0\n")


MADE = {"tetgen.node": write_tetgen, "text.su2": write_su2, "text.vtu": write_text_vtk,
        "text.vtk": write_text_vtk}


def make(tetstream, name, words):
    """The file, or None if that takes a module that is not there, and its bytes."""
    path = tetstream.path(name.replace(" ", "-"))
    if name not in MADE:
        tetstream.run("convert", tetstream.path("mesh.tets"), path, "--quiet", *words)
    else:
        try:
            MADE[name](tetstream.path("made.vtk"), path)
        except ImportError:
            return None, 0
    for ending in (".sol", ".solb"):  # what others do not read
        beside = os.path.splitext(path)[0] + ending
        if os.path.exists(beside):
            os.remove(beside)
    both = [path] + [path[:-5] + ".ele"] * path.endswith(".node")
    return path, sum(map(os.path.getsize, both)) / 1e6


def seconds(read, path):
    """None where that is not installed, or does not read the file."""
    before = time.monotonic()
    try:
        read(path)
    except (ImportError, ValueError, KeyError, SystemExit):
        return None
    return time.monotonic() - before


def reading(program, threads, path):
    """Our two times."""
    words = subprocess.run([program, "--once", str(threads), path], check=True,
                           stdout=subprocess.PIPE, text=True).stdout.split()
    opened, both = float(words[2]), float(words[3])
    in_place = path.endswith((".vtu", ".vtk", ".vtkhdf", "binary.msh", ".meshb"))
    return both if in_place else opened, both


def measure(program, path, threads, rounds, figure):
    """What `figure` makes of our times with one thread, with all and with the columns, and of the others', in
    turn."""
    ours, theirs = [[], [], []], [[] for _ in OTHERS]
    for _ in range(rounds):
        ours[0].append(reading(program, 1, path)[0])
        for taken, took in zip(ours[1:], reading(program, threads, path)):
            taken.append(took)
        for read, taken in zip(OTHERS, theirs):
            taken.append(seconds(read, path))
    return ([figure(taken) for taken in ours],
            [None if None in taken else figure(taken) for taken in theirs])


def main():
    parser = harness.bench_parser(__doc__)
    parser.add_argument("--cells", type=float, default=2e6, metavar="N")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)), metavar="N")
    parser.add_argument("--least", action="store_true")
    options = parser.parse_args()
    tetstream = harness.bench_programs(options.build)[0]
    program = harness.bench_path(options.build, "reading")
    tetstream.run("generate", "fluid", "--cells", str(int(options.cells)),
                  tetstream.path("mesh.tets"))
    tetstream.run("convert", tetstream.path("mesh.tets"), tetstream.path("made.vtk"), "--quiet")
    print("| " + " | ".join(HEAD).format(options.threads) + " |")
    print("|" + " --- |" * len(HEAD))
    for name, *words in WAYS:
        path, size = make(tetstream, name, words)
        if not path:
            continue
        (alone, ours, columns), theirs = measure(program, path, options.threads, options.rounds,
                                                 min if options.least else statistics.median)
        cells = [name, f"{size:.1f}", f"{alone:.3f}", f"{ours:.3f}", f"{size / max(ours, 1e-4):.0f}",
                 f"{columns:.3f}"]
        for other in theirs:
            cells += [f"{other:.3f}", f"{other / max(ours, 1e-4):.1f}"] if other else ["-", "-"]
        print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
