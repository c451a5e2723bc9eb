"""simplify on arrays: types, shapes, what is copied and what is refused."""
import collections
import gc
import os
import sys
import tempfile
import unittest
import warnings

import numpy
from meshes import box, halves, volume

import tetstream


def _renumbered(cells):
    return numpy.unique(cells, return_inverse=True)[1].reshape(-1, 4)


def _faces(corners):
    """How many cells each face has, by its places, from the places of the cells' corners."""
    return collections.Counter(frozenset(map(tuple, numpy.delete(cell, j, axis=0)))
                               for cell in corners for j in range(4))


class Arrays(unittest.TestCase):
    def test_a_box_becomes_a_tenth_of_its_cells(self):
        points, cells, field = box(8)
        result = tetstream.simplify(points, cells, {"f": field}, ratio=0.1)
        self.assertEqual(result.report.cells_in, len(cells))
        self.assertEqual(result.report.cells_out, len(result.cells))
        self.assertLessEqual(len(result.cells), len(cells) // 10)
        self.assertGreater(len(result.cells), len(cells) // 10 - 15)
        self.assertEqual(result.report.reached, "ratio")
        self.assertEqual(result.points.shape, (len(result.fields["f"]), 3))
        self.assertEqual((result.cells.min(), result.cells.max()), (0, len(result.points) - 1))
        self.assertAlmostEqual(volume(result.points, result.cells), 2, places=3)

    def test_types_of_points_and_cells_come_back(self):
        for points_type in (numpy.float32, numpy.float64):
            for cells_type in (numpy.int32, numpy.int64):
                with self.subTest(points=points_type, cells=cells_type):
                    points, cells, field = box(4, points_type, cells_type)
                    result = tetstream.simplify(points, cells, {"f": field}, ratio=0.5)
                    self.assertEqual(result.points.dtype, points_type)
                    self.assertEqual(result.cells.dtype, cells_type)
                    self.assertEqual(result.fields["f"].dtype, points_type)

    def test_the_result_does_not_depend_on_how_the_numbers_are_stored(self):
        points, cells, field = box(4)
        expected = tetstream.simplify(points, cells, {"f": field}, ratio=0.3)
        ways = {
            "int32": (points, cells.astype(numpy.int32), field),
            "Fortran order": (numpy.asfortranarray(points), numpy.asfortranarray(cells), field),
            "other byte order": (points.astype(">f8"), cells.astype(">i8"), field.astype(">f8")),
            "every second": (numpy.repeat(points, 2, axis=0)[::2], numpy.repeat(cells, 2, 0)[::2],
                             numpy.repeat(field, 2)[::2]),
            "unsigned": (points, cells.astype(numpy.uint64), field),
            "small integers": (points, cells.astype(numpy.int16), field),
            "lists": (points.tolist(), cells.tolist(), field.tolist()),
            "not to be written": tuple(map(_read_only, (points, cells, field))),
            "not aligned": (_unaligned(points), _unaligned(cells), _unaligned(field)),
        }
        for name, (p, c, f) in ways.items():
            with self.subTest(name):
                result = tetstream.simplify(p, c, {"f": f}, ratio=0.3)
                numpy.testing.assert_array_equal(result.points, expected.points)
                numpy.testing.assert_array_equal(result.cells, expected.cells)
                numpy.testing.assert_array_equal(result.fields["f"], expected.fields["f"])

    def test_inputs_stay_as_they_are(self):
        arrays = box(4)
        before = [array.copy() for array in arrays]
        tetstream.simplify(arrays[0], arrays[1], {"f": arrays[2]}, ratio=0.2)
        for array, old in zip(arrays, before):
            numpy.testing.assert_array_equal(array, old)

    def test_the_result_lives_longer_than_everything_else(self):
        points, cells, field = box(4)
        result = tetstream.simplify(points, cells, {"f": field}, ratio=0.2)
        kept, copy = result.points, result.points.copy()
        del result, points, cells, field
        gc.collect()
        numpy.testing.assert_array_equal(kept, copy)
        kept[:] = 0  # it is the caller's to write, too

    def test_nobody_keeps_the_inputs(self):
        points, cells, field = box(3)
        before = [sys.getrefcount(array) for array in (points, cells, field)]
        tetstream.simplify(points, cells, {"f": field}, ratio=0.5, progress=lambda p: None)
        self.assertEqual([sys.getrefcount(a) for a in (points, cells, field)], before)

    def test_fields_of_many_kinds_keep_type_and_shape(self):
        points, cells, field = box(4)
        n = len(points)
        fields = {"scalar": field, "column": field[:, None], "vector": points.astype("f4"),
                  "tensor": numpy.tile(numpy.eye(3), (n, 1, 1)), "half": field.astype("f2"),
                  "flag": field > 1, "id": numpy.arange(n), "short": numpy.arange(n, dtype="u2"),
                  "zahl ü": field}
        result = tetstream.simplify(points, cells, fields, ratio=0.3, weights={"scalar": 1})
        shapes = {name: (values.dtype, values.shape[1:]) for name, values in result.fields.items()}
        wanted = {name: (values.dtype, values.shape[1:]) for name, values in fields.items()}
        wanted["half"] = (numpy.dtype("f4"), ())  # an interpolated value has more digits
        self.assertEqual(shapes, wanted)
        self.assertEqual(list(result.fields), list(fields))
        self.assertLessEqual(set(result.fields["id"]), set(range(n)))
        numpy.testing.assert_allclose(result.fields["vector"], result.points, atol=1e-3)

    def test_cell_data_is_averaged_or_picked(self):
        points, cells, field = box(4)
        data = {"constant": numpy.full(len(cells), 2.5), "parity": (numpy.arange(len(cells)) % 2)}
        result = tetstream.simplify(points, cells, {"f": field}, cell_data=data, ratio=0.3,
                                    regions="none")
        numpy.testing.assert_allclose(result.cell_data["constant"], 2.5)
        self.assertLessEqual(set(result.cell_data["parity"]), {0, 1})

    def test_regions_keep_their_volumes(self):
        points, cells, field = box(6)
        labels = halves(points, cells)
        result = tetstream.simplify(points, cells, {"f": field}, regions=labels, ratio=0.2)
        self.assertEqual(result.regions.dtype, labels.dtype)
        self.assertIs(result.cell_data["region"], result.regions)
        self.assertIn("region", result.simplify(ratio=0.9).report.regions)
        self.assertEqual(set(result.cell_data), {"region"})
        for label in (3, 8):
            self.assertAlmostEqual(volume(result.points, result.cells[result.regions == label]), 1,
                                   places=6)

    def test_regions_may_be_one_of_the_cell_data(self):
        points, cells, field = box(4)
        labels = halves(points, cells)
        result = tetstream.simplify(points, cells, {"f": field}, cell_data={"part": labels},
                                    regions=labels, ratio=0.3)
        self.assertEqual(set(result.cell_data), {"part"})
        self.assertIs(result.regions, result.cell_data["part"])

    def test_regions_may_be_named(self):
        points, cells, field = box(4)
        result = tetstream.simplify(points, cells, {"f": field}, regions="part", ratio=0.3,
                                    cell_data={"part": halves(points, cells)})
        self.assertIn("part", result.report.regions)
        self.assertEqual(set(result.cell_data["part"]), {3, 8})

    def test_locked_points_stay(self):
        points, cells, field = box(5)
        locked = points[:, 2] == 1
        result = tetstream.simplify(points, cells, {"f": field}, locked=locked, ratio=0.3)
        kept = result.points[result.locked]
        self.assertEqual({tuple(p) for p in kept}, {tuple(p) for p in points[locked]})

    def test_parts_whose_seams_are_locked_fit_together(self):
        points, cells, field = box(6)
        part = 3 * numpy.arange(len(cells)) // len(cells)  # seams are ragged
        users = numpy.zeros((3, len(points)), bool)
        for k in range(3):
            users[k, cells[part == k]] = True
        shared = users.sum(axis=0) > 1
        of_parts = [set(_faces(points[cells[part == k]])) for k in range(3)]
        seams = of_parts[0] & of_parts[1] | of_parts[1] & of_parts[2] | of_parts[0] & of_parts[2]
        for options in ({}, {"shape": "solver"}, {"mode": "queue"}, {"effort": "high"}):
            with self.subTest(options):
                results = [tetstream.simplify(points[users[k]], _renumbered(cells[part == k]),
                                              {"f": field[users[k]]}, locked=shared[users[k]],
                                              ratio=0.5, **options) for k in range(3)]
                # As places, of which there is one of each in each part.
                corners = numpy.concatenate([r.points[r.cells] for r in results])
                faces = _faces(corners)
                self.assertLessEqual(max(faces.values()), 2)
                self.assertEqual({faces[face] for face in seams}, {2})
                self.assertLess(len(corners), 0.55 * len(cells))
                self.assertAlmostEqual(volume(corners.reshape(-1, 3),
                                              numpy.arange(4 * len(corners)).reshape(-1, 4)), 2,
                                       places=3)

    def test_edges_of_locked_points_are_not_tried(self):
        points, cells, field = box(5)
        some = numpy.arange(len(points)) % 5 == 0
        for mode in ("sweep", "paper", "queue"):
            report = tetstream.simplify(points, cells, {"f": field}, locked=some, ratio=0.05,
                                        mode=mode).report
            self.assertGreater(report.collapses, 0)
            self.assertEqual(report.rejected_locked, 0, mode)

    def test_faces_without_labels_have_0(self):
        points, cells, field = box(2)
        mesh = tetstream.Mesh(points, cells, {"f": field}, faces=cells[:1, :3])
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.tets")
            mesh.write(path)
            for same in (tetstream.read(path), mesh.simplify(ratio=1.0)):
                self.assertEqual(same.face_labels.tolist(), [0])

    def test_labelled_faces_go_along(self):
        points, cells, field = box(5)
        faces = numpy.array([[p for p in cell if points[p, 2] == 0] for cell in cells
                             if (points[cell, 2] == 0).sum() == 3])
        result = tetstream.simplify(points, cells, {"f": field}, faces=faces,
                                    face_labels=numpy.full(len(faces), 7), ratio=0.3)
        self.assertEqual(set(result.face_labels), {7})
        numpy.testing.assert_allclose(result.points[result.faces][..., 2], 0, atol=1e-4)

    def test_a_vertex_map_carries_linear_fields_back(self):
        points, cells, field = box(6)
        linear = points @ [1.0, -2, 3]
        result = tetstream.simplify(points, cells, {"f": field}, ratio=0.2, vertex_map=True)
        there = result.points @ [1.0, -2, 3]
        numpy.testing.assert_allclose(result.vertex_map.prolong(there), linear, atol=1e-9)
        numpy.testing.assert_allclose(result.vertex_map.prolong(result.points), points, atol=1e-9)
        with self.assertRaisesRegex(tetstream.BadArgument, "values: the shape is"):
            result.vertex_map.prolong(field)  # which is the original's
        plain = tetstream.simplify(points, cells, {"f": field}, ratio=0.2)
        self.assertIsNone(plain.vertex_map)
        numpy.testing.assert_array_equal(plain.cells, result.cells)

    def test_points_of_no_cell_have_no_place(self):
        points, cells, field = box(3)
        points, field = numpy.append(points, [[9, 9, 9]], 0), numpy.append(field, 0)
        result = tetstream.simplify(points, cells, {"f": field}, ratio=0.5, vertex_map=True)
        self.assertEqual(result.report.unused_vertices, 1)
        self.assertEqual(result.report.vertices_in, len(points))
        self.assertEqual(result.vertex_map.cells[-1], -1)
        self.assertTrue(numpy.isnan(result.vertex_map.prolong(result.points)[-1]).all())

    def test_where_no_cell_is_left_no_point_has_a_place(self):
        points, _, field = box(2)
        result = tetstream.simplify(points, [], {"f": field}, ratio=0.5, vertex_map=True)
        self.assertEqual(result.vertex_map.matrix().shape, (len(points), 0))
        for there, shape in ((result.fields["f"], field.shape), (result.points, points.shape)):
            back = result.vertex_map.prolong(there)
            self.assertEqual(back.shape, shape)
            self.assertTrue(numpy.isnan(back).all())

    def test_an_empty_mesh_may_be_of_empty_lists(self):
        result = tetstream.simplify([], [], ratio=0.5)
        self.assertEqual((result.points.shape, result.points.dtype), ((0, 3), numpy.float64))
        self.assertEqual(result.cells.shape, (0, 4))

    def test_no_labelled_faces_may_be_empty_lists(self):
        points, cells, field = box(3)
        plain = tetstream.simplify(points, cells, {"f": field}, ratio=0.5)
        for more in (dict(faces=[]), dict(faces=[], face_labels=[]),
                     dict(faces=[], face_labels=[], locked_faces=[], locked_edges=[])):
            result = tetstream.simplify(points, cells, {"f": field}, ratio=0.5, **more)
            self.assertIsNone(result.faces)
            numpy.testing.assert_array_equal(result.cells, plain.cells)
            mesh = tetstream.Mesh(points, cells, {"f": field}, **more)
            self.assertEqual(tetstream.info(tetstream.Reader.stream(mesh)).face_count, 0)

    def test_a_missed_target_is_a_warning(self):
        points, cells, field = box(3)
        locked = numpy.ones(len(points), bool)
        with self.assertWarnsRegex(tetstream.TargetMissedWarning, "limited by: ...") as caught:
            result = tetstream.simplify(points, cells, {"f": field}, locked=locked, cells=10)
        self.assertEqual(len(result.cells), len(cells))
        self.assertNotEqual(result.report.limited_by, "")
        self.assertEqual(caught.filename, __file__)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            tetstream.simplify(points, cells, {"f": field}, error=50)


def _read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


def _unaligned(array):
    buffer = bytearray(array.nbytes + 1)
    out = numpy.frombuffer(buffer, numpy.uint8, offset=1)[:array.nbytes].view(array.dtype)
    out = out.reshape(array.shape)
    out[...] = array
    assert not out.flags.aligned
    return out


class Refused(unittest.TestCase):
    """Each bad input, with a part of the sentence that tells of it."""

    def refused(self, kind, sentence, *arguments, **more):
        with self.assertRaisesRegex(kind, sentence):
            tetstream.simplify(*arguments, **{"ratio": 0.5, **more})

    def setUp(self):
        self.points, self.cells, self.field = box(2)

    def test_shapes(self):
        p, c, f = self.points, self.cells, self.field
        self.refused(tetstream.BadArgument, r"points: the shape is \[\d+\]\[2\], \[n\]\[3\]", p[:, :2], c)
        self.refused(tetstream.BadArgument, r"points", p.ravel(), c)
        self.refused(tetstream.BadArgument, r"cells: .*\[n\]\[4\]", p, c[:, :3])
        self.refused(tetstream.BadArgument, r'"f": the shape is', p, c, {"f": f[1:]})
        self.refused(tetstream.BadArgument, r'"d"', p, c, cell_data={"d": c[1:, 0]})
        self.refused(tetstream.BadArgument, r"10 numbers in a row", p, c,
                     {"f": numpy.zeros((len(p), 10))})
        self.refused(tetstream.BadArgument, "locked", p, c, locked=[True])
        self.refused(tetstream.BadArgument, r"regions: the shape is \[2\]", p, c, regions=[1, 2])
        self.refused(tetstream.BadArgument, r"regions: the shape is \[\d+\]\[2\]", p, c,
                     regions=c[:, :2])
        self.refused(tetstream.BadArgument, "face_labels", p, c, face_labels=[1])
        self.refused(tetstream.BadArgument, "face_labels: 1 rows", p, c, faces=[], face_labels=[1])
        self.refused(tetstream.BadArgument, "locked_faces", p, c, locked_faces=[True])
        self.refused(ValueError, "points", numpy.float64(3), c)

    def test_types(self):
        p, c, f = self.points, self.cells, self.field
        self.refused(TypeError, "points: .*complex128", p.astype(complex), c)
        self.refused(TypeError, "points: float64 does not hold all",
                     2 ** 53 + 1 + 8 * p.astype(numpy.int64), c)
        self.refused(TypeError, "cells: .*float64", p, c.astype(float))
        self.refused(TypeError, "text", p, c, {"text": numpy.full(len(p), "a")})
        self.refused(TypeError, "longdouble|float128", p, c, {"long": f.astype(numpy.longdouble)})
        self.refused(TypeError, "uint64", p, c,
                     {"id": numpy.full(len(p), 2 ** 63, dtype=numpy.uint64)})
        self.refused(TypeError, "name is 3", p, c, {3: f})
        self.refused(TypeError, "progress", p, c, progress="yes")
        self.refused(TypeError, "fields: a dict is wanted, not ndarray", p, c, f)
        self.refused(TypeError, "weights: a dict is wanted, not list", p, c, {"f": f}, weights=["f"])
        self.refused(TypeError, 'the weight of "f": a number', p, c, {"f": f}, weights={"f": "x"})
        self.refused(ValueError, r"null character in 'f\\x00g'", p, c, {"f\0g": f})

    def test_values(self):
        p, c, f = self.points, self.cells, self.field
        for bad in (-1, len(p)):
            wrong = c.copy()
            wrong[7, 2] = bad
            self.refused(tetstream.BadData, f"cell 7: vertex {bad} is not one of", p, wrong)
            self.refused(tetstream.BadData, f"cell 7: vertex {bad} is not one of", p,
                         wrong.astype(numpy.int32))
        wrong = p.copy()
        wrong[5, 1] = numpy.nan
        self.refused(tetstream.BadData, "vertex 5|point 5", wrong, c)
        self.refused(tetstream.BadArgument, "nowhere", p, c, {"f": f}, weights={"nowhere": 1})
        self.refused(tetstream.BadArgument, "points: 1 of its numbers are masked",
                     numpy.ma.masked_invalid(wrong), c)

    def test_options(self):
        p, c = self.points, self.cells
        self.refused(tetstream.BadArgument, "ratio", p, c, ratio=1.5)
        self.refused(tetstream.BadArgument, "mode", p, c, mode="fast")
        self.refused(TypeError, "there is no option quality; there are ratio, cells((?!samples).)*$",
                     p, c, quality=3)
        self.refused(TypeError, "there is no option rato: is ratio meant\\?", p, c, rato=0.1)
        self.refused(TypeError, "there is no option weight: is weights meant\\?", p, c, weight={})
        self.refused(TypeError, "no option boundary-weight: is boundary_weight meant", p, c,
                     **{"boundary-weight": 3})
        self.refused(TypeError, "window: an int is wanted, not float", p, c, window=3.5)
        for wrong in (numpy.float32(3.5), float("inf"), float("nan")):
            self.refused(TypeError, "cells: an int is wanted, not float", p, c, cells=wrong)
        self.refused(tetstream.BadArgument, "seed: .*64 bits", p, c, seed=1e19)
        with self.assertRaisesRegex(tetstream.BadArgument, '^option "mode": "fast" is none of'):
            tetstream.simplify(p, c, ratio=0.5, mode="fast")  # no function of C's is named
        self.refused(TypeError, "axis: a str", p, c, axis=1)
        self.refused(TypeError, "ratio: a number is wanted, not ndarray", p, c, ratio=p[0])
        with self.assertRaisesRegex(AttributeError, "rato"):
            tetstream.Options().rato = 0.1
        self.refused(tetstream.BadArgument, "seed: .*64 bits", p, c, seed=2 ** 63)
        with self.assertRaisesRegex(TypeError, "a target is missing"):
            tetstream.simplify(p, c)

    def test_integers_may_be_written_as_floats(self):
        few = tetstream.simplify(self.points, self.cells, cells=4e1, memory=numpy.float32(5e7))
        same = tetstream.simplify(self.points, self.cells, cells=40, memory=50000000)
        numpy.testing.assert_array_equal(few.cells, same.cells)

    def test_an_empty_mesh_is_an_empty_mesh(self):
        result = tetstream.simplify(numpy.zeros((0, 3)), numpy.zeros((0, 4), int), {"f": []},
                                    ratio=0.5)
        self.assertEqual((result.points.shape, result.cells.shape), ((0, 3), (0, 4)))

    def test_after_a_refusal_all_is_well(self):
        self.test_values()
        result = tetstream.simplify(self.points, self.cells, {"f": self.field}, ratio=0.9)
        self.assertLess(len(result.cells), len(self.cells))


if __name__ == "__main__":
    unittest.main()
