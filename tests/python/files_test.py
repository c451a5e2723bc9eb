"""Files: the same bytes as the command's, and the same arrays."""
import errno
import os
import pathlib
import pickle
import tempfile
import unittest

import numpy
from meshes import SLOW, box, command, write_vtu

import tetstream


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.points, self.cells, self.field = box(5 if SLOW else 9)
        write_vtu(self.path("in.vtu"), self.points, self.cells, {"f": self.field})

    def path(self, name):
        return self.folder / name

    def same_bytes(self, a, b):
        self.assertEqual(self.path(a).read_bytes(), self.path(b).read_bytes())

    def test_a_file_has_the_bytes_of_the_command(self):
        for more, flags in (({}, ()), (dict(boundary_weight=3, axis="y"), ("--boundary-weight", 3,
                                                                         "--axis", "y")),
                            (dict(memory="8M", mode="paper"), ("--memory", "8M", "--mode", "paper"))):
            with self.subTest(more):
                command("simplify", self.path("in.vtu"), self.path("command.tets"), "--ratio", 0.1,
                        *flags)
                report = tetstream.simplify_file(self.path("in.vtu"), self.path("python.tets"),
                                                 ratio=0.1, **more)
                self.same_bytes("command.tets", "python.tets")
                self.assertEqual(report.cells_out, tetstream.info(self.path("python.tets")).cell_count)

    def test_arrays_have_the_bytes_of_the_command(self):
        command("simplify", self.path("in.vtu"), self.path("command.tets"), "--ratio", 0.1)
        mesh = tetstream.Mesh(self.points, self.cells, {"f": self.field})
        tetstream.simplify_file(mesh, self.path("python.tets"), ratio=0.1)
        self.same_bytes("command.tets", "python.tets")
        result = tetstream.simplify(self.points, self.cells, {"f": self.field}, ratio=0.1)
        theirs = tetstream.read(self.path("command.tets"))
        self.assertEqual(result.points.tobytes(), theirs.points.tobytes())
        self.assertEqual(result.cells.tobytes(), theirs.cells.tobytes())
        self.assertEqual(result.fields["f"].tobytes(), theirs.fields["f"].tobytes())

    def test_maps_and_logs_have_the_bytes_of_the_command(self):
        command("simplify", self.path("in.vtu"), self.path("a.tets"), "--ratio", 0.1,
                "--map", self.path("a.tetmap"), "--collapse-log", self.path("a.tetlog"))
        tetstream.simplify_file(str(self.path("in.vtu")), str(self.path("b.tets")), ratio=0.1,
                                map_file=self.path("b.tetmap"), log_file=self.path("b.tetlog"))
        for kind in ("tets", "tetmap", "tetlog"):
            self.same_bytes("a." + kind, "b." + kind)

    def test_options_of_the_reading_count_where_a_file_is_opened(self):
        path = self.path("cube.vtk")
        path.write_text("# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                        "POINTS 8 double\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n"
                        "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n")
        with self.assertRaisesRegex(tetstream.Unsupported, "split"):
            tetstream.read(path)
        mesh = tetstream.read(path, split="yes")
        self.assertIn(len(mesh.cells), (5, 6))
        many, out = dict(split="yes"), self.path("out.tets")
        self.assertEqual(tetstream.info(path, **many).cell_count, len(mesh.cells))
        self.assertEqual(tetstream.diagram(path, **many).cell_count, len(mesh.cells))
        self.assertEqual(tetstream.simplify_file(path, out, cells=5, **many).cells_in,
                         len(mesh.cells))
        tetstream.convert(path, out, **many)
        tetstream.layout(path, out, **many)
        self.assertEqual(tetstream.compare(path, out, **many).simplified.cells, len(mesh.cells))
        for reader in (tetstream.Reader.file(path, **many),
                       tetstream.Reader.memory(path.read_bytes(), "vtk", **many)):
            self.assertEqual(tetstream.info(reader).cell_count, len(mesh.cells))
        for option in (dict(step="7"), dict(recover="yes")):
            with self.assertRaises(tetstream.Unsupported):
                tetstream.read(path, **many, **option)
            for source in (mesh, tetstream.Reader.mesh(mesh)):
                with self.assertRaisesRegex(tetstream.BadArgument, next(iter(option))):
                    tetstream.info(source, **option)
            with self.assertRaises(tetstream.BadArgument):
                tetstream.simplify(mesh.points, mesh.cells, cells=5, **option)
            with self.assertRaises(tetstream.BadArgument):
                next(tetstream.simplify_batches([], cells=5, **option))

    def test_what_a_result_does_not_take_is_for_the_original_alone(self):
        mesh = tetstream.Mesh(self.points, self.cells, {"f": self.field})
        mesh.write(self.path("steps.exo"))
        tetstream.convert(mesh, self.path("result.tets"))
        for result in (self.path("result.tets"), mesh):
            found = tetstream.compare(self.path("steps.exo"), result, step="0",
                                      cells_to_points="yes")
            self.assertLess(found.fields["f"].largest_percent, 1e-5)
        found = tetstream.compare(self.path("result.tets"), self.path("steps.exo"), recover="yes")
        self.assertLess(found.fields["f"].largest_percent, 1e-5)

    def test_names_that_are_not_utf8_go_through(self):
        named = self.path("named.vtk")
        tetstream.Mesh(self.points, self.cells, {"NAME": self.field}).write(named)
        named.write_bytes(named.read_bytes().replace(b"NAME", b"N\xe9e."))
        mesh = tetstream.read(named)
        self.assertEqual(list(mesh.fields), ["N\udce9e."])  # as Python has such names of files
        small = mesh.simplify(ratio=0.5, weights={"N\udce9e.": 1})
        small.write(self.path("small.vtk"))
        self.assertEqual(list(tetstream.read(self.path("small.vtk")).fields), ["N\udce9e."])
        with self.assertRaisesRegex(tetstream.BadArgument, "the stream has: N\udce9e\\."):
            mesh.simplify(ratio=0.5, weights={"other": 1})
        with self.assertRaisesRegex(tetstream.InputOutput, "no\udce9.vtk: cannot open"):
            tetstream.read(os.fsencode(self.folder) + b"/no\xe9.vtk")

    def test_weights_are_those_of_the_command(self):
        command("simplify", self.path("in.vtu"), self.path("a.tets"), "--ratio", 0.1,
                "--field", "f:3")
        tetstream.simplify_file(self.path("in.vtu"), self.path("b.tets"), ratio=0.1,
                                weights={"f": 3})
        self.same_bytes("a.tets", "b.tets")

    def test_a_layout_has_the_bytes_of_the_command(self):
        command("layout", self.path("in.vtu"), self.path("a.tets"), "--order", "hilbert")
        report = tetstream.layout(self.path("in.vtu"), self.path("b.tets"), order="hilbert")
        self.same_bytes("a.tets", "b.tets")
        self.assertEqual(report.cells, len(self.cells))
        self.assertIn("hilbert", report.order)

    def test_a_mesh_that_is_written_keeps_its_order(self):
        result = tetstream.simplify(self.points, self.cells, {"f": self.field}, ratio=0.1)
        for name in ("out.tets", "out.svb"):
            result.write(self.path(name))
        again = tetstream.read(self.path("out.tets"))
        numpy.testing.assert_array_equal(again.cells, result.cells)
        numpy.testing.assert_array_equal(again.points, result.points)
        self.assertIn("float32", " ".join(result.write(self.path("out.svb"))))
        self.assertGreater(tetstream.info(self.path("out.tets")).front_width, 0)

    def test_fields_of_integers_are_written(self):
        points, cells, _ = box(2)
        for kind in (numpy.int32, numpy.int64, numpy.uint8):
            values = numpy.arange(len(points)).astype(kind)
            path = self.folder / "integers.tets"
            tetstream.Mesh(points, cells, {"i": values}).write(path)
            back = tetstream.read(path)
            order = numpy.lexsort(points.T)
            numpy.testing.assert_array_equal(back.points[numpy.lexsort(back.points.T)],
                                             points[order])
            numpy.testing.assert_array_equal(back.fields["i"][numpy.lexsort(back.points.T)],
                                             values[order])

    def test_properties_of_a_format(self):
        for compress in ("yes", "no"):
            tetstream.convert(self.path("in.vtu"),
                              tetstream.Writer.file(self.path(compress + ".tets"), compress=compress))
        if "no zstd" not in tetstream.core.version_text():
            self.assertLess(os.path.getsize(self.path("yes.tets")),
                            os.path.getsize(self.path("no.tets")))
        with self.assertRaisesRegex(tetstream.BadArgument, "no property"):
            tetstream.Writer.file(self.path("a.tets"), colour="red")

    def test_names_of_files_may_be_any(self):
        for name in ("grün.tets", os.fsdecode(b"\xff.tets")):
            tetstream.convert(self.path("in.vtu"), self.path(name))
            self.assertEqual(tetstream.info(os.fsencode(self.path(name))).cell_count,
                             len(self.cells))

    def test_a_file_that_is_not_there_is_pythons_error(self):
        missing, mesh = self.path("nowhere.tets"), tetstream.Mesh(self.points, self.cells)
        for read in (tetstream.read, tetstream.Reader.file, lambda path: tetstream.compare(mesh, path),
                     lambda path: tetstream.simplify_file(path, self.path("out.tets"), ratio=0.5)):
            with self.assertRaisesRegex(FileNotFoundError, "nowhere.tets: cannot open") as caught:
                read(missing)
            self.assertIsInstance(caught.exception, tetstream.InputOutput)
            self.assertEqual((caught.exception.errno, caught.exception.filename, caught.exception.status),
                             (errno.ENOENT, str(missing), -5))
        copied = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((str(copied), copied.filename), (str(caught.exception), str(missing)))
        self.assertEqual(str(tetstream.NoSuchFile("not there")), "not there")  # of a caller's own
        with self.assertRaises(tetstream.InputOutput) as caught:
            tetstream.Reader.file(self.folder, "tets")
        self.assertNotIsInstance(caught.exception, FileNotFoundError)

    def test_failures_are_those_of_python(self):
        with self.assertRaisesRegex(OSError, "nowhere.tets"):
            tetstream.read(self.path("nowhere.tets"))
        with self.assertRaisesRegex(tetstream.Unsupported, "xyz"):
            tetstream.read(self.path("in.xyz"))
        self.path("bad.tets").write_bytes(b"nothing of the kind" * 20)
        with self.assertRaises(tetstream.BadData):
            tetstream.read(self.path("bad.tets"))
        with self.assertRaisesRegex(TypeError, "a path, a Mesh or a Reader"):
            tetstream.read(3)
        with self.assertRaisesRegex(TypeError, "a path or a Writer"):
            tetstream.convert(self.path("in.vtu"), 3)
        with self.assertRaisesRegex(TypeError, "a target is missing"):
            tetstream.simplify_file(self.path("in.vtu"), self.path("out.tets"))
        self.assertFalse(self.path("out.tets").exists())


if __name__ == "__main__":
    unittest.main()
