"""Meshes of pyvista and meshio, which are imported when they are needed."""
import numpy

from ._mesh import Mesh
from .errors import Unsupported

_VTK_TETRA = 10


def _needs_tetrahedra(what, kinds):
    others = sorted(str(kind) for kind in kinds)
    if others:
        raise Unsupported(f"{what}: only tetrahedra are taken, and there are {', '.join(others)}")


def from_pyvista(grid):
    """A Mesh of a pyvista.UnstructuredGrid of tetrahedra: its points, its point data as fields, its
    cell data. Points and data are not copied where pyvista does not."""
    kinds = numpy.asarray(grid.celltypes)
    _needs_tetrahedra("the grid", {f"VTK cells of type {kind}" for kind in
                                   numpy.unique(kinds) if kind != _VTK_TETRA})
    cells = numpy.asarray(grid.cells).reshape(-1, 5)[:, 1:]
    return Mesh(numpy.asarray(grid.points), cells,
                {name: numpy.asarray(grid.point_data[name]) for name in grid.point_data.keys()},
                {name: numpy.asarray(grid.cell_data[name]) for name in grid.cell_data.keys()})


def to_pyvista(mesh):
    """A pyvista.UnstructuredGrid of a Mesh."""
    import pyvista
    count = len(mesh.cells)
    cells = numpy.empty((count, 5), numpy.int64)
    cells[:, 0] = 4
    cells[:, 1:] = mesh.cells
    grid = pyvista.UnstructuredGrid(cells.ravel(), numpy.full(count, _VTK_TETRA, numpy.uint8),
                                    numpy.asarray(mesh.points))
    for name, values in mesh.fields.items():
        grid.point_data[name] = values
    for name, values in mesh.cell_data.items():
        grid.cell_data[name] = values
    return grid


def from_meshio(mesh):
    """A Mesh of a meshio.Mesh: the tetrahedra of all its blocks, point data as fields, cell data.
    Triangles are left out, as are lines and vertices; other cells are refused."""
    kept = [i for i, block in enumerate(mesh.cells) if block.type == "tetra"]
    _needs_tetrahedra("the mesh", {block.type for block in mesh.cells} -
                      {"tetra", "triangle", "line", "vertex"})
    if not kept:
        raise Unsupported("the mesh has no tetrahedra")
    return Mesh(mesh.points, numpy.concatenate([mesh.cells[i].data for i in kept]),
                dict(mesh.point_data),
                {name: numpy.concatenate([numpy.asarray(blocks[i]) for i in kept])
                 for name, blocks in mesh.cell_data.items()})


def to_meshio(mesh):
    """A meshio.Mesh of a Mesh."""
    import meshio
    return meshio.Mesh(mesh.points, [("tetra", numpy.asarray(mesh.cells))],
                       point_data=dict(mesh.fields),
                       cell_data={name: [values] for name, values in mesh.cell_data.items()})
