"""A bar of the real tqdm's, as a user sees it. (How it is called: exchange_test.py, on a stand-in.)"""
import contextlib
import io
import unittest

import tetstream


class Bars(unittest.TestCase):
    def drawn(self, work):
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            work()
        return shown.getvalue()

    def test_a_bar_names_the_phase_and_is_full_at_the_end(self):
        mesh = tetstream.read(tetstream.Reader.generate("ball", 20000))
        told = self.drawn(lambda: mesh.simplify(ratio=0.1, progress=True))
        last = told.rstrip().split("\r")[-1]
        self.assertRegex(last, r"^simplify: *100 %")
        self.assertIn("|", last)

    def test_what_is_of_unknown_length_is_counted(self):
        mesh = tetstream.read(tetstream.Reader.generate("ball", 3000))
        batches = iter([dict(points=mesh.points, cells=mesh.cells)])
        source = tetstream.Reader.batches(batches, points=mesh.points.dtype)
        told = self.drawn(lambda: tetstream.info(source, progress=True))
        self.assertRegex(told, r"100 %")


if __name__ == "__main__":
    unittest.main()
