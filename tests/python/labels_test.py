"""Names of labels, of faces and of cell arrays, wherever a mesh comes from and goes to."""
import pathlib
import tempfile
import unittest

import numpy
from meshes import box, halves

import tetstream
from tetstream import Batch, Reader, Writer

NAMES = {None: {7: "inlet"}, "material": {3: "steel", 8: "öl"}}


def named_box(n=4, **more):
    """A box of two materials, whose bottom is labelled 7."""
    points, cells, field = box(n)
    faces = [[p for p in cell if points[p, 2] == 0] for cell in cells
             if (points[cell, 2] == 0).sum() == 3]
    return tetstream.Mesh(points, cells, {"f": field}, {"material": halves(points, cells)},
                          faces=faces, face_labels=numpy.full(len(faces), 7),
                          **{"label_names": NAMES, **more})


class Names(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.mesh = named_box()

    def test_they_go_from_file_to_file(self):
        first, second = self.folder / "first.msh", self.folder / "second.msh"
        self.mesh.write(first)
        mesh = tetstream.read(first)
        self.assertEqual(mesh.label_names, NAMES)
        small = mesh.simplify(ratio=0.5)
        self.assertLess(len(small.cells), len(mesh.cells))
        self.assertEqual(small.label_names, NAMES)
        small.write(second)
        self.assertIn(b'"inlet"', second.read_bytes())
        self.assertEqual(tetstream.read(second).label_names, NAMES)
        tetstream.simplify_file(first, self.folder / "third.tets", ratio=0.5)
        self.assertEqual(tetstream.info(self.folder / "third.tets").label_names, NAMES)

    def test_they_are_known_before_and_after_reading(self):
        self.assertEqual(Reader.mesh(self.mesh).info().label_names, NAMES)
        self.assertEqual(tetstream.info(self.mesh).label_names, NAMES)
        self.assertEqual(Reader.generate("ball", 100).info().label_names, {})
        self.assertEqual(tetstream.info(Reader.generate("ball", 100)).face_labels, {})

    def test_a_format_without_them_leaves_them_out(self):
        notes = self.mesh.write(self.folder / "out.vtu")
        self.assertIn('faces 7 "inlet"', " ".join(notes))
        self.assertEqual(tetstream.read(self.folder / "out.vtu").label_names, {})

    def test_arrays_come_back_with_them(self):
        m = self.mesh
        more = dict(cell_data=m.cell_data, faces=m.faces, face_labels=m.face_labels, ratio=0.5)
        small = tetstream.simplify(m.points, m.cells, m.fields, label_names=NAMES, **more)
        self.assertEqual(small.label_names, NAMES)
        self.assertEqual(tetstream.simplify(m.points, m.cells, **more).label_names, {})
        of_regions = tetstream.simplify(m.points, m.cells, label_names=NAMES,
                                        regions=m.cell_data["material"], **more)
        self.assertEqual(of_regions.label_names, NAMES)

    def test_labels_may_be_any_integers(self):
        names = {"material": {numpy.int32(-3): "a", 2 ** 63 - 1: "b", 0: "N\udce9e"}}
        self.assertEqual(tetstream.info(named_box(label_names=names)).label_names,
                         {"material": {-3: "a", 2 ** 63 - 1: "b", 0: "N\udce9e"}})

    def test_streams_have_them(self):
        def solver():
            yield Batch(self.mesh.points, self.mesh.cells, cell_data=self.mesh.cell_data)

        told = []
        announced = dict(cell_data={"material": "int64"}, label_names=NAMES)
        writer = Writer.batches(lambda batch: None, lambda info: told.append(info.label_names))
        tetstream.convert(Reader.batches(solver(), indexed=True, **announced), writer)
        self.assertEqual(told, [NAMES])
        memory = Writer.memory("tets")
        batches = tetstream.simplify_batches(solver(), ratio=0.9, **announced)
        again = Reader.batches(batches, **announced)
        tetstream.convert(again, memory)
        self.assertEqual(Reader.memory(memory.getbytes(), "tets").info().label_names, NAMES)


class Refused(unittest.TestCase):
    def refused(self, kind, sentence, names, **more):
        mesh = named_box(2, label_names=names)
        mesh.cell_data.update(more)
        for read in (Reader.mesh, Reader.stream, lambda mesh: mesh.simplify(ratio=0.5)):
            with self.assertRaisesRegex(kind, sentence):
                tetstream.info(read(mesh))

    def test_names_of_no_array(self):
        self.refused(tetstream.BadArgument, 'label name "steel": there is no cell array "nowhere"',
                     {"nowhere": {3: "steel"}})
        self.refused(tetstream.BadArgument, '"f": there is no cell array "f"', {"f": {3: "f"}})
        cells = len(box(2)[1])
        self.refused(tetstream.BadArgument, 'the cell array "heat" has no labels',
                     {"heat": {3: "warm"}}, heat=numpy.zeros(cells))

    def test_labels_of_regions_that_have_no_name(self):
        mesh = named_box(2, label_names={"region": {3: "steel"}})
        with self.assertRaisesRegex(tetstream.BadArgument, 'no cell array "region"'):
            mesh.simplify(ratio=0.5, regions=mesh.cell_data["material"])

    def test_names_that_are_none(self):
        self.refused(tetstream.BadArgument, "the name of faces 7 has no bytes", {None: {7: ""}})
        self.refused(tetstream.BadArgument, "the name of faces 7 has", {None: {7: "n" * 300}})
        self.refused(TypeError, "a str is wanted, not int", {None: {7: 8}})
        self.refused(ValueError, "null character", {None: {7: "in\0let"}})

    def test_other_things(self):
        with self.assertRaisesRegex(TypeError, "label_names: a dict is wanted, not list"):
            named_box(2, label_names=["inlet"])
        self.refused(TypeError, "label_names of faces: a dict of label", {None: "inlet"})
        self.refused(TypeError, "label_names of 'material': 'steel' is no integer",
                     {"material": {"steel": 3}})
        self.refused(TypeError, "a str is wanted, not int", {3: {3: "steel"}})
        self.refused(OverflowError, "int64_t", {None: {2 ** 63: "far"}})


if __name__ == "__main__":
    unittest.main()
