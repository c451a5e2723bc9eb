"""Batches: the events of a stream, and what they are to the library."""
import numpy

from . import _announced, _arrays, _options, core
from .errors import BadArgument


class Batch:
    """Events of a stream: its points, then its cells in order. None, or nothing in a dict: there are
    none.

    points: [n][3], of the stream's type; they are numbered from 0 on through all batches.
    fields: dict of name to [n] or [n][components].
    locked: [n] of bool: points that are never moved.
    cells: [m][4], the numbers of points of this batch or earlier ones.
    last_uses: [m] of uint8; bit j: no later cell uses the point of corner j.
    cell_data: dict of name to [m] or [m][components].
    finalized: [k]: points that no later cell uses.
    faces: [f][3], labelled faces, with face_labels: [f], and locked_faces: [f] of bool.
    locked_edges: [e][2]: edges whose ends are never moved.
    """

    __slots__ = ("points", "fields", "locked", "cells", "last_uses", "cell_data", "finalized",
                 "faces", "face_labels", "locked_faces", "locked_edges")

    def __init__(self, points=None, cells=None, fields=None, cell_data=None, **more):
        for name in self.__slots__:
            setattr(self, name, more.pop(name, None))
        if more:
            raise TypeError(f"a Batch has no {', '.join(more)}")
        self.points, self.cells = points, cells
        self.fields = _arrays.named("fields", fields)
        self.cell_data = _arrays.named("cell_data", cell_data)

    def __repr__(self):
        points = 0 if self.points is None else len(self.points)
        cells = 0 if self.cells is None else len(self.cells)
        return f"<Batch of {points} points and {cells} cells>"


