"""What is done with meshes besides simplifying them."""
import functools

from . import _mesh, _options, _progress, _streams, core
from ._records import LayoutReport, Record
from .errors import BadState


@_options.documented(core.SCOPE_ORDER)
def layout(source, target, *, progress=None, **options):
    """Brings a mesh into an order and writes it as a stream, in bounded memory. Sources, targets
    and progress as in simplify_file. Returns a LayoutReport."""
    made = _options.made(options, core.SCOPE_ORDER)
    with _progress.told(progress) as tell:
        reader, writer = _streams.reader_of(source, made, tell), _streams.writer_of(target)
        report = writer._handle.layout(reader._handle, made._handle, tell)
    return _streams.noted(LayoutReport.copied(report), reader, writer)


@_options.documented(core.SCOPE_ORDER)
def convert(source, target, *, progress=None, **options):
    """Reads everything and writes it; an indexed mesh is brought into an order. Sources, targets
    and progress as in simplify_file. Returns the notes of both."""
    made = _options.made(options, core.SCOPE_ORDER)
    with _progress.told(progress) as tell:
        reader, writer = _streams.reader_of(source, made, tell), _streams.writer_of(target)
        writer._handle.convert(reader._handle, made._handle, tell)
    return reader.notes + writer.notes


@_options.documented(core.SCOPE_ORDER)
def read(source, *, cell_type="int64", progress=None, **options):
    """A Mesh of everything a file, or a Reader, has. A stream keeps its order; the cells of an
    indexed mesh come in that of a sweep, points as they are used first, those of no cell left
    out."""
    writer = _streams.Writer.arrays(cell_type)
    convert(source, writer, progress=progress, **options)
    return writer.getmesh()


@_options.documented(core.SCOPE_ORDER)
def info(source, *, progress=None, **options):
    """Reads everything and tells what it is: a StreamInfo, complete. An indexed mesh's front is that
    of the order in which it is streamed."""
    made = _options.made(options, core.SCOPE_ORDER)
    with _progress.told(progress) as tell:
        reader = _streams.reader_of(source, made, tell)
        found = reader._handle.inspect(made._handle, tell)
    handle = reader._handle
    labels = [handle.get_face_label(i) for i in range(handle.face_label_count())]
    return _streams.stream_info(found, front=Record.copied(handle.get_front()),
                                face_labels={label.label: label.faces for label in labels},
                                notes=reader.notes)


# ----------------------------------------------------------------------------------- diagrams


def _needs_pen(record):
    """What draws a record's picture: of what was read, which stays with the library."""
    try:
        return record._pen
    except AttributeError:
        raise BadState("the picture is drawn by what diagram() or compare() gave: copies have the "
                       "figures alone") from None


class Diagram(Record):
    """The layout diagram of a stream: how good its order is.

    cells across, vertices down; coverage: [rows][columns] of float32, 0 to 1, how much of a place
    the vertices' lives cover; widths, lowest, newest: [columns] of int64: active vertices at most,
    the lowest active vertex, the newest one; front_width, mean_width and the other members of
    tetstream_diagram_info in tetstream_diagram(3). Copies, and what was pickled, do not write().
    """

    __slots__ = ("_pen",)  # not among vars()

    def plot(self, ax=None, **look):
        """Draws it on an axis of matplotlib's, which is returned; a new one if `ax` is None. `look`
        goes to imshow."""
        if ax is None:
            from matplotlib import pyplot
            ax = pyplot.figure().add_subplot()
        extent = (0, self.cell_count, self.vertex_count, 0)
        ax.imshow(self.coverage, **{"cmap": "Blues", "vmin": 0, "vmax": 1, "aspect": "auto",
                                    "extent": extent, "interpolation": "nearest", **look})
        ax.set_xlabel("cells")
        ax.set_ylabel("vertices")
        ax.set_title(f"front: {self.front_width} vertices, span {self.front_span}")
        return ax

    def write(self, path, title=None):
        """Draws the whole page into an SVG or PNG file, by the path's ending."""
        _needs_pen(self)(path, title)

    def __repr__(self):
        return (f"<Diagram of {self.cell_count} cells; front of {self.front_width} vertices, "
                f"span {self.front_span}>")


