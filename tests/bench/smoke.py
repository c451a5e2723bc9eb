#!/usr/bin/python3
"""smoke.py --build BUILD: the measurements work. Runs them on meshes of some thousand cells,
without VTK, and looks whether their tables make sense; checks the arithmetic of the comparison.
Those that ask the judge are left out where it cannot be asked."""
import argparse
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import compare  # noqa: E402
import harness  # noqa: E402 (compare says where it is)
import islands  # noqa: E402


def printed(build, script, *words):
    done = subprocess.run([sys.executable, os.path.join(HERE, script), "--build", build, *words],
                          check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout.splitlines()


def table(build, script, *words):
    """The lines of the table that a script prints, each as {column: text}."""
    rows = [line[2:-2].split(" | ") for line in printed(build, script, *words)
            if line.startswith("| ")]
    return [dict(zip(rows[0], row)) for row in rows[2:]]


def check_speed(build):
    rows = table(build, "speed.py", "--cells", "3000", "--rounds", "1", "--vtk-cells", "0",
                 "--ratio", "0.5", "0.1")
    assert [(row["mesh"], row["ratio"]) for row in rows] == [
        (kind, ratio) for kind in ("fluid", "ball") for ratio in ("0.5", "0.1")], rows
    for row in rows:
        assert 1000 < int(row["cells"]) < 9000, row
        assert 0.9 < float(row["got / asked"]) <= 1, row
        assert float(row["s"]) > 0 and float(row["M cells/s"]) > 0, row
        assert float(row["ns / cell"]) > 0, row
        assert row["speed / VTK"] == "-", row


def check_calibration(build):
    lines = printed(build, "speed.py", "--cells", "500", "--kinds", "ball", "--rounds", "1",
                    "--vtk-cells", "0", "--calibrate")
    assert [line.split(":")[0] for line in lines[-2:]] == ["Before", "After"], lines
    for line in lines[-2:]:
        # Nothing is slower than what is near, and no machine is a thousand times off.
        words = line.split()
        times = [float(words[i - 1]) for i, word in enumerate(words) if word == "in"]
        assert len(times) == 4 and 0.2 < times[0] < times[3] < 3000, line
        assert 0.1 < float(words[-2]) < 3000, line


def check_threads(build):
    rows = table(build, "threads.py", "--cells", "3000", "--kinds", "ball", "--rounds", "1",
                 "--windows", "0", "1000", "--threads", "1", "3", "--vtk-cells", "0")
    assert [(row["window cells"] == "1000", row["threads"]) for row in rows] == [
        (False, "1"), (False, "3"), (True, "1"), (True, "3")], rows
    for row in rows:
        assert row["same bytes"] == "yes" and float(row["M cells/s"]) > 0, row
        assert row["threads"] != "1" or row["gain"] == "1.00 (1.00)", row


def check_slope(build):
    rows = table(build, "memory.py", "--slope", "--windows", "2000", "20000", "--fills", "2")
    assert len(rows) == 10, rows
    for small, large in zip(rows[::2], rows[1::2]):
        assert (small["window cells"], large["window cells"]) == ("2000", "20000"), (small, large)
        assert 10 < float(large["bytes / cell of its arrays"]) < 500, large


def check_memory(build):
    rows = table(build, "memory.py", "--cells", "20000")
    assert len(rows) == 2 and int(rows[1]["cells"]) > 10000, rows
    for row in rows:
        assert row["target"] == "reached" and float(row["peak MB"]) > 1, row


def check_memory_limit(build):
    script = os.path.join(HERE, "memory.py")
    done = subprocess.run([sys.executable, script, "--build", build, "--cells", "1000", "--limit",
                           "0.1"], check=False, stdout=subprocess.DEVNULL)
    assert done.returncode == 1, "a limit of 0.1 MB was kept"


def fluid(build, folder):
    """A mesh of some thousand cells."""
    tetstream, _ = harness.bench_programs(build)
    path = os.path.join(folder, "fluid.vtu")
    stream = os.path.join(folder, "fluid.tets")
    tetstream.run("generate", "fluid", "--cells", 5000, stream, "--quiet")
    return tetstream.convert(stream, path) + ":density"


def check_structures(build):
    with tempfile.TemporaryDirectory(prefix="tetstream-") as folder:
        fluid(build, folder)
        words = [harness.bench_path(build, "structures"), os.path.join(folder, "fluid.tets"),
                 "2000", "2"]
        done = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True)
    rows = [line[2:-2].split(" | ") for line in done.stdout.splitlines() if line[:1] == "|"]
    maps, stars = rows[2:6], rows[8:]
    assert len(maps) == 4 and all(float(row[1]) > 0 for row in maps), rows
    assert len(stars) == 4 and all(float(row[4]) > 0 and float(row[6]) > 16 for row in stars), rows


