"""Meshes in arrays."""
import numpy

from . import _announced, _arrays, core


class Mesh:
    """A tetrahedral mesh in numpy arrays.

    points: [n][3], float32 or float64, in any unit of length.
    cells: [m][4], int32 or int64: the points of each cell, in either orientation.
    fields: dict of name to [n] or [n][components], values at the points, in any units.
    cell_data: dict of name to [m] or [m][components]; integers are labels.
    locked: [n] of bool: points that are never moved; None: none.
    faces: [f][3] of int64, labelled faces of cells, with face_labels: [f] of int64, and
        locked_faces: [f] of bool or None; locked_edges: [e][2] of int64 or None. Without
        face_labels all faces have the label 0.
    label_names: what labels mean, a dict of the name of a cell array of integers, or None for
        faces, to a dict of label to name: {None: {1: "inlet"}, "material": {3: "steel"}}.
    time: of the values, a float in any unit; None: not known.
    """

    def __init__(self, points, cells, fields=None, cell_data=None, *, locked=None, faces=None,
                 face_labels=None, locked_faces=None, locked_edges=None, label_names=None,
                 time=None):
        self.points, self.cells = points, cells
        self.fields = _arrays.named("fields", fields)
        self.cell_data = _arrays.named("cell_data", cell_data)
        self.locked = locked
        self.faces, self.face_labels, self.locked_faces = faces, face_labels, locked_faces
        self.locked_edges = locked_edges
        self.label_names, self.time = _arrays.named("label_names", label_names), time

    def __repr__(self):
        return (f"<{type(self).__name__} of {len(self.cells)} cells and {len(self.points)} points; "
                f"fields: {', '.join(self.fields) or 'none'}; "
                f"cell data: {', '.join(self.cell_data) or 'none'}>")

    def simplify(self, **options):
        """As tetstream.simplify of this mesh."""
        from ._simplify import simplify_mesh
        return simplify_mesh(self, **options)

    def write(self, path, format=None, **properties):
        """Writes a file, whose cells and points have the order that they have here. `format` and
        `properties` as in Writer.file."""
        from ._operations import convert
        from ._streams import Reader, Writer
        return convert(Reader.stream(self), Writer.file(path, format, **properties))

    def to_pyvista(self):
        """A pyvista.UnstructuredGrid. Needs pyvista."""
        from ._interchange import to_pyvista
        return to_pyvista(self)

    def to_meshio(self):
        """A meshio.Mesh. Needs meshio."""
        from ._interchange import to_meshio
        return to_meshio(self)


def face_labels_of(mesh):
    """[f], where the Mesh has faces; else None."""
    if mesh.faces is None or mesh.face_labels is not None:
        return mesh.face_labels
    return numpy.zeros(len(mesh.faces), numpy.int64)


class VertexMap:
    """Where each point of the input lies in the result.

    cells: [n] of int64, the cell of the result; -1 for points that were in no cell.
    weights: [n][4] of float64, of the cell's points in their order; their sum is 1. One below 0
        tells that the point lies outside of the result, whose boundary has moved.
    """

    def __init__(self, cells, weights, corners, points):
        self.cells, self.weights = cells, weights
        self._corners, self._points = corners, points

    def __repr__(self):
        return f"<VertexMap of {len(self.cells)} points>"

    def prolong(self, values):
        """Values at the result's points, [n'] or [n'][components], at the input's points, [n] or
        [n][components]: linear in each cell; NaN at points that were in no cell."""
        values = numpy.asarray(values)
        _arrays.needs_shape("values", values, f"[{self._points}] or [{self._points}][components]",
                            values.shape[:1] == (self._points,))
        if len(self._corners) == 0:
            return numpy.full((len(self.cells),) + values.shape[1:], numpy.nan)
        corners = self._corners[numpy.where(self.cells < 0, 0, self.cells)]
        out = numpy.einsum("ij,ij...->i...", self.weights, values[corners])
        out[self.cells < 0] = numpy.nan
        return out

    def matrix(self):
        """The same as a scipy.sparse.csr_array [n][n'], a multigrid's prolongation. Needs scipy."""
        from scipy.sparse import csr_array
        used = self.cells >= 0
        rows = numpy.zeros(len(self.cells) + 1, numpy.int64)
        numpy.cumsum(4 * used, out=rows[1:])
        return csr_array((self.weights[used].ravel(), self._corners[self.cells[used]].ravel(), rows),
                         shape=(len(self.cells), self._points))


