"""Readers and writers: files, memory, arrays, generators and functions."""
import os
import weakref

import numpy

from . import _arrays, _labels, _mesh, _options, core
from ._records import Record, StreamInfo
from .errors import BadArgument, BadState, InputOutput, NoSuchFile


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


class _Schema:
    """What a stream of batches carries, and how a Batch becomes the library's and back."""

    def __init__(self, info):
        self.info = info
        self.fields = [(info.field_name(i), _arrays.DTYPES[info.field_type(i)],
                        info.field_components(i)) for i in range(info.field_count())]
        self.cell_data = [(info.cell_data_name(i), _arrays.DTYPES[info.cell_data_type(i)],
                           info.cell_data_components(i)) for i in range(info.cell_data_count())]
        self.points = _arrays.DTYPES[info.position_type]

    @classmethod
    def announced(cls, points, fields, cell_data, label_names, counts, indexed=False):
        info = core.StreamInfo()
        info.position_type = _type("points", points)
        info.is_indexed = bool(indexed)
        for name, column in _columns("fields", fields):
            info.add_field(name, column[1], column[0])
        for name, column in _columns("cell_data", cell_data):
            info.add_cell_data(name, column[1], column[0])
        _labels.add(info, label_names)
        for name, count in counts.items():
            setattr(info, name, _options.whole(name, count))
        return cls(info)

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


def _type(name, dtype):
    dtype = numpy.dtype(dtype)
    if dtype not in _arrays.TYPES:
        raise TypeError(f"{name}: {dtype} is none of float32, float64, int32 and int64")
    return _arrays.TYPES[dtype]


def _columns(kind, announced):
    """Pairs of name and (type, components) of what the caller announces: a dict of name to dtype, to
    (dtype, components) or to None, for one float64."""
    for name, what in _arrays.named(kind, announced).items():
        dtype, components = what if isinstance(what, tuple) else (what, 1)
        yield name, (_type(name, dtype or "f8"), components)


def _notes(handle):
    notes = []
    while (note := handle.note(len(notes))) is not None:
        notes.append(note)
    return notes


def _lent(method):
    """The method as the library gets it, without its object, which a Reader or a Writer keeps:
    Python's collector does not see what the library keeps, and whoever owns a Writer of a method of
    his own would never end."""
    method = weakref.WeakMethod(method)
    return lambda argument: method()(argument)


class _Giver:
    """What a Reader of batches is asked."""

    def __init__(self, schema, batches):
        self._schema, self._batches, self._kept = schema, iter(batches), []

    def give(self, target):
        # note: an empty batch ends the library's stream; an iterable may give some.
        for batch in self._batches:
            self._kept = self._schema.fill(target, batch)
            if self._kept and not self._is_empty(target):
                return
        self._kept = []

    @staticmethod
    def _is_empty(target):
        return all(array is None for array in (
            target.positions(), target.cells(), target.finalized(), target.faces(),
            target.locked_edges()))


class _Taker:
    """What a Writer of batches calls."""

    def __init__(self, put, open, finish):
        self._put, self._open, self._finish, self._schema = put, open, finish, None

    def begin(self, info):
        self._schema = _Schema(core.StreamInfo(info))
        if self._open is not None:
            self._open(stream_info(info, notes=[]))

    def take(self, batch):
        self._put(self._schema.batch(batch))

    def end(self, _):
        if self._finish is not None:
            self._finish()