def check_reading(build):
    with tempfile.TemporaryDirectory(prefix="tetstream-") as folder:
        fluid(build, folder)
        words = [harness.bench_path(build, "reading"), "--rounds", "1",
                 os.path.join(folder, "fluid.vtu")]
        done = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True)
    rows = [line[2:-2].split(" | ") for line in done.stdout.splitlines()]
    assert len(rows) == 3 and rows[2][0] == "fluid.vtu" and int(rows[2][1]) > 3000, rows
    assert 0 < float(rows[2][4]) and 0 < float(rows[2][3]), rows


def check_orders(build):
    with tempfile.TemporaryDirectory(prefix="tetstream-") as folder:
        fluid(build, folder)
        rows = table(build, "orders.py", "--mesh", os.path.join(folder, "fluid.vtu") + ":density")
    width = {row["order"]: int(row["width"]) for row in rows}
    assert len(width) == 8 and width["spectral"] == min(width.values()), rows
    assert all(int(row["span"]) >= int(row["width"]) > 4 for row in rows), rows
    assert all(float(row["simplified: RMS %"]) > 0 for row in rows), rows


def check_cost_of_fields(build):
    lines = printed(build, "fields.py", "--no-errors", "--side", "6", "--components", "1", "7",
                    "--rounds", "1")
    rows = [line[2:-2].split(" | ") for line in lines if line]
    assert [row[:2] for row in rows[2:]] == [["1", "all"], ["7", "all"], ["7", "1"]], rows
    assert all(float(row[5]) > 1 for row in rows[2:]), rows


def check_errors_of_fields(build):
    lines = printed(build, "fields.py", "--no-cost", "--sets", "fluid+stress:density,stress",
                    "--cells", "5000", "--samples", "2000")
    rows = [line[2:-2].split(" | ") for line in lines]
    assert [row[1] for row in rows[2:4]] == ["density", "stress"], rows
    for row in rows[2:4]:
        assert float(row[3]) > 0 and 0.5 < float(row[6]) < 3 and row[7] == "-", row
    assert 0.5 < float(rows[-1][6]) < 3, rows


def check_traces(build):
    with tempfile.TemporaryDirectory(prefix="tetstream-") as folder:
        fluid(build, folder)
        rows = table(build, "traces.py", "--meshes", os.path.join(folder, "fluid.vtu") + ":density",
                     "--rounds", "1", "--ratios", "0.1")
    assert len(rows) == 1 and int(rows[0]["points"]) > 500, rows
    assert 0.2 < float(rows[0]["map / none"]) < 20, rows
    assert float(rows[0]["window MB map"]) > float(rows[0]["window MB"]) > 0, rows


def check_bounds(build):
    with tempfile.TemporaryDirectory(prefix="tetstream-") as folder:
        rows = table(build, "bounds.py", "--rows", fluid(build, folder), "--ratios", "0.2",
                     "--errors", "5", "--samples", "0")
    assert [row["asked"] for row in rows] == ["--ratio 0.2", "--error 5"], rows
    for row in rows:
        assert 0 < float(row["cells kept %"]) < 60 and 0.9 < float(row["told / RMS"]) < 2, row
    assert float(rows[1]["RMS %"]) <= 5, rows


def check_windows(build, mesh):
    rows = table(build, "windows.py", "--rows", mesh, "--fronts", "4", "--samples", "2000",
                 "--modes", "default", "paper")
    assert [row["window"] for row in rows] == ["in core", "4"] * 4, rows
    assert [row["mode"] for row in rows] == ["default", "default", "paper", "paper"] * 2, rows
    core, window = rows[:2]
    assert core["window cells / cells"] == "1.000", core
    assert 0 < float(window["window cells / cells"]) < 1, window
    for error in ("RMS", "max", "Hausdorff"):
        assert float(core[error + " %"]) > 0 and core[error + " / in core"] == "1.00", core
        assert 0.2 < float(window[error + " / in core"]) < 5, window


def paper(build, experiment, *words):
    """Its rows, the means left out."""
    rows = table(build, "paper.py", "--compare", experiment, "--samples", "2000", *words)
    return [row for row in rows if not row["mesh"].startswith("**")]


