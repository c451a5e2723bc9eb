"""Readers and writers: files, memory, arrays, generators and functions."""
import os
import weakref

import numpy

from . import _announced, _arrays, _mesh, _options, core
from ._batches import NO_FACES, Schema, type_of
from ._records import StreamInfo
from .errors import BadArgument, BadState, InputOutput, NoSuchFile


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
        self._schema = Schema(core.StreamInfo(info))
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
        _announced.add(info, mesh.label_names, mesh.time)
        kept += [column.rows for column in (*columns, *cell_columns)]

        def put(function, array):
            kept.append(array)
            function(array)

        if mesh.locked is not None:
            put(batch.set_locked, _arrays.flags("locked", mesh.locked, len(points)))
        if mesh.faces is not None:
            faces = _arrays.wide_ids("faces", mesh.faces, 3)
            labels = _mesh.face_labels_of(mesh)
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
                front_cells=-1, label_names=None, time=None, box=None, ranges=None):
        """A stream out of an iterable, such as a generator, of Batches or of dicts with a Batch's
        arguments.

        points: the type of the points, float32 or float64.
        fields, cell_data: dicts of name to dtype or to (dtype, components).
        indexed: nothing is finalized; the library orders the mesh before it is streamed.
        Counts and the front are told if they are known; the front sets the window, and labelled
            faces that are announced find room where the memory is limited.
        label_names, time: as of a Mesh.
        box, ranges: as a StreamInfo has them, if they are known: [2][3], the lowest and the highest
            coordinates, and of each field by its name [2][components], or [2] of one component.
            Errors are then measured in units of these from the first cell on, not in those of what
            has come.
        """
        schema = Schema.announced(points, fields, cell_data, label_names, time, {
            "vertex_count": vertex_count, "cell_count": cell_count, "face_count": face_count,
            "front_width": front_width, "front_span": front_span,
            "front_cells": front_cells}, indexed, box, ranges)
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
    schema = Schema(info)
    least, largest = info.box_min(), info.box_max()
    box = None if least is None or largest is None else numpy.stack([least, largest])
    ranges, at = {}, 3
    for name, _, components in schema.fields:
        ranges[name] = None if box is None else box[:, at:at + components]
        at += components
    return StreamInfo(position_type=schema.points,
                      fields={name: (dtype, n) for name, dtype, n in schema.fields},
                      cell_data={name: (dtype, n) for name, dtype, n in schema.cell_data},
                      label_names=_announced.names_of(info), time=_announced.time_of(info),
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
        collector = core.MeshCollector(type_of("cells", cell_type))
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
