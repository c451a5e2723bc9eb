"""A thousand calls take no more memory than some: nothing is left behind, whether they succeed or
fail."""
import gc
import unittest
import weakref

from meshes import box, halves

import tetstream

ROUNDS = 1000
WARM = 300
ALLOWED = 256 * 1024  # bytes; one array of the result is 3 kB, a thousand of them 3 MB


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096


class Leaks(unittest.TestCase):
    def flat(self, work):
        for i in range(ROUNDS):
            work()
            if i == WARM:
                gc.collect()
                before = resident()
        gc.collect()
        self.assertLess(resident() - before, ALLOWED)

    def test_calls_that_succeed(self):
        points, cells, field = box(2)
        labels = halves(points, cells)

        def work():
            tetstream.simplify(points, cells, {"f": field}, regions=labels, ratio=0.5,
                               vertex_map=True, progress=lambda p: None)
        self.flat(work)

    def test_calls_that_fail(self):
        points, cells, field = box(2)
        wrong = cells.copy()
        wrong[-1, 0] = -1

        def work():
            for arguments, more in (((points, wrong), {}),
                                    ((points, cells), dict(progress=lambda p: 1 / 0)),
                                    ((points, cells), dict(weights={"nowhere": 1})),
                                    ((points, cells[:, :3]), {})):
                try:
                    tetstream.simplify(*arguments, {"f": field}, ratio=0.5, **more)
                except (ValueError, ZeroDivisionError):
                    continue
                self.fail("that should not have gone well")
        self.flat(work)

    def test_streams(self):
        points, cells, field = box(2)

        def work():
            batches = iter([dict(points=points, cells=cells, fields={"f": field})])
            taken = []
            tetstream.simplify_file(
                tetstream.Reader.batches(batches, fields={"f": "f8"}, indexed=True),
                tetstream.Writer.batches(taken.append), ratio=0.5)
            memory = tetstream.Writer.memory("tets")
            tetstream.convert(tetstream.Reader.generate("ball", 40), memory)
            tetstream.info(tetstream.Reader.memory(memory.getbytes(), "tets"))
        self.flat(work)

    def test_owners_of_readers_and_writers(self):
        mesh = dict(zip(("points", "cells"), box(2)))

        class Owner:
            def __init__(self, fails):
                self.fails = fails
                self.reader = tetstream.Reader.batches(self.give(), indexed=True)
                self.writer = tetstream.Writer.batches(self.put, self.open, self.finish)

            def give(self):
                yield mesh
                1 / (not self.fails)

            def put(self, batch):
                pass

            open = put

            def finish(self):
                pass

        def seen(runs, fails):
            owner = Owner(fails)
            try:
                if runs:
                    tetstream.convert(owner.reader, owner.writer)
                self.assertFalse(fails)
            except ZeroDivisionError:
                self.assertTrue(fails)
            return weakref.ref(owner)

        for runs, fails in ((True, False), (True, True), (False, False)):
            owner = seen(runs, fails)
            gc.collect()
            self.assertIsNone(owner(), (runs, fails))


if __name__ == "__main__":
    unittest.main()