class Schema:
    """What a stream of batches carries, and how a Batch becomes the library's and back."""

    def __init__(self, info):
        self.info = info
        self.fields = [(info.field_name(i), _arrays.DTYPES[info.field_type(i)],
                        info.field_components(i)) for i in range(info.field_count())]
        self.cell_data = [(info.cell_data_name(i), _arrays.DTYPES[info.cell_data_type(i)],
                           info.cell_data_components(i)) for i in range(info.cell_data_count())]
        self.points = _arrays.DTYPES[info.position_type]

    @classmethod
    def announced(cls, points, fields, cell_data, label_names, time, counts, indexed=False,
                  box=None, ranges=None):
        info = core.StreamInfo()
        info.position_type = type_of("points", points)
        info.is_indexed = bool(indexed)
        for name, column in _columns("fields", fields):
            info.add_field(name, column[1], column[0])
        for name, column in _columns("cell_data", cell_data):
            info.add_cell_data(name, column[1], column[0])
        _announced.add(info, label_names, time)
        for name, count in counts.items():
            setattr(info, name, _options.whole(name, count))
        schema = cls(info)
        schema._announce_bounds(box, ranges)
        return schema

    def _announce_bounds(self, box, ranges):
        ranges = {name: limits for name, limits in _arrays.named("ranges", ranges).items()
                  if limits is not None}
        if box is None:
            if ranges:
                raise BadArgument("ranges: they count beside a box, which is not given")
            return
        names = [name for name, _, _ in self.fields]
        for name in sorted(set(ranges).symmetric_difference(names)):
            raise BadArgument(f'ranges: that of "{name}" is missing' if name in names else
                              f'ranges: "{name}" is no field')
        bounds = [_arrays.bounds("box", box, 3)]
        bounds += [_arrays.bounds(f'range of "{name}"', ranges[name], components)
                   for name, _, components in self.fields]
        for low, high in numpy.concatenate(bounds, axis=1).T.tolist():
            self.info.add_bound(low, high)

    def fill(self, target, batch):
        """Puts a Batch's arrays into the library's. The arrays, which the caller keeps until they
        have been read."""
        if isinstance(batch, dict):
            batch = Batch(**batch)
        if not isinstance(batch, Batch):
            raise TypeError(f"a reader gives a Batch or a dict, not {type(batch).__name__}")
        kept = []

        def put(function, array):
            kept.append(array)
            function(array)

        points, cells, faces = (_count(rows) for rows in (batch.points, batch.cells, batch.faces))
        if points:
            put(target.set_positions, _needs("points", batch.points, self.points, (points, 3)))
        self._put_columns(put, target.add_field, batch.fields, self.fields, points, "points")
        if _count(batch.locked) or (points and batch.locked is not None):
            put(target.set_locked, _arrays.flags("locked", batch.locked, points))
        if cells:
            put(target.set_cells, _arrays.wide_ids("cells", batch.cells, 4))
        self._put_columns(put, target.add_cell_data, batch.cell_data, self.cell_data, cells, "cells")
        if _count(batch.last_uses) or (cells and batch.last_uses is not None):
            put(target.set_last_uses, _arrays.bits("last_uses", batch.last_uses, cells))
        if not faces and (_count(batch.face_labels) or _count(batch.locked_faces)):
            raise BadArgument(NO_FACES)
        for name, columns in (("finalized", 1), ("faces", 3), ("face_labels", 1),
                              ("locked_edges", 2)):
            value = getattr(batch, name)
            if _count(value):
                put(getattr(target, "set_" + name), _arrays.wide_ids(name, value, columns))
        if faces and batch.locked_faces is not None:
            put(target.set_locked_faces, _arrays.flags("locked_faces", batch.locked_faces, faces))
        return kept

    @staticmethod
    def _put_columns(put, add, arrays, columns, rows, of):
        if not rows:
            filled = [name for name, values in arrays.items() if _count(values)]
            if filled:
                raise BadArgument(f'"{filled[0]}" has rows, and the batch has no {of}')
            return
        unknown = set(arrays) - {name for name, _, _ in columns}
        if unknown:
            raise BadArgument(f'"{sorted(unknown)[0]}" was not announced')
        for name, dtype, components in columns:
            if name not in arrays:
                raise BadArgument(f'"{name}" was announced, and is not in the batch')
            column = _arrays.Column(name, _numbers(arrays[name], dtype), rows)
            if column.components != components:
                raise BadArgument(f'"{name}": {column.components} numbers in a row, {components} '
                                  "were announced")
            put(add, _cast(name, column.rows, dtype))

    def batch(self, source):
        """A Batch with copies of the library's arrays."""
        flags = {name: None if array is None else array.astype(bool)
                 for name, array in (("locked", source.locked()),
                                     ("locked_faces", source.locked_faces()))}
        return Batch(
            points=_rows(source.positions(), 3, self.points), cells=_rows(source.cells(), 4, "i8"),
            fields={name: source.field(i) if _count(source.positions()) else
                    numpy.zeros((0, n)[:1 + (n > 1)], dtype)
                    for i, (name, dtype, n) in enumerate(self.fields)},
            cell_data={name: source.cell_data(i) if _count(source.cells()) else
                       numpy.zeros((0, n)[:1 + (n > 1)], dtype)
                       for i, (name, dtype, n) in enumerate(self.cell_data)},
            last_uses=source.last_uses(), finalized=source.finalized(), faces=source.faces(),
            face_labels=source.face_labels(), locked_edges=source.locked_edges(), **flags)


NO_FACES = "face_labels and locked_faces are of `faces`, which are not there"


def _count(array):
    return 0 if array is None else len(array)


def _rows(array, columns, dtype):
    return numpy.zeros((0, columns), dtype) if array is None else array


def _numbers(values, dtype):
    """Numbers that have no type yet, as those of a list, get the one that was announced."""
    return values if isinstance(values, numpy.ndarray) else numpy.asarray(values, dtype)


def _cast(name, array, dtype):
    if not numpy.can_cast(array.dtype, dtype, "safe"):
        raise TypeError(f"{name}: its numbers are {array.dtype}, {dtype} was announced")
    return numpy.require(array, dtype, ("C", "A"))


def _needs(name, values, dtype, shape):
    array = _numbers(values, dtype)
    if array.shape != shape:
        raise BadArgument(f"{name}: the shape is {array.shape}, {shape} is wanted")
    return _cast(name, array, dtype)


def type_of(name, dtype):
    dtype = numpy.dtype(dtype)
    if dtype not in _arrays.TYPES:
        raise TypeError(f"{name}: {dtype} is none of float32, float64, int32 and int64")
    return _arrays.TYPES[dtype]


def _columns(kind, announced):
    """Pairs of name and (type, components) of what the caller announces: a dict of name to dtype, to
    (dtype, components) or to None, for one float64."""
    for name, what in _arrays.named(kind, announced).items():
        dtype, components = what if isinstance(what, tuple) else (what, 1)
        yield name, (type_of(name, dtype or "f8"), components)
