"""Meshes of pyvista and meshio, which are imported when they are needed."""
import numpy

from ._mesh import Mesh, face_labels_of
from .errors import Unsupported

_VTK_TETRA = 10
_TIME = "TimeValue"


def _needs_tetrahedra(what, kinds):
    others = sorted(str(kind) for kind in kinds)
    if others:
        raise Unsupported(f"{what}: only tetrahedra are taken, and there are {', '.join(others)}")


def from_pyvista(grid):
    """A Mesh of a pyvista.UnstructuredGrid of tetrahedra: its points, its point data as fields, its
    cell data, and the time that the field data "TimeValue" tells, as VTK's files do. Points and data
    are not copied where pyvista does not."""
    kinds = numpy.asarray(grid.celltypes)
    _needs_tetrahedra("the grid", {f"VTK cells of type {kind}" for kind in
                                   numpy.unique(kinds) if kind != _VTK_TETRA})
    cells = numpy.asarray(grid.cells).reshape(-1, 5)[:, 1:]
    return Mesh(numpy.asarray(grid.points), cells,
                {name: numpy.asarray(grid.point_data[name]) for name in grid.point_data.keys()},
                {name: numpy.asarray(grid.cell_data[name]) for name in grid.cell_data.keys()},
                time=_time_in(grid))


def _time_in(grid):
    if _TIME not in grid.field_data.keys():
        return None
    values = numpy.ravel(grid.field_data[_TIME])
    is_time = len(values) == 1 and values.dtype.kind in "fiu" and numpy.isfinite(values[0])
    return float(values[0]) if is_time else None


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
    if mesh.time is not None:
        grid.field_data[_TIME] = numpy.array([mesh.time], float)
    return grid


# How meshio calls what labels cells and faces alike, in files of Gmsh and of MEDIT.
_LABELS = ("gmsh:physical", "medit:ref")


def from_meshio(mesh):
    """A Mesh of a meshio.Mesh: the tetrahedra of all its blocks, point data as fields, cell data.
    Triangles are labelled faces, by the cell data "gmsh:physical" or "medit:ref", unless they have 0
    there or neither is; names of groups (field_data) are names of labels. Lines and vertices are
    left out; other cells are refused."""
    kept = [i for i, block in enumerate(mesh.cells) if block.type == "tetra"]
    _needs_tetrahedra("the mesh", {block.type for block in mesh.cells} -
                      {"tetra", "triangle", "line", "vertex"})
    if not kept:
        raise Unsupported("the mesh has no tetrahedra")
    made = Mesh(mesh.points, numpy.concatenate([mesh.cells[i].data for i in kept]),
                dict(mesh.point_data),
                {name: numpy.concatenate([numpy.asarray(blocks[i]) for i in kept])
                 for name, blocks in mesh.cell_data.items()})
    by = next((name for name in _LABELS if name in mesh.cell_data), None)
    if by is not None:
        _take_faces(made, mesh, by)
        _take_names(made, mesh, by)
    return made


def _take_faces(made, mesh, by):
    kept = [i for i, block in enumerate(mesh.cells) if block.type == "triangle"]
    if not kept:
        return
    faces = numpy.concatenate([mesh.cells[i].data for i in kept]).astype(numpy.int64)
    labels = numpy.concatenate([numpy.asarray(mesh.cell_data[by][i]) for i in kept])
    labels = labels.astype(numpy.int64)
    if labels.any():
        made.faces, made.face_labels = faces[labels != 0], labels[labels != 0]


def _take_names(made, mesh, by):
    for name, group in mesh.field_data.items():
        if numpy.shape(group) != (2,):
            continue
        label, dimension = (int(number) for number in group)
        if dimension == 3 or (dimension == 2 and made.faces is not None):
            made.label_names.setdefault(by if dimension == 3 else None, {})[label] = name


def to_meshio(mesh):
    """A meshio.Mesh of a Mesh. Labelled faces are triangles, whose labels stand in the cell data
    "gmsh:physical", or in "medit:ref" if the mesh has that; other cell data are 0 there, and all cells
    have the label 1 if there was none. Names of these labels are field_data; of labels that share a
    name the later ones have "_" behind it. The time is left out."""
    import meshio
    by = next((name for name in _LABELS if name in mesh.cell_data), _LABELS[0])
    faces = [] if mesh.faces is None else numpy.asarray(mesh.faces)
    blocks = [("tetra", numpy.asarray(mesh.cells))]
    cell_data = {name: [numpy.asarray(values)] for name, values in mesh.cell_data.items()}
    if len(faces) > 0:
        blocks.append(("triangle", faces))
        # Gmsh passes over cells of no group where there are groups.
        cell_data.setdefault(by, [numpy.ones(len(mesh.cells), numpy.int64)])
        for name, of_blocks in cell_data.items():
            shape = (len(faces), *of_blocks[0].shape[1:])
            of_blocks.append(numpy.asarray(face_labels_of(mesh)) if name == by
                             else numpy.zeros(shape, of_blocks[0].dtype))
        kind = numpy.result_type(*cell_data[by])  # of which both are
        cell_data[by] = [values.astype(kind) for values in cell_data[by]]
    names = {}
    for array, dimension in ((None, 2), (by, 3)):
        for label, name in mesh.label_names.get(array, {}).items():
            while name in names:
                name += "_"
            names[name] = numpy.array([label, dimension])
    return meshio.Mesh(mesh.points, blocks, point_data=dict(mesh.fields), cell_data=cell_data,
                       field_data=names)
