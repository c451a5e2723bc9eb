"""Generators and functions as readers and writers; what they raise; interruption; threads."""
import os
import signal
import tempfile
import threading
import time
import traceback
import unittest

import numpy
from meshes import SLOW, box

import tetstream
from tetstream import Batch, Reader, Writer


def in_batches(points, cells, fields, step=100):
    """The mesh as a stream; a point comes with the batch that uses it first."""
    begun = 0
    uses = numpy.zeros(cells.size, bool)
    uses[cells.size - 1 - numpy.unique(cells.ravel()[::-1], return_index=True)[1]] = True
    uses = uses.reshape(cells.shape)
    for first in range(0, len(cells), step):
        part = slice(first, first + step)
        end = max(begun, cells[part].max() + 1)
        yield Batch(points[begun:end], cells[part],
                    {name: values[begun:end] for name, values in fields.items()},
                    last_uses=numpy.packbits(uses[part], axis=1, bitorder="little").ravel())
        begun = end


def reader(points, cells, field, step=100):
    return Reader.batches(in_batches(points, cells, {"f": field}, step), points.dtype,
                          {"f": field.dtype}, vertex_count=len(points), cell_count=len(cells))


class Generators(unittest.TestCase):
    def setUp(self):
        self.mesh = box(4 if SLOW else 6)

    def simplified(self, source):
        writer = Writer.arrays()
        tetstream.simplify_file(source, writer, ratio=0.2)
        return writer.getmesh()

    def same(self, a, b):
        numpy.testing.assert_array_equal(a.points, b.points)
        numpy.testing.assert_array_equal(a.cells, b.cells)
        numpy.testing.assert_array_equal(a.fields["f"], b.fields["f"])

    def test_batches_of_any_size_give_the_same_mesh(self):
        expected = self.simplified(reader(*self.mesh))
        self.assertLessEqual(len(expected.cells), len(self.mesh[1]) // 5)
        for step in (1, 7, 100000):
            self.same(self.simplified(reader(*self.mesh, step)), expected)

    def test_a_reader_may_tell_its_box_and_ranges(self):
        points, cells, field = self.mesh
        told = {"box": [points.min(0), points.max(0)], "ranges": {"f": [field.min(), field.max()]}}

        def announced(**more):
            return Reader.batches(in_batches(points, cells, {"f": field}), points.dtype,
                                  {"f": field.dtype}, cell_count=len(cells), **more)

        info = announced(**told).info()
        numpy.testing.assert_array_equal(info.box, told["box"])
        numpy.testing.assert_array_equal(info.ranges["f"].ravel(), told["ranges"]["f"])
        self.assertIsNone(announced().info().box)
        announced(box=announced().info().box, ranges=announced().info().ranges)
        more = tetstream.Mesh(numpy.concatenate([points, [[9, 9, 9]]]).astype(points.dtype), cells,
                              {"f": numpy.append(field, -9999).astype(field.dtype)})
        whole = Reader.stream(more).info()
        numpy.testing.assert_array_equal(whole.box, told["box"])
        numpy.testing.assert_array_equal(whole.ranges["f"].ravel(), told["ranges"]["f"])
        self.assertIsNone(Reader.stream(tetstream.Mesh(points, cells[:0], {"f": field})).info().box)
        self.same(self.simplified(announced(**told)), self.simplified(announced()))
        pushed = tetstream.simplify_batches(in_batches(points, cells, {"f": field}), points.dtype,
                                            {"f": field.dtype}, ratio=0.2, **told)
        self.assertGreater(sum(len(batch.cells) for batch in pushed if batch.cells is not None), 0)
        for wrong, text in (({"box": told["box"]}, 'that of "f" is missing'),
                            ({"ranges": told["ranges"]}, "beside a box"),
                            ({**told, "ranges": {**told["ranges"], "g": [0, 1]}}, '"g" is no field'),
                            ({**told, "box": [0, 1]}, r"\[2\]\[3\] is wanted"),
                            ({**told, "box": [points.max(0), points.min(0)]}, "upside down")):
            with self.assertRaisesRegex(tetstream.BadArgument, text):
                self.simplified(announced(**wrong))

    def test_a_reader_may_give_dicts_and_empty_batches(self):
        points, cells, field = self.mesh
        def give():
            yield {}
            yield dict(points=points, fields={"f": field})
            yield Batch()
            yield dict(cells=cells.tolist())
        source = Reader.batches(give(), fields={"f": None}, indexed=True)
        self.same(self.simplified(source), tetstream.simplify(points, cells, {"f": field}, ratio=0.2))

    def test_labelled_faces_may_come_in_batches_of_their_own(self):
        points = numpy.eye(4, 3, -1)
        faces = dict(faces=numpy.array([[0, 1, 2], [1, 2, 3]], "i4"), face_labels=[7, 8])
        for parts in ([dict(points=points), faces, dict(cells=[[0, 1, 2, 3]])],
                      [dict(points=points, cells=[[0, 1, 2, 3]]), faces]):
            taken = []
            source = Reader.batches((dict(part) for part in parts), indexed=True)
            tetstream.convert(source, Writer.batches(taken.append))
            labels = {tuple(sorted(map(tuple, points[face]))): label for batch in taken
                      if batch.faces is not None
                      for face, label in zip(batch.faces, batch.face_labels)}
            self.assertEqual(sorted(labels.values()), [7, 8])

    def test_a_writer_may_be_a_function_or_a_generator(self):
        expected = self.simplified(reader(*self.mesh))
        taken, told = [], []
        report = tetstream.simplify_file(
            reader(*self.mesh), Writer.batches(taken.append, told.append, lambda: told.append(1)),
            ratio=0.2)
        self.assertEqual([info.fields for info in told[:-1]], [{"f": (numpy.dtype("f8"), 1)}])
        self.assertEqual(told[-1], 1)
        self.assertEqual(sum(len(batch.cells) for batch in taken), report.cells_out)

        def collect():
            while True:
                sent.append((yield))
        sent = []
        tetstream.simplify_file(reader(*self.mesh), Writer.batches(collect()), ratio=0.2)
        for batches in (taken, sent):
            numpy.testing.assert_array_equal(numpy.concatenate([b.points for b in batches]),
                                             expected.points)
            numpy.testing.assert_array_equal(numpy.concatenate([b.cells for b in batches]),
                                             expected.cells)
            numpy.testing.assert_array_equal(
                numpy.concatenate([b.fields["f"] for b in batches]), expected.fields["f"])

    def test_a_stream_goes_through_a_generator(self):
        stream, taken, given, report = [], [], 0, None
        tetstream.convert(Reader.generate("fluid", 50000 if SLOW else 100000),
                          Writer.batches(stream.append))
        count = sum(len(batch.cells) for batch in stream)

        def solver():
            nonlocal given
            for batch in stream:
                given += 1
                yield batch

        def follow():
            nonlocal report
            report = yield from tetstream.simplify_batches(
                solver(), "float32", {"density": "f4", "velocity": ("f4", 3)}, ratio=0.2,
                window=8000, cell_count=count)

        early = None
        for batch in follow():
            taken.append(batch)
            early = early or given
        self.assertLess(early, given)  # output comes while the input runs
        self.assertEqual(report.cells_out, sum(len(batch.cells) for batch in taken))
        self.assertLessEqual(report.cells_out, count // 5)

    def test_a_simplified_mesh_can_be_read_as_a_stream(self):
        points, cells, field = self.mesh
        result = tetstream.simplify(points, cells, {"f": field}, ratio=0.2)
        memory = Writer.memory("tets")
        tetstream.convert(Reader.stream(result), memory)
        again = tetstream.read(Reader.memory(memory.getbytes(), "tets"))
        self.same(again, result)

    def test_labelled_faces_and_locked_edges_go_along(self):
        points, cells, field = self.mesh
        bottom = points[:, 2] == 0
        faces = numpy.array([[p for p in cell if bottom[p]] for cell in cells
                             if bottom[cell].sum() == 3])
        edge = [[p for p in face if points[p, 0] == 0] for face in faces]
        edge = [pair for pair in edge if len(pair) == 2]
        mesh = tetstream.Mesh(points, cells, {"f": field}, faces=faces,
                              face_labels=numpy.full(len(faces), 7), locked_edges=edge,
                              locked_faces=numpy.arange(len(faces)) < 2)
        self.assertEqual(Reader.stream(mesh).info().face_count, len(faces))
        found = tetstream.info(mesh)
        self.assertEqual((found.face_count, found.face_labels), (len(faces), {7: len(faces)}))
        result = self.simplified(Reader.stream(mesh))
        self.assertLess(len(result.cells), 0.5 * len(cells))
        self.assertEqual(set(result.face_labels), {7})
        numpy.testing.assert_allclose(result.points[result.faces][..., 2], 0, atol=1e-4)
        kept = {tuple(p) for p in result.points}
        self.assertLessEqual({tuple(p) for p in points[numpy.array(edge)].reshape(-1, 3)}, kept)
        self.assertLessEqual({tuple(p) for p in points[faces[:2]].reshape(-1, 3)}, kept)

    def test_what_was_announced_must_come(self):
        points, cells, field = self.mesh
        cases = {
            "float64, float32 was announced": (dict(points=points), "float32", {}),
            '"f" was announced': (dict(points=points), "float64", {"f": "f8"}),
            '"g" was not announced': (dict(points=points, fields={"g": field}), "float64", {}),
            "1 numbers in a row, 3": (dict(points=points, fields={"f": field}), "float64",
                                      {"f": ("f8", 3)}),
            "not int": (3, "float64", {}),
            "cells: .*4": (dict(points=points, cells=cells[:, :3]), "float64", {}),
            "last_uses: the shape": (dict(points=points, cells=cells, last_uses=[1]), "float64", {}),
            r"last_uses: the shape is \[1\], \[0\]": (dict(last_uses=[1]), "float64", {}),
            r"locked: the shape is \[1\], \[0\]": (dict(cells=cells, locked=[True]), "float64", {}),
            '"f" has rows, and the batch has no points': (dict(fields={"f": [1]}), "float64",
                                                         {"f": "f8"}),
            '"d" has rows, and the batch has no cells': (dict(points=points, cell_data={"d": [1]}),
                                                        "float64", {}),
            "face_labels and locked_faces": (dict(face_labels=[1]), "float64", {}),
            "locked_faces are of": (dict(points=points, locked_faces=[True]), "float64", {}),
            "from 0 to 15": (dict(points=points, cells=cells[:1], last_uses=[16]), "float64", {}),
        }
        for sentence, (batch, kind, fields) in cases.items():
            with self.subTest(sentence), self.assertRaisesRegex((TypeError, ValueError), sentence):
                self.simplified(Reader.batches(iter([batch]), kind, fields))

    def test_what_takes_batches_takes_all(self):
        def first_only():
            yield

        with self.assertRaisesRegex(RuntimeError, "ended before they did"):
            tetstream.convert(reader(*self.mesh), Writer.batches(first_only()))
        with self.assertRaisesRegex(TypeError, "a function or a generator is wanted, not NoneType"):
            Writer.batches(None)

    def test_arrays_are_given_each_time(self):
        writer = Writer.arrays()
        with self.assertRaisesRegex(tetstream.BadState, "no stream"):
            writer.getmesh()
        tetstream.convert(reader(*self.mesh), writer)
        self.assertEqual(len(writer.getmesh().cells), len(self.mesh[1]))
        self.assertIs(writer.getmesh(), writer.getmesh())
        with self.assertRaisesRegex(tetstream.BadState, "does not write to arrays"):
            Writer.memory("tets").getmesh()
        with self.assertRaisesRegex(tetstream.BadState, "does not write to memory"):
            writer.getbytes()

    def test_a_mesh_that_is_not_complete_is_not_given(self):
        for fails in (False, True):
            writer, asked = Writer.arrays(), []

            def follow():
                for batch in in_batches(self.mesh[0], self.mesh[1], {"f": self.mesh[2]}):
                    yield batch
                    with self.assertRaisesRegex(tetstream.BadState, "not complete|no stream"):
                        writer.getmesh()
                    asked.append(len(batch.cells))
                    if fails and len(asked) == 5:
                        1 / 0

            try:
                tetstream.convert(Reader.batches(follow(), fields={"f": "f8"}), writer)
                self.assertFalse(fails)
            except ZeroDivisionError:
                with self.assertRaisesRegex(tetstream.BadState, "not complete"):
                    writer.getmesh()
                continue
            self.assertGreater(len(asked), 5)
            numpy.testing.assert_array_equal(writer.getmesh().cells, self.mesh[1])

    def test_a_reader_serves_one_run(self):
        source = reader(*self.mesh)
        self.simplified(source)
        with self.assertRaisesRegex(tetstream.BadState, "reader"):
            self.simplified(source)


class Raised(unittest.TestCase):
    """What a callback raises comes out, with the place where it was raised."""

    def raised(self, work):
        frames = []  # note: assertRaises would clear the traceback
        try:
            work()
        except ZeroDivisionError as error:
            frames = [frame.name for frame in traceback.extract_tb(error.__traceback__)]
        self.assertTrue(frames, "nothing was raised")
        self.assertEqual(frames[-1], "faulty")
        self.assertIn("work", frames)

    def test_by_a_reader(self):
        mesh = box(5)

        def faulty(after):
            for i, batch in enumerate(in_batches(mesh[0], mesh[1], {"f": mesh[2]})):
                if i == after:
                    1 / 0
                yield batch

        for after in (0, 3):
            def work(after=after):
                tetstream.simplify_file(Reader.batches(faulty(after), fields={"f": "f8"}),
                                        Writer.arrays(), ratio=0.2)
            self.raised(work)

    def test_by_a_writer(self):
        def faulty(*_):
            1 / 0
        for part in ("put", "open", "finish"):
            def work(part=part):
                functions = {"put": lambda batch: None, part: faulty}
                tetstream.simplify_file(reader(*box(5)), Writer.batches(**functions), ratio=0.2)
            with self.subTest(part):
                self.raised(work)

    def test_by_progress(self):
        def faulty(progress):
            if progress.phase != "order":
                1 / 0
        points, cells, field = box(5)

        def work():
            tetstream.simplify(points, cells, {"f": field}, ratio=0.2, progress=faulty)
        self.raised(work)
        def work():
            tetstream.read(Reader.generate("fluid", 1000), progress=faulty)
        self.raised(work)

    def test_also_where_one_run_is_inside_another(self):
        points, cells, field = box(4)
        inner = []

        def faulty(_):
            1 / 0

        def nested(_):
            try:
                tetstream.simplify(points, cells, {"f": field}, ratio=0.5, progress=faulty)
            except ZeroDivisionError as error:
                inner.append(error)

        result = tetstream.simplify(points, cells, {"f": field}, ratio=0.5, progress=nested)
        self.assertTrue(inner)
        self.assertLessEqual(len(result.cells), len(cells) // 2)

    def test_no_file_is_left(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "never.tets")
            with self.assertRaises(ZeroDivisionError):
                tetstream.simplify_file(Reader.generate("fluid", 1000), path, ratio=0.2,
                                        progress=lambda p: 1 / 0)
            self.assertEqual(os.listdir(folder), [])


class Progress(unittest.TestCase):
    def test_it_goes_up_and_names_phases(self):
        points, cells, field = box(8)
        told = []
        tetstream.simplify(points, cells, {"f": field}, ratio=0.2, progress=told.append)
        self.assertEqual([p.phase for p in told][0], "order")
        self.assertIn("simplify", {p.phase for p in told})
        fractions = [p.fraction for p in told]
        self.assertEqual(fractions, sorted(fractions))
        self.assertLessEqual(fractions[-1], 1)
        self.assertEqual(told[-1].cells_total, len(cells))


class Interrupt(unittest.TestCase):
    """Ctrl-C, while the main thread is in the midst of C++."""

    def interrupted(self, work):
        """`work` is given a function of progress. Within a second of this thread's time, however
        busy the machine is."""
        clock = time.pthread_getcpuclockid(threading.get_ident())
        begun, sent = threading.Event(), []

        def press():
            begun.wait()
            time.sleep(0.02)
            sent.append(time.clock_gettime(clock))
            os.kill(os.getpid(), signal.SIGINT)

        def progress(told):
            if told.phase != "order":
                begun.set()

        key = threading.Thread(target=press)
        key.start()
        with self.assertRaises(KeyboardInterrupt):
            work(progress)
            time.sleep(5)  # it was not interrupted: the signal comes here, and far too late
            self.fail("the run came to its end")
        key.join()
        self.assertLess(time.clock_gettime(clock) - sent[0], 1)

    def test_ends_a_stream(self):
        put = []
        self.interrupted(lambda progress: tetstream.simplify_file(
            Reader.generate("fluid", 1e8), Writer.batches(put.append), ratio=0.01,
            progress=progress))
        self.assertLess(sum(len(batch.cells) for batch in put), 1e6)

    def test_ends_the_waiting_for_an_input_that_stalls(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "whole.tets")
            tetstream.convert(Reader.generate("fluid", 20000), path)
            with open(path, "rb") as file:
                begin = file.read(5000)
            for threads in 1, 3:
                end, other = os.pipe()
                os.write(other, begin)
                threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
                given_up = threading.Timer(20, os.close, (other,))
                given_up.start()
                with self.assertRaises(KeyboardInterrupt):
                    tetstream.simplify_file(Reader.file(f"/dev/fd/{end}", "tets"),
                                            os.path.join(folder, "out.tets"), ratio=0.1,
                                            threads=threads)
                given_up.cancel()
                self.assertEqual(os.listdir(folder), ["whole.tets"])
                os.close(end)
                os.close(other)

    def test_ends_an_inspection(self):
        self.interrupted(
            lambda progress: tetstream.info(Reader.generate("fluid", 1e9), progress=progress))

    def test_ends_a_run_on_arrays(self):
        mesh = tetstream.read(Reader.generate("fluid", 5e5))
        ended = []

        def work(progress):
            mesh.simplify(ratio=0.01, progress=progress)
            ended.append(True)

        self.interrupted(work)
        self.assertEqual(ended, [])


class Threads(unittest.TestCase):
    def test_two_at_once_give_what_one_gives(self):
        points, cells, field = box(10)
        expected = tetstream.simplify(points, cells, {"f": field}, ratio=0.1)
        results, ticks = [None, None], [0, 0]

        def work(i):
            def tick(_):
                ticks[i] += 1
            results[i] = tetstream.simplify(points, cells, {"f": field}, ratio=0.1, progress=tick)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            numpy.testing.assert_array_equal(result.cells, expected.cells)
            numpy.testing.assert_array_equal(result.points, expected.points)
        self.assertTrue(all(ticks))

    def test_others_run_while_the_library_works(self):
        done, counted = threading.Event(), 0

        def work():
            tetstream.info(Reader.generate("fluid", 300000))
            done.set()

        thread = threading.Thread(target=work)
        longest, last = 0, time.monotonic()
        thread.start()
        while not done.is_set():
            time.sleep(0.001)
            now = time.monotonic()
            counted, longest, last = counted + 1, max(longest, now - last), now
        thread.join()
        self.assertGreater(counted, 3)


if __name__ == "__main__":
    unittest.main()