class Reader:
    """Where a mesh comes from. It serves one run.

    Made by Reader.file, Reader.memory, Reader.mesh, Reader.stream, Reader.generate and
    Reader.batches; functions that read also take a path, or a Mesh, in its place.
    """

    def __init__(self, handle, *kept):
        # What the library calls, or arrays that it reads where they lie.
        self._handle, self._kept = handle, kept

    @classmethod
    def file(cls, path, format=None, **options):
        """A file; `format` is a name such as "vtu", or None: by the path's ending. Options of the
        reading, such as `step` or `split`, count here alone."""
        made = _options.made(options, core.SCOPE_READ)
        return cls(_opened(core.Reader.open_file, path, format, made))

    @classmethod
    def memory(cls, data, format, **options):
        """The bytes of a file: a bytes object or another buffer. Options as of Reader.file."""
        array = numpy.frombuffer(data, numpy.uint8)
        made = _options.made(options, core.SCOPE_READ)
        return cls(core.Reader.open_memory(array, format, made._handle), array)

    @classmethod
    def mesh(cls, mesh):
        """An indexed Mesh, whose arrays are not copied if they are dense and of types that the
        library has. They must stay as they are until the run is over."""
        return cls._of_columns(mesh, *mesh_columns(mesh))

    @classmethod
    def _of_columns(cls, mesh, points, cells, columns, cell_columns):
        info, batch = core.StreamInfo(), core.StreamBatch()
        kept = [points, cells]
        info.position_type = _arrays.TYPES[points.dtype]
        batch.set_positions(points)
        batch.set_cells(cells)
        for column in columns:
            info.add_field(column.name, column.components, column.type)
            batch.add_field(column.rows)
        for column in cell_columns:
            info.add_cell_data(column.name, column.components, column.type)
            batch.add_cell_data(column.rows)
        _labels.add(info, mesh.label_names)
        kept += [column.rows for column in (*columns, *cell_columns)]

        def put(function, array):
            kept.append(array)
            function(array)

        if mesh.locked is not None:
            put(batch.set_locked, _arrays.flags("locked", mesh.locked, len(points)))
        if mesh.faces is not None:
            faces = _arrays.wide_ids("faces", mesh.faces, 3)
            labels = numpy.zeros(len(faces), int) if mesh.face_labels is None else mesh.face_labels
            put(batch.set_faces, faces)
            put(batch.set_face_labels, _arrays.wide_ids("face_labels", labels, 1))
            if mesh.locked_faces is not None:
                put(batch.set_locked_faces,
                    _arrays.flags("locked_faces", mesh.locked_faces, len(faces)))
        elif mesh.face_labels is not None or mesh.locked_faces is not None:
            raise BadArgument(NO_FACES)
        if mesh.locked_edges is not None:
            put(batch.set_locked_edges, _arrays.wide_ids("locked_edges", mesh.locked_edges, 2))
        return cls(core.Reader.open_mesh(info, batch, False), kept)

    @classmethod
    def stream(cls, mesh):
        """A Mesh as a stream: its points and cells come in the order that they have, finalized where
        they can be. Labelled faces and locked edges come first, and all points with them."""
        return _mesh.batches_of(mesh)

    @classmethod
    def generate(cls, kind, cells, seed=1):
        """A mesh made on the fly, of about that many cells: "fluid", "ball", "fluid+stress",
        "ball+stress"."""
        return cls(core.Reader.generate(kind, _options.whole("cells", int(cells)),
                                        _options.whole("seed", seed)))

    @classmethod
    def batches(cls, batches, points="float64", fields=None, cell_data=None, *, indexed=False,
                vertex_count=-1, cell_count=-1, face_count=-1, front_width=-1, front_span=-1,
                front_cells=-1, label_names=None):
        """A stream out of an iterable, such as a generator, of Batches or of dicts with a Batch's
        arguments.

        points: the type of the points, float32 or float64.
        fields, cell_data: dicts of name to dtype or to (dtype, components).
        indexed: nothing is finalized; the library orders the mesh before it is streamed.
        Counts and the front are told if they are known; the front sets the window, and labelled
            faces that are announced find room where the memory is limited.
        label_names: as of a Mesh.
        """
        schema = _Schema.announced(points, fields, cell_data, label_names, {
            "vertex_count": vertex_count, "cell_count": cell_count, "face_count": face_count,
            "front_width": front_width, "front_span": front_span,
            "front_cells": front_cells}, indexed)
        giver = _Giver(schema, batches)
        return cls(core.Reader.create(schema.info, _lent(giver.give)), giver)

    def info(self):
        """What is known without reading: a StreamInfo."""
        return stream_info(self._handle.get_info(), notes=self.notes)

    @property
    def notes(self):
        """Sentences on what was left out or assumed."""
        return _notes(self._handle)


def stream_info(info, **more):
    """A StreamInfo of the library's."""
    schema = _Schema(info)
    least, largest = info.box_min(), info.box_max()
    box = None if least is None or largest is None else numpy.stack([least, largest])
    ranges, at = {}, 3
    for name, _, components in schema.fields:
        ranges[name] = None if box is None else box[:, at:at + components]
        at += components
    return StreamInfo(position_type=schema.points,
                      fields={name: (dtype, n) for name, dtype, n in schema.fields},
                      cell_data={name: (dtype, n) for name, dtype, n in schema.cell_data},
                      label_names=_labels.of(info),
                      vertex_count=info.vertex_count, cell_count=info.cell_count,
                      face_count=info.face_count,
                      front_width=info.front_width, front_span=info.front_span,
                      front_cells=info.front_cells, indexed=info.is_indexed,
                      box=None if box is None else box[:, :3], ranges=ranges, **more)


def mesh_columns(mesh):
    """Points, cells, fields and cell data of a Mesh as the library takes them."""
    points, cells = _arrays.points(mesh.points), _arrays.cells(mesh.cells)
    return (points, cells, _arrays.columns("fields", mesh.fields, len(points)),
            _arrays.columns("cell_data", mesh.cell_data, len(cells)))


