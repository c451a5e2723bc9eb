"""info, compare, diagram, formats, options: figures and pictures."""
import copy
import json
import os
import pickle
import tempfile
import unittest

import numpy
from meshes import SLOW, box, halves

import tetstream


# By default the points on boundaries take most of a slow run, and a cut's pixels most of the rest.
CLOSELY = {"boundary_samples": 20000} if SLOW else {}
CUT = {"cut": "auto", "memory": "3M", **CLOSELY} if SLOW else {"cut": "auto"}


class Axes:
    """What plot() needs of an axis of matplotlib's."""

    def __init__(self):
        self.told = {}

    def imshow(self, image, **look):
        self.told["image"], self.told["look"] = image, look

    def __getattr__(self, name):
        return lambda text: self.told.update({name: text})


class Operations(unittest.TestCase):
    def setUp(self):
        self.points, self.cells, self.field = box(4)
        self.mesh = tetstream.Mesh(self.points, self.cells, {"f": self.field, "v": self.points},
                                   {"part": halves(self.points, self.cells)})

    def test_info_of_a_mesh(self):
        info = tetstream.info(self.mesh)
        self.assertEqual((info.cell_count, info.vertex_count), (len(self.cells), len(self.points)))
        self.assertEqual(info.fields, {"f": (numpy.dtype("f8"), 1), "v": (numpy.dtype("f8"), 3)})
        self.assertEqual(info.cell_data, {"part": (numpy.dtype("i8"), 1)})
        numpy.testing.assert_array_equal(info.box, [[0, 0, 0], [1, 1, 2]])
        numpy.testing.assert_array_equal(info.ranges["f"].ravel(),
                                         [self.field.min(), self.field.max()])
        numpy.testing.assert_array_equal(info.ranges["v"], info.box)
        self.assertEqual(info.front.width, info.front_width)
        self.assertLess(25, info.front_width)
        self.assertLess(info.front_width, 75)

    def test_what_is_known_without_reading(self):
        info = tetstream.Reader.generate("fluid+stress", 1000).info()
        self.assertEqual(info.fields["stress"], (numpy.dtype("f4"), 6))

    def test_comparison_with_itself_and_with_less(self):
        same = tetstream.compare(self.mesh, self.mesh, **CLOSELY)
        self.assertEqual(set(same.fields), {"f", "v"})
        self.assertLess(same.fields["f"].rms, 1e-12)
        self.assertEqual(same.topology_kept, 1)
        self.assertAlmostEqual(same.original.volume, 2)
        self.assertEqual((same.only_original, same.only_simplified), ([], []))
        renamed = tetstream.Mesh(self.mesh.points, self.mesh.cells,
                                 {"f": self.mesh.fields["f"], "u": self.mesh.fields["f"]})
        other = tetstream.compare(self.mesh, renamed)
        self.assertEqual((other.only_original, other.only_simplified), (["v"], ["u"]))
        small = self.mesh.simplify(ratio=0.2, regions="part")
        less = tetstream.compare(self.mesh, small, weights={"f": 1}, regions="part", **CLOSELY)
        self.assertEqual(set(less.fields), {"f"})
        self.assertEqual(less.simplified.cells, len(small.cells))
        self.assertLess(0.01, less.fields["f"].rms_percent)
        self.assertLess(less.fields["f"].rms_percent, 5)
        self.assertEqual(set(less.regions), {3, 8})
        self.assertEqual(len(less.distance_place), 3)
        self.assertIn("RMS errors: f", repr(less))

    def test_a_diagram_has_the_figures_of_info(self):
        drawn = tetstream.diagram(self.mesh, columns=100, rows=50)
        info = tetstream.info(self.mesh)
        self.assertEqual(drawn.front_width, info.front_width)
        self.assertEqual(drawn.coverage.shape, (drawn.rows, drawn.columns))
        self.assertEqual(drawn.widths.max(), info.front_width)
        self.assertEqual(drawn.newest.shape, (drawn.columns,))
        axes = Axes()
        self.assertIs(drawn.plot(axes, cmap="Greys"), axes)
        self.assertIs(axes.told["image"], drawn.coverage)
        self.assertEqual(axes.told["look"]["extent"], (0, len(self.cells), len(self.points), 0))
        self.assertEqual((axes.told["look"]["cmap"], axes.told["set_xlabel"]), ("Greys", "cells"))
        self.assertIn(str(info.front_width), axes.told["set_title"])

    def test_pictures(self):
        with tempfile.TemporaryDirectory() as folder:
            drawn = tetstream.diagram(self.mesh)
            compared = tetstream.compare(self.mesh, self.mesh.simplify(ratio=0.2), **CUT)
            for name, picture in (("layout.svg", drawn), ("cut.png", compared)):
                path = os.path.join(folder, name)
                if "no cairo" in tetstream.core.version_text():
                    with self.assertRaisesRegex(tetstream.Unsupported, "cairo"):
                        picture.write(path, "a title")
                else:
                    picture.write(path, "a title")
                    self.assertGreater(os.path.getsize(path), 1000)
            with self.assertRaises(tetstream.Unsupported):
                drawn.write(os.path.join(folder, "layout.gif"))

    def test_figures_can_be_copied_and_pickled(self):
        drawn = tetstream.diagram(self.mesh, columns=100, rows=50)
        compared = tetstream.compare(self.mesh, self.mesh.simplify(ratio=0.2), **CUT)
        self.assertEqual([name for record in (drawn, compared) for name in vars(record)
                          if name.startswith("_")], [])
        shown = json.loads(json.dumps(vars(compared), default=vars))
        self.assertEqual(shown["fields"]["f"]["rms"], compared.fields["f"].rms)
        for copied in (copy.copy, copy.deepcopy, lambda record: pickle.loads(pickle.dumps(record))):
            again = copied(drawn)
            self.assertIs(type(again), tetstream.Diagram)
            numpy.testing.assert_array_equal(again.coverage, drawn.coverage)
            self.assertEqual(copied(compared), compared)
            for record in (again, copied(compared)):
                with self.assertRaisesRegex(tetstream.BadState, "have the figures alone"):
                    record.write("never.svg")

    def test_formats_are_those_of_the_library(self):
        found = {row.name: row for row in tetstream.formats()}
        self.assertTrue(found["tets"].can_read and found["vtu"].can_write)
        self.assertIn("vtu", found["vtu"].extensions)

    def test_options_have_types_defaults_and_a_text(self):
        options = tetstream.Options(ratio=0.25, memory="64M", mode="paper", cells="1e6")
        self.assertEqual((options.ratio, options.memory, options.mode, options.cells),
                         (0.25, 64 * 2 ** 20, "paper", 1000000))
        self.assertEqual(tetstream.Options().boundary_weight, 10)
        natural = tetstream.Options(step=3, split=True, recover=False)
        self.assertEqual((natural.step, natural.split, natural.recover), ("3", "yes", "no"))
        for wrong in (dict(step=1.5), dict(mode=True), dict(cut=3)):
            with self.assertRaises(TypeError):
                tetstream.Options(**wrong)
        options.add_field("p", 2)
        for copied in (copy.copy(options), copy.deepcopy(options),
                       pickle.loads(pickle.dumps(options))):
            self.assertEqual(repr(copied), repr(options))
            copied.ratio = 0.5
            self.assertEqual(options.ratio, 0.25)
        options.seed = -5
        self.assertEqual(options.seed, -5)
        with self.assertRaisesRegex(tetstream.BadArgument, "ratio"):
            options.ratio = 3
        self.assertEqual(options.ratio, 0.25)
        self.assertIn("degrees", tetstream.Options.feature_angle.__doc__)
        self.assertIn("one of: sweep paper queue", tetstream.Options.mode.__doc__)
        for name in ("boundary_weight", "tmpdir", "order"):
            self.assertIn(f"        {name}: ", tetstream.simplify.__doc__)
        for name in ("split", "recover", "step", "join_points", "cells_to_points"):
            self.assertIn(f"        {name}: ", tetstream.simplify_file.__doc__)
            for without_files in (tetstream.simplify, tetstream.simplify_batches):
                self.assertNotIn(f"        {name}: ", without_files.__doc__)
        for needs_a_target in (tetstream.simplify, tetstream.simplify_file,
                               tetstream.simplify_batches):
            self.assertIn("ratio: cells out / cells in; 0: not asked for (",
                          needs_a_target.__doc__)

    def test_options_are_a_mapping_of_what_was_set(self):
        options = tetstream.Options(ratio=0.25, memory="64M", cells=1e3, tmpdir=None,
                                    weights={"f": 2})
        options.boundary_weight = 3
        self.assertEqual(dict(options), {"ratio": 0.25, "memory": 64 * 2 ** 20, "cells": 1000,
                                         "weights": {"f": 2}, "boundary_weight": 3})
        self.assertEqual(repr(tetstream.Options(ratio=0.5)), "Options(ratio=0.5)")
        self.assertEqual(tetstream.Options(**options), options)
        with self.assertRaises(KeyError):
            options["seed"]
        kept = self.mesh.simplify(**tetstream.Options(ratio=0.25, weights={"f": 1}))
        given = self.mesh.simplify(ratio=0.25, weights={"f": 1})
        numpy.testing.assert_array_equal(kept.points, given.points)
        with self.assertRaisesRegex(TypeError, "no option weights; [^?]*$"):
            tetstream.info(self.mesh, **tetstream.Options(weights={"f": 1}))

    def test_labels_of_faces_are_compared(self):
        bottom = [[p for p in cell if self.points[p, 2] == 0] for cell in self.cells
                  if (self.points[cell, 2] == 0).sum() == 3]
        self.mesh.faces, self.mesh.face_labels = bottom, numpy.full(len(bottom), 7)
        found = tetstream.compare(self.mesh, self.mesh.simplify(ratio=0.2), **CLOSELY)
        self.assertEqual(list(found.face_labels), [7])
        self.assertEqual(found.face_labels[7].original_faces, len(bottom))
        self.assertLess(0, found.face_labels[7].simplified_faces)
        self.assertAlmostEqual(found.face_labels[7].simplified_area, 1, places=3)

    def test_progress_of_opening(self):
        mesh = tetstream.read(tetstream.Reader.generate("ball", 1000))
        with tempfile.TemporaryDirectory() as folder:
            for name in ("ball.mesh", "ball.node"):
                path, told = os.path.join(folder, name), []
                if name == "ball.mesh":
                    mesh.write(path)
                else:
                    _write_tetgen(mesh, path)
                tetstream.info(path, progress=told.append)
                self.assertEqual(told[0].phase, "open", name)
                self.assertTrue(0 < told[0].fraction <= 1, told)
                with self.assertRaises(ZeroDivisionError):
                    tetstream.simplify_file(path, os.path.join(folder, "out.tets"), ratio=0.5,
                                            progress=lambda p: 1 / (p.phase != "open"))
            self.assertNotIn("out.tets", " ".join(os.listdir(folder)))

    def test_options_that_do_not_count_are_refused(self):
        mesh = tetstream.read(tetstream.Reader.generate("ball", 100))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "out.tets")
            for call, name in ((lambda: tetstream.convert(mesh, path, ratio=0.5), "ratio"),
                               (lambda: tetstream.info(mesh, samples=5), "samples"),
                               (lambda: mesh.simplify(ratio=0.5, cut="auto"), "cut"),
                               (lambda: tetstream.compare(mesh, mesh, effort="high"), "effort"),
                               (lambda: tetstream.Reader.file(path, order="none"), "order")):
                with self.assertRaisesRegex(TypeError, f"{name} does not count where a mesh is"):
                    call()
            self.assertEqual(os.listdir(folder), [])
        self.assertGreater(tetstream.info(mesh, threads=1, order=None, ratio=None).cell_count, 20)

    def test_statuses_have_their_exceptions(self):
        from tetstream import core, errors
        for number, kind in errors._CLASSES.items():
            name = "".join(word.capitalize() for word in
                           core.status_name(number).replace("TETSTREAM_", "").split("_"))
            self.assertIn(kind.__name__, {name, *_OTHER_NAMES.get(name, ())})
        self.assertEqual({-i for i in range(1, 10)}, set(errors._CLASSES))
        self.assertEqual(core.VERSION_NUMBER, core.version_number())


def _write_tetgen(mesh, path):
    with open(path, "w") as nodes:
        print(len(mesh.points), "3 0 0", file=nodes)
        for number, point in enumerate(mesh.points):
            print(number, *point, file=nodes)
    with open(path.replace(".node", ".ele"), "w") as cells:
        print(len(mesh.cells), "4 0", file=cells)
        for number, cell in enumerate(mesh.cells):
            print(number, *cell, file=cells)


# Where a name of Python's own kind would mislead.
_OTHER_NAMES = {"Io": ["InputOutput"], "Callback": ["CallbackFailed"], "Internal": ["InternalError"]}


if __name__ == "__main__":
    unittest.main()
