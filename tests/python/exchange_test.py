"""Hand-over to and from pyvista, and bars of tqdm: with stand-ins for both (standins/)."""
import os
import subprocess
import sys
import unittest

import numpy
from meshes import box, halves

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "standins"))

import pyvista  # noqa: E402
from tqdm import auto as tqdm  # noqa: E402

import tetstream  # noqa: E402


class Pyvista(unittest.TestCase):
    def test_there_and_back(self):
        points, cells, field = box(4)
        mesh = tetstream.Mesh(points, cells, {"f": field, "v": points},
                              {"part": halves(points, cells)})
        grid = tetstream.to_pyvista(mesh)
        self.assertEqual(set(grid.celltypes), {10})
        self.assertEqual(set(grid.cells[::5]), {4})
        back = tetstream.from_pyvista(grid)
        numpy.testing.assert_array_equal(back.cells, cells)
        numpy.testing.assert_array_equal(back.points, points)
        self.assertEqual((list(back.fields), list(back.cell_data)), (["f", "v"], ["part"]))
        small = back.simplify(ratio=0.3, regions="part").to_pyvista()
        self.assertLessEqual(len(small.celltypes), 0.3 * len(cells))
        self.assertEqual(set(small.cell_data["part"]), {3, 8})

    def test_the_time_goes_there_and_back(self):
        points, cells, _ = box(2)
        grid = tetstream.Mesh(points, cells, time=0.5).to_pyvista()
        self.assertEqual(list(grid.field_data["TimeValue"]), [0.5])
        self.assertEqual(tetstream.from_pyvista(grid).time, 0.5)
        for other in ([0.5, 1.5], ["noon"], [numpy.nan], []):
            grid.field_data["TimeValue"] = numpy.array(other)
            self.assertIsNone(tetstream.from_pyvista(grid).time)
        self.assertEqual(tetstream.Mesh(points, cells).to_pyvista().field_data, {})

    def test_other_cells_are_refused(self):
        grid = pyvista.UnstructuredGrid(numpy.array([8, *range(8)]), numpy.array([12], numpy.uint8),
                                        numpy.zeros((8, 3)))
        with self.assertRaisesRegex(tetstream.Unsupported, "type 12"):
            tetstream.from_pyvista(grid)


class Bars(unittest.TestCase):
    def test_a_bar_is_filled_and_closed(self):
        points, cells, field = box(8)
        tetstream.simplify(points, cells, {"f": field}, ratio=0.1, progress=True)
        bar = tqdm.bars[-1]
        self.assertEqual((bar.n, bar.seen[-1], bar.closed), (1.0, 1.0, True))
        self.assertEqual(bar.seen, sorted(bar.seen))
        self.assertIn("simplify", bar.phases)

    def test_a_bar_is_closed_after_a_failure(self):
        with self.assertRaises(tetstream.BadData):
            tetstream.simplify([[0, 0, 0]], [[0, 0, 0, 1]], ratio=0.1, progress=True)
        self.assertTrue(tqdm.bars[-1].closed)

    def test_without_a_count_cells_are_shown(self):
        points, cells, field = box(8)
        batches = iter([dict(points=points, cells=cells, fields={"f": field})])
        source = tetstream.Reader.batches(batches, fields={"f": "f8"})
        tetstream.info(source, progress=True)
        self.assertTrue(any(isinstance(phase, dict) for phase in tqdm.bars[-1].phases))


class Missing(unittest.TestCase):
    def test_nothing_optional_is_imported_before_it_is_needed(self):
        program = ("import sys, tetstream\n"
                   "assert not {'tqdm', 'pyvista', 'meshio', 'matplotlib', 'scipy'} & set(sys.modules)\n"
                   "sys.modules['tqdm'] = sys.modules['tqdm.auto'] = None\n"
                   "try: tetstream.read(tetstream.Reader.generate('ball', 50), progress=True)\n"
                   "except ImportError as error: assert 'not installed' in str(error)\n"
                   "else: raise SystemExit('no ImportError')\n")
        subprocess.run([sys.executable, "-c", program], check=True)


if __name__ == "__main__":
    unittest.main()
