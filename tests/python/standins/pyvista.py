"""Stands in for pyvista, which Debian 12 does not have: the part of UnstructuredGrid that is used,
as pyvista documents it. Data keep their order; cells are [n * 5] of counts and points."""
import numpy


class UnstructuredGrid:
    def __init__(self, cells, celltypes, points):
        if cells.ndim != 1 or celltypes.dtype != numpy.uint8 or points.shape[1:] != (3,):
            raise TypeError("cells are flat, types uint8, points [n][3]")
        self.cells, self.celltypes, self.points = cells, celltypes, points
        self.point_data, self.cell_data, self.field_data = {}, {}, {}
