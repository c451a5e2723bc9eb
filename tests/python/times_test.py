"""The time of values, wherever a mesh comes from and goes to."""
import pathlib
import tempfile
import unittest

import numpy
from meshes import box, halves

import tetstream
from tetstream import Batch, Reader, Writer


class Times(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.points, self.cells, self.field = box(4)
        self.mesh = tetstream.Mesh(self.points, self.cells, {"f": self.field}, time=1e-3)

    def test_it_goes_from_file_to_file(self):
        first = self.folder / "first.vtu"
        self.mesh.write(first)
        mesh = tetstream.read(first)
        self.assertEqual(mesh.time, 1e-3)
        small = mesh.simplify(ratio=0.5)
        self.assertLess(len(small.cells), len(mesh.cells))
        self.assertEqual(small.time, 1e-3)
        tetstream.simplify_file(small, self.folder / "second.tets", ratio=0.9)
        self.assertEqual(tetstream.info(self.folder / "second.tets").time, 1e-3)

    def test_it_is_known_before_and_after_reading(self):
        for reader in (Reader.mesh, Reader.stream):
            self.assertEqual(reader(self.mesh).info().time, 1e-3)
        self.assertEqual(tetstream.info(self.mesh).time, 1e-3)
        self.assertIsNone(tetstream.info(Reader.generate("ball", 100)).time)

    def test_arrays_come_back_with_it(self):
        given = self.points, self.cells, {"f": self.field}
        for regions in (None, halves(self.points, self.cells)):
            small = tetstream.simplify(*given, time=0, regions=regions, ratio=0.5)
            self.assertEqual((small.time, type(small.time)), (0, float))
        self.assertIsNone(tetstream.simplify(*given, ratio=0.5).time)

    def test_batches_come_with_it(self):
        told = []
        batch = Batch(self.points, self.cells)
        writer = Writer.batches(lambda batch: None, open=lambda info: told.append(info.time))
        tetstream.convert(Reader.batches([batch], time=numpy.float32(0.5)), writer)
        self.assertEqual(told, [0.5])
        with self.assertRaisesRegex(tetstream.BadArgument, "the time is not finite"):
            list(tetstream.simplify_batches([batch], time=numpy.inf, ratio=0.5))

    def test_others_are_refused(self):
        for time in ("noon", "1", b"1", [1.0, 2.0], 2j, numpy.complex128(1), True):
            self.mesh.time = time
            with self.assertRaisesRegex(TypeError, "time: a number is wanted, not "):
                tetstream.info(self.mesh)
        for time, says in ((numpy.nan, "the time is not finite"),
                           (10 ** 400, "time: the number is too large")):
            self.mesh.time = time
            with self.assertRaisesRegex(tetstream.BadArgument, says):
                tetstream.info(self.mesh)


if __name__ == "__main__":
    unittest.main()
