#!/usr/bin/python3
"""smoke.py --build BUILD: the measurements work. Runs them on meshes of some thousand cells,
without VTK, and looks whether their tables make sense; checks the arithmetic of the comparison."""
import argparse
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import compare  # noqa: E402


def table(build, script, *words):
    """The lines of the table that a script prints, each as {column: text}."""
    done = subprocess.run([sys.executable, os.path.join(HERE, script), "--build", build, *words],
                          check=True, stdout=subprocess.PIPE, text=True)
    rows = [line.strip("| \n").split(" | ") for line in done.stdout.splitlines()]
    return [dict(zip(rows[0], row)) for row in rows[2:]]


def check_speed(build):
    rows = table(build, "speed.py", "--cells", "3000", "--rounds", "1", "--vtk-cells", "0")
    assert [row["mesh"] for row in rows] == ["fluid", "ball"], rows
    for row in rows:
        assert 1000 < int(row["cells"]) < 9000, row
        assert 0.9 < float(row["got / asked"]) <= 1, row
        assert float(row["s"]) > 0 and float(row["M cells/s"]) > 0, row
        assert row["speed / VTK"] == "-", row


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
    check_memory(build)
    check_memory_limit(build)


if __name__ == "__main__":
    main()
