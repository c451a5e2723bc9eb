"""The shared problem in Python, as README.md states it: a mesh of arrays into a file, and arrays into
arrays."""
import itertools

import numpy

import tetstream

BOXES = 12
SIDE = BOXES + 1

z, y, x = (axis.ravel() for axis in numpy.indices((SIDE,) * 3))
points = numpy.stack([x, y, z], axis=1) / 4.0
pressure = (x * x * y - 3 * z).astype("f8")
velocity = numpy.stack([y - z, x * z, x + y], axis=1).astype("f4")

corner = (x + SIDE * (y + SIDE * z)).reshape((SIDE,) * 3)[:-1, :-1, :-1].ravel()
steps = numpy.cumsum([[0, *way] for way in itertools.permutations([1, SIDE, SIDE * SIDE])], axis=1)
cells = (corner[:, None, None] + steps).reshape(-1, 4)
material = numpy.repeat(numpy.where(x[corner] < BOXES // 2, 1, 2), 6).astype("i4")

mesh = tetstream.Mesh(points, cells, {"pressure": pressure, "velocity": velocity},
                      {"material": material})
options = dict(ratio=0.2, boundary_weight=4, regions="material",
               weights={"pressure": 1, "velocity": 0.5})

tetstream.simplify_file(mesh, "python.tets", **options)
small = tetstream.simplify(points, cells, mesh.fields, cell_data=mesh.cell_data, **options)
with open("python.raw", "wb") as file:
    for array in (small.points, small.fields["pressure"], small.fields["velocity"], small.cells,
                  small.cell_data["material"]):
        file.write(array.tobytes())