def check_paper(build, mesh):
    rows = paper(build, "choice", "--rows", mesh, "--seeds", "2", "--candidates", "2", "8")
    assert [row["variant"] for row in rows] == [
        "queue", "random, best of 2", "random, best of 8", "sweep"], rows
    for row in rows + paper(build, "quadric", "--rows", mesh):
        assert row["valid"] == "yes" and 0 < float(row["RMS %"]) < 20, row
        assert 0.9 < float(row["got / asked"]) <= 1, row
    rows = paper(build, "locked", "--rows", mesh)
    assert len(rows) == 12 and all(float(row["refused"]) > 0 for row in rows), rows
    rows = paper(build, "spending", "--rows", mesh)
    assert len(rows) == 6 and rows[0]["RMS %"] != rows[1]["RMS %"], rows


def check_release(build, mesh):
    order, error = paper(build, "release", "--rows", mesh, "--ratios", "0.5", "--fronts", "3")[:2]
    assert (order["variant"], error["variant"]) == ("paper, order", "paper, error"), (order, error)
    assert int(order["front width"]) < int(error["front width"]), (order, error)
    assert 0 <= int(order["islands"]) < int(error["islands"]), (order, error)


def check_islands():
    """Two cells with a face, and one apart: an island until the two are written, then none."""
    with tempfile.TemporaryDirectory(prefix="tetstream-") as folder:
        path = os.path.join(folder, "three.sva")
        with open(path, "w", encoding="ascii") as file:
            file.write("v 0 0 0\n" * 4 + "c 1 2 3 4\nv 1 1 1\nc -4 -3 -2 -1\n" + "v 2 2 2\n" * 4
                       + "c 6 7 8 9\n")
        assert islands.cells_of(path) == [(0, 1, 2, 3), (1, 2, 3, 4), (5, 6, 7, 8)]
        assert islands.of(path) == {"most": 1, "most_cells_percent": 100 / 3}, islands.of(path)


def check_solvers(build):
    if not os.path.isfile(os.path.join(build, "tests", "bench", "solvers")):
        return print("not run: the comparison of solvers, without Eigen")
    rows = table(build, "solvers.py", "--cases", "smooth", "homogeneous", "--edges", "64")
    assert len(rows) == 2 * 2 * 11, rows
    for row in rows:
        fails = row["case"] == "homogeneous" and row["solver"] == "Cholesky"
        assert float(row["not finite %"]) == (100 if fails else 0), row
        assert fails or float(row["excess 50 %"]) < 0.01, row
    for row in table(build, "solvers.py", "--cases", "smooth", "--places", "1e4,1,normalised",
                     "--types", "float32", "--merged", "8", "--solvers", "QR, pivots"):
        assert (float(row["excess 50 %"]) > 0.001) == (row["form"] == "A b c"), row
    return None


def check_compare(build, mesh):
    row, mean = table(build, "compare.py", "--rows", mesh, "--samples", "2000", "--no-vtk-time")
    assert row["topology"] == "kept" and row["mode"] == "default", row
    assert 0 < float(row["RMS % (VTK)"].split()[0]) < 10, row
    assert 0 <= float(row["below 10 degrees % (input, VTK)"].split()[0]) < 50, row
    assert mean["mesh"] == "**geometric mean**" and mean["speed / VTK"] == "-", mean


def check_arithmetic():
    plain = {"run": "plain", "rms": 2.0, "max": 10.0, "hausdorff": 0.5}
    scaled = {"run": "scaled", "rms": 1.0, "max": 20.0, "hausdorff": 4.0}
    ours = {"rms": 3.0, "max": 5.0, "hausdorff": 0.0}
    theirs, ratios = compare.against(ours, [plain, scaled])
    assert theirs["run"] == "scaled" and theirs["hausdorff"] == 0.5, theirs
    assert ratios == {"rms": 3.0, "max": 0.25, "hausdorff": 0.001 / 0.5}, ratios
    assert compare.against(ours, []) == ({}, {})
    recorded = compare.recorded_runs()
    assert len(recorded) == 30 and len(recorded["spx", "scalars", 0.1]) == 2, len(recorded)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True)
    build = parser.parse_args().build
    check_arithmetic()
    check_speed(build)
    check_calibration(build)
    check_memory(build)
    check_memory_limit(build)
    check_threads(build)
    check_slope(build)
    check_structures(build)
    check_reading(build)
    check_orders(build)
    check_cost_of_fields(build)
    check_traces(build)
    check_bounds(build)
    check_islands()
    check_solvers(build)
    try:
        harness.judge_module()
    except ImportError as missing:
        return print("not run, what asks the judge:", missing)
    with tempfile.TemporaryDirectory(prefix="tetstream-") as folder:
        mesh = fluid(build, folder)
        check_windows(build, mesh)
        check_compare(build, mesh)
        check_paper(build, mesh)
        check_release(build, mesh)
    check_errors_of_fields(build)
    return None


if __name__ == "__main__":
    main()
