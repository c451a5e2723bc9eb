"""Hand-over to and from meshio."""
import os
import tempfile
import unittest

import meshio
import numpy
from meshes import box, halves

import tetstream


class Meshio(unittest.TestCase):
    def test_there_and_back_through_a_file(self):
        points, cells, field = box(4)
        labels = halves(points, cells)
        triangles = ("triangle", cells[:5, :3])
        two = meshio.Mesh(points, [("tetra", cells[:100]), triangles, ("tetra", cells[100:])],
                          point_data={"f": field},
                          cell_data={"part": [labels[:100], numpy.zeros(5, int), labels[100:]]})
        mesh = tetstream.from_meshio(two)
        numpy.testing.assert_array_equal(mesh.cells, cells)
        numpy.testing.assert_array_equal(mesh.cell_data["part"], labels)
        small = mesh.simplify(ratio=0.3, regions="part")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "small.vtk")
            small.to_meshio().write(path)
            again = tetstream.from_meshio(meshio.read(path))
        numpy.testing.assert_array_equal(again.cells, small.cells)
        numpy.testing.assert_array_equal(again.points, small.points)
        numpy.testing.assert_array_equal(again.fields["f"], small.fields["f"])
        numpy.testing.assert_array_equal(again.cell_data["part"].ravel(), small.cell_data["part"])

    def test_labels_and_names_that_meshio_holds_otherwise(self):
        points, cells, _ = box(2)
        regions = numpy.full(len(cells), 3, numpy.uint8)
        names = {None: {300: "wall"}, "gmsh:physical": {3: "wall"}}
        mesh = tetstream.Mesh(points, cells, {}, {"gmsh:physical": regions}, faces=cells[:1, :3],
                              face_labels=[300], label_names=names)
        there = mesh.to_meshio()
        self.assertEqual(there.cell_data["gmsh:physical"][1].tolist(), [300])
        self.assertEqual({name: group.tolist() for name, group in there.field_data.items()},
                         {"wall": [300, 2], "wall_": [3, 3]})
        mesh.face_labels = None
        self.assertEqual(mesh.to_meshio().cell_data["gmsh:physical"][1].tolist(), [0])

    def test_labelled_faces_and_names_go_there_and_back(self):
        points, cells, field = box(4)
        bottom = cells[(points[cells][:, :, 2] == 0).sum(axis=1) == 3]
        on = points[bottom][:, :, 2] == 0
        triangles = bottom[on].reshape(-1, 3)
        for by in ("gmsh:physical", "medit:ref", None):
            labels = numpy.full(len(triangles), 7)
            labels[0] = 0  # of no group
            data = {"r": [numpy.arange(len(cells), dtype=float), numpy.zeros(len(triangles))]}
            if by:
                data[by] = [numpy.full(len(cells), 3), labels]
            mesh = tetstream.from_meshio(meshio.Mesh(
                points, [("tetra", cells), ("triangle", triangles)], {"f": field}, data,
                {"floor": numpy.array([7, 2]), "air": numpy.array([3, 3]),
                 "edge": numpy.array([9, 1])}))
            if not by:
                self.assertIsNone(mesh.faces)
                self.assertEqual(mesh.label_names, {})
                continue
            numpy.testing.assert_array_equal(mesh.faces, triangles[1:])
            self.assertEqual(set(mesh.face_labels), {7})
            self.assertEqual(mesh.label_names, {None: {7: "floor"}, by: {3: "air"}})
            small = mesh.simplify(ratio=0.4)
            self.assertGreater(len(small.faces), 0)
            again = tetstream.from_meshio(small.to_meshio())
            numpy.testing.assert_array_equal(again.faces, small.faces)
            numpy.testing.assert_array_equal(again.face_labels, small.face_labels)
            numpy.testing.assert_array_equal(again.cell_data[by], small.cell_data[by])
            numpy.testing.assert_array_equal(again.cell_data["r"], small.cell_data["r"])
            self.assertEqual(again.label_names, mesh.label_names)

    def test_labels_of_faces_go_through_a_vtu_file(self):
        points, cells, field = box(4)
        bottom = cells[(points[cells][:, :, 2] == 0).sum(axis=1) == 3]
        faces = bottom[points[bottom][:, :, 2] == 0].reshape(-1, 3)
        labels_of = lambda p, f: 7 + (p[f][:, :, 0].mean(axis=1) > 0.5)
        mesh = tetstream.Mesh(points, cells, {"f": field}, {"part": halves(points, cells)},
                              faces=faces, face_labels=labels_of(points, faces))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "faces.vtu")
            mesh.to_meshio().write(path)
            again = tetstream.read(path)  # in another order
        self.assertEqual(len(again.faces), len(faces))
        numpy.testing.assert_array_equal(again.face_labels, labels_of(again.points, again.faces))
        numpy.testing.assert_array_equal(again.cell_data["part"], halves(again.points, again.cells))

    def test_faces_of_cells_without_labels_reach_gmsh(self):
        points, cells, _ = box(2)
        mesh = tetstream.Mesh(points, cells, faces=cells[:1, :3], face_labels=numpy.array([5]),
                              label_names={None: {5: "spot"}})
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "spot.msh")
            mesh.to_meshio().write(path, file_format="gmsh22", binary=False)
            again = tetstream.read(path)
        numpy.testing.assert_array_equal(again.face_labels, [5])
        self.assertEqual(again.label_names, {None: {5: "spot"}})

    def test_other_cells_are_refused(self):
        with self.assertRaisesRegex(tetstream.Unsupported, "hexahedron"):
            tetstream.from_meshio(meshio.Mesh(numpy.zeros((8, 3)), [("hexahedron", [range(8)])]))
        with self.assertRaisesRegex(tetstream.Unsupported, "no tetrahedra"):
            tetstream.from_meshio(meshio.Mesh(numpy.zeros((3, 3)), [("triangle", [range(3)])]))


if __name__ == "__main__":
    unittest.main()
