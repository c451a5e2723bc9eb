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

    def test_other_cells_are_refused(self):
        with self.assertRaisesRegex(tetstream.Unsupported, "hexahedron"):
            tetstream.from_meshio(meshio.Mesh(numpy.zeros((8, 3)), [("hexahedron", [range(8)])]))
        with self.assertRaisesRegex(tetstream.Unsupported, "no tetrahedra"):
            tetstream.from_meshio(meshio.Mesh(numpy.zeros((3, 3)), [("triangle", [range(3)])]))


if __name__ == "__main__":
    unittest.main()