@_options.documented(core.SCOPE_ORDER)
def diagram(source, *, columns=1200, rows=800, sweep=False, progress=None, **options):
    """The layout diagram of a stream: a Diagram, to plot on an axis of matplotlib's or to write
    into a picture.

    Args:
        source: a path, a Reader or a Mesh, which is shown as it would be streamed.
        columns, rows: of the raster, at most.
        sweep: write() draws the mesh at four moments of its stream instead.
        progress: as in simplify.
    """
    made = _options.made(options, core.SCOPE_ORDER)
    page = core.PAGE_SWEEP if sweep else core.PAGE_LAYOUT
    drawn = core.Diagram(made._handle, _options.whole("columns", columns, 32),
                         _options.whole("rows", rows, 32))
    with _progress.told(progress) as tell:
        reader = _streams.reader_of(source, made, tell)
        drawn.read(reader._handle, page, tell)
    figures = Diagram.copied(drawn.get_info(), coverage=drawn.coverage(), widths=drawn.widths(),
                             lowest=drawn.lowest(), newest=drawn.newest(), notes=reader.notes)
    figures._pen = functools.partial(drawn.write, page)
    return figures


# -------------------------------------------------------------------------------- comparisons


class Comparison(Record):
    """How well a simplified mesh stands for its original.

    original, simplified: figures of each: cells, volume, components, least_angle, ...
    fields: dict of name to the error of the field: rms, rms_percent (of the range), largest, ...
    regions: dict of label to figures; labels: what was taken as labels, in words.
    only_original, only_simplified: names of fields that the other mesh does not have.
    face_labels: dict of label to figures of the labelled faces.
    topology_kept, distance (between boundaries), outside_volume and the other members of
    tetstream_comparison_info in tetstream_comparison(3), lengths in the meshes' units. Copies, and
    what was pickled, do not write().
    """

    __slots__ = ("_pen",)  # not among vars()

    def write(self, path, title=None):
        """Draws a cut through both into an SVG or PNG file; needs the option `cut`."""
        _needs_pen(self)(path, title)

    def __repr__(self):
        errors = ", ".join(f"{name} {field.rms_percent:.3g} %" for name, field in
                           self.fields.items())
        return (f"<Comparison of {self.original.cells} cells with {self.simplified.cells}; "
                f"RMS errors: {errors or 'no fields'}>")


@_options.documented(core.SCOPE_COMPARE)
def compare(original, simplified, *, weights=None, progress=None, **options):
    """Compares two meshes: a Comparison.

    Args:
        original, simplified: each a path, a Reader or a Mesh. Options of the reading are for the
            original, and for the other where it is a file that takes them.
        weights: dict of field to weight: only these are compared, those of weight 0 left out. None:
            all fields that both have, with as many components, those of integers too.
        progress: as in simplify.
    """
    made = _options.made(options, core.SCOPE_COMPARE, weights)
    compared = core.Comparison(made._handle)
    with _progress.told(progress) as tell:
        readers = (_streams.reader_of(original, made, tell),
                   _streams.result_of(simplified, made, tell))
        compared.read(readers[0]._handle, readers[1]._handle, tell)
    figures = compared.get_info()
    fields = [Record.copied(compared.get_field(i)) for i in range(figures.field_count)]
    regions = [Record.copied(compared.get_region(i)) for i in range(figures.region_count)]
    faces = [Record.copied(compared.get_face_label(i)) for i in range(figures.face_label_count)]
    found = Comparison.copied(
        figures, original=Record.copied(compared.get_mesh(core.ORIGINAL)),
        simplified=Record.copied(compared.get_mesh(core.SIMPLIFIED)),
        fields={field.name: field for field in fields},
        regions={region.label: region for region in regions}, labels=figures.regions,
        only_original=[name for name in figures.only_original.split("\n") if name],
        only_simplified=[name for name in figures.only_simplified.split("\n") if name],
        face_labels={label.label: label for label in faces},
        notes=[note for reader in readers for note in reader.notes])
    found._pen = compared.write
    return found


def formats():
    """The file formats: a list of records with name, extensions, text, can_read, can_write."""
    rows = []
    while (row := core.format_at(len(rows))).name is not None:
        rows.append(Record.copied(row))
    for row in rows:
        row.can_read, row.can_write = bool(row.can_read), bool(row.can_write)
    return rows