class Simplified(Mesh):
    """The result of a simplification: a Mesh, and

    report: what was done, a Report.
    regions: [m], the labels, if some were given, also one of `cell_data`; else None.
    vertex_map: where the input's points went, a VertexMap, if it was asked for; else None.
    """

    report = None
    regions = None
    vertex_map = None


def collected(collector, columns=(), cell_columns=(), kind=Mesh):
    """A mesh of what the library has put into its collector. Arrays with the name of a column get
    its shape."""
    info = collector.info()
    shaped = {column.name: column.like_before for column in columns}
    shaped_cells = {column.name: column.like_before for column in cell_columns}
    fields = {info.field_name(i): collector.field(i) for i in range(info.field_count())}
    cell_data = {info.cell_data_name(i): collector.cell_data(i)
                 for i in range(info.cell_data_count())}
    mesh = kind(collector.positions(), collector.cells(),
                {name: shaped[name](array) if name in shaped else array
                 for name, array in fields.items()},
                {name: shaped_cells[name](array) if name in shaped_cells else array
                 for name, array in cell_data.items()})
    locked, faces, labels = collector.locked(), collector.faces(), collector.face_labels()
    locked_faces, edges = collector.locked_faces(), collector.locked_edges()
    mesh.locked = locked.astype(bool) if locked.size else None
    if faces.size:
        mesh.faces, mesh.face_labels = faces.reshape(-1, 3), labels
        mesh.locked_faces = locked_faces.astype(bool) if locked_faces.size else None
    mesh.locked_edges = edges.reshape(-1, 2) if edges.size else None
    mesh.label_names, mesh.time = _announced.names_of(info), _announced.time_of(info)
    return mesh


# ----------------------------------------------------------------------- a mesh as a stream

# Cells of a batch.
_STEP = 1 << 16


def _last_uses(cells, points):
    """[m] of uint8: bit j where no later corner has this corner's point."""
    corners = cells.ravel()
    last = numpy.full(points, -1, numpy.int64)
    places = numpy.arange(corners.size)
    last[corners] = places  # of those that are named twice, the last one stays
    is_last = (last[corners] == places).reshape(-1, 4)
    return numpy.packbits(is_last, axis=1, bitorder="little").ravel()


def batches_of(mesh):
    """Reader.stream of a Mesh."""
    from ._batches import Batch
    from ._streams import Reader
    points = _arrays.points(mesh.points)
    cells = _arrays.wide_ids("cells", mesh.cells, 4)
    if cells.size and not (0 <= cells.min() and cells.max() < len(points)):
        raise _arrays.BadArgument(f"cells: a point is not one of the mesh's {len(points)}")
    fields = _arrays.columns("fields", mesh.fields, len(points))
    cell_data = _arrays.columns("cell_data", mesh.cell_data, len(cells))
    locked = None if mesh.locked is None else _arrays.flags("locked", mesh.locked, len(points))
    is_marked = mesh.faces is not None or mesh.locked_edges is not None
    last_uses = _last_uses(cells, len(points))

    def batches():
        begin = 0  # of the points that have not come
        for first in range(0, max(len(cells), 1), _STEP):
            part = slice(first, first + _STEP)
            is_end = first + _STEP >= len(cells)
            # Marked faces and edges come with the first batch, whose points must be there.
            end = len(points) if is_marked or is_end else max(begin, int(cells[part].max()) + 1)
            new = slice(begin, end)
            yield Batch(points=points[new], fields={c.name: c.rows[new] for c in fields},
                        locked=None if locked is None else locked[new], cells=cells[part],
                        last_uses=last_uses[part],
                        cell_data={c.name: c.rows[part] for c in cell_data},
                        **(dict(faces=mesh.faces, face_labels=face_labels_of(mesh),
                                locked_faces=mesh.locked_faces, locked_edges=mesh.locked_edges)
                           if first == 0 else {}))
            begin = end

    used = numpy.zeros(len(points), bool)  # points of no cell do not count
    used[cells] = True
    return Reader.batches(batches(), points=points.dtype,
                          fields={c.name: (c.rows.dtype, c.components) for c in fields},
                          cell_data={c.name: (c.rows.dtype, c.components) for c in cell_data},
                          vertex_count=len(points), cell_count=len(cells),
                          face_count=0 if mesh.faces is None else len(mesh.faces),
                          label_names=mesh.label_names, time=mesh.time,
                          box=_arrays.limits(points[used]) if len(cells) else None,
                          ranges={c.name: _arrays.limits(c.rows[used])
                                  for c in fields if len(cells)})
