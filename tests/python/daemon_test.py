"""A program may end while a daemon thread is in the library: reading, called back, or raising."""
import subprocess
import sys
import unittest

from meshes import SLOW

BEGIN = """
import sys, threading, time
import numpy, tetstream
begun = threading.Event()
POINTS, CELLS = numpy.eye(4, 3), [[0, 1, 2, 3]]

def box(n):
    line = numpy.linspace(0, 1, n + 1)
    points = numpy.stack(numpy.meshgrid(line, line, line, indexing="ij"), -1).reshape(-1, 3)
    at = numpy.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    corner = [at[i:n + i, j:n + j, k:n + k].ravel() for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    ways = ((0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7))
    cells = numpy.concatenate([numpy.stack([corner[i] for i in way], -1) for way in ways])
    return points, cells, {"f": points[:, 0] ** 2}
"""
END = """
threading.Thread(target=work, daemon=True).start()
begun.wait()
time.sleep(0.2)
print("the end")
"""
WORK = {
    "arrays": """
def work():
    arrays = box(12)
    begun.set()
    while True:
        tetstream.simplify(*arrays, ratio=0.1)
""",
    "progress": """
def work():
    arrays = box(12)
    begun.set()
    while True:
        tetstream.simplify(*arrays, ratio=0.1, progress=lambda p: sum(range(1000)))
""",
    "generator": """
def batches():
    yield dict(points=POINTS, fields={"p": [0., 1., 2., 3.]}, cells=CELLS)

def work():
    begun.set()
    while True:
        tetstream.info(tetstream.Reader.batches(batches(), fields={"p": "float64"}))
""",
    "failures": """
def work():
    begun.set()
    while True:
        try:
            tetstream.info("nowhere.vtu")
        except OSError:
            pass
""",
    "sleeping callback": """
def batches():
    begun.set()
    while True:
        time.sleep(0.01)
        yield dict(points=POINTS, fields={"p": [0., 1., 2., 3.]}, cells=CELLS)

def work():
    tetstream.info(tetstream.Reader.batches(batches(), fields={"p": "float64"}))
""",
}


class Daemons(unittest.TestCase):
    def test_a_program_ends_while_one_is_in_the_library(self):
        for name, work in WORK.items():
            for _ in range(1 if SLOW else 3):
                done = subprocess.run([sys.executable, "-c", BEGIN + work + END], text=True,
                                      capture_output=True, timeout=60, check=False)
                with self.subTest(name):
                    self.assertEqual((done.returncode, done.stdout), (0, "the end\n"), done.stderr)


if __name__ == "__main__":
    unittest.main()