class Writer:
    """Where a mesh goes. It serves one run.

    Made by Writer.file, Writer.memory, Writer.arrays and Writer.batches; functions that write also
    take a path in its place.
    """

    def __init__(self, handle, kept=None):
        self._handle, self._kept, self._mesh = handle, kept, None

    def _with(self, properties):
        for name, value in properties.items():
            self._handle.set(name, value)
        return self

    @classmethod
    def file(cls, path, format=None, **properties):
        """A file, which takes its name when it is complete. `format` as in Reader.file; `properties`
        of the format: compress="yes" or "no" (.tets, .vtu, .vtkhdf), order="pre" or "post" (.sva,
        .svb), encoding="binary" or "text" and version="4.1" or "2.2" (.msh)."""
        return cls(core.Writer.create_file(path, format))._with(properties)

    @classmethod
    def memory(cls, format, **properties):
        """The bytes of a file, which getbytes() gives when the run is over."""
        return cls(core.Writer.create_memory(format))._with(properties)

    @classmethod
    def arrays(cls, cell_type="int64"):
        """Arrays: getmesh() gives a Mesh when the run is over. `cell_type`: int32 or int64."""
        collector = core.MeshCollector(_type("cells", cell_type))
        return cls(core.Writer.collect(collector), collector)

    @classmethod
    def batches(cls, put, open=None, finish=None):
        """A function that is called with each Batch; or a generator, to which each is sent, which is
        closed at the end.

        open: called first, with a StreamInfo; finish: called after a complete stream; or None.
        """
        if hasattr(put, "send"):
            put, finish = _sending(put), _closing(put, finish)
        elif not callable(put):
            raise TypeError(f"a function or a generator is wanted, not {type(put).__name__}")
        taker = _Taker(put, open, finish)
        functions = (_lent(method) for method in (taker.begin, taker.take, taker.end))
        return cls(core.Writer.create(*functions), taker)

    def getbytes(self):
        """The bytes of a Writer.memory; BadState unless its run is over and did not fail."""
        return self._handle.get_memory().tobytes()

    def getmesh(self):
        """The Mesh of a Writer.arrays, the same one each time; BadState unless its run is over and
        did not fail."""
        if not isinstance(self._kept, core.MeshCollector):
            raise BadState("the writer does not write to arrays")
        if self._mesh is None:
            self._mesh = _mesh.collected(self._kept)
        return self._mesh

    @property
    def notes(self):
        """Sentences on what the format could not hold and was left out."""
        return _notes(self._handle)


def _sending(generator):
    """A function that sends to a generator."""
    def send(batch):
        try:
            generator.send(batch)
        except StopIteration:
            raise RuntimeError("the generator that takes batches ended before they did") from None
    next(generator)
    return send


def _closing(generator, finish):
    def end():
        generator.close()
        if finish is not None:
            finish()
    return end


def _opened(open_file, path, format, options):
    """The library's reader of a file."""
    try:
        return open_file(path, format, options._handle)
    except InputOutput as failure:
        # The library's status does not tell which refusal it was.
        try:
            os.stat(path)
        except FileNotFoundError as missing:
            raise NoSuchFile(missing.errno, str(failure), os.fspath(path)) from None
        except OSError:
            pass
        raise


def _reader_of(source, open_file, options, tell):
    if isinstance(source, (str, bytes, os.PathLike)):
        options._handle.set_progress(tell)
        return Reader(_opened(open_file, source, None, options))
    if isinstance(source, Reader):
        return source
    if isinstance(source, _mesh.Mesh):
        return Reader.mesh(source)
    raise TypeError(f"a path, a Mesh or a Reader is wanted, not {type(source).__name__}")


def reader_of(source, options, tell):
    """A Reader of what somebody calls a source; `tell` is called while a file is opened."""
    if isinstance(source, (Reader, _mesh.Mesh)):
        _options.refuse_reading(options, f"a {type(source).__name__}")
    return _reader_of(source, core.Reader.open_file, options, tell)


def result_of(source, options, tell):
    """The same for what is compared with a source: of the options of the reading those count that
    it takes."""
    return _reader_of(source, core.Reader.open_result, options, tell)


def writer_of(target):
    """A Writer of what somebody calls a target."""
    if isinstance(target, Writer):
        return target
    if isinstance(target, (str, bytes, os.PathLike)):
        return Writer.file(target)
    raise TypeError(f"a path or a Writer is wanted, not {type(target).__name__}")


def noted(record, *handles):
    """The record with the notes of readers and writers."""
    record.notes = [note for handle in handles for note in handle.notes]
    return record
