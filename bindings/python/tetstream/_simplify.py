"""The simplification: of arrays, of files, of streams."""
import warnings

import numpy

from . import _arrays, _batches, _mesh, _options, _progress, _streams, core
from ._records import Report
from .errors import TargetMissedWarning

_TARGETS = ("ratio", "cells", "error")


def _made_options(options, weights):
    made = _options.made(options, core.SCOPE_SIMPLIFY, weights)
    if not any(getattr(made, target) for target in _TARGETS):
        raise TypeError("a target is missing: give ratio= (cells out / cells in), cells= or error= "
                        "(percent of the fields' range)")
    return made


def _run(options, reader, writer, tell, prepare, depth):
    """One simplification; `prepare` is called with the simplifier before. The Report."""
    simplifier = core.Simplifier(options._handle, writer._handle, tell)
    prepare(simplifier)
    simplifier.run(reader._handle)
    return _reported(simplifier, depth, reader, writer)


def _reported(simplifier, depth, *handles):
    """The Report; a missed target is a warning at the frame of the caller, `depth` frames up."""
    report = _streams.noted(Report.copied(simplifier.get_report()), *handles)
    if report.limited_by:
        warnings.warn(f"the target of {report.target_cells} cells was missed, {report.cells_out} "
                      f"are left; limited by: {report.limited_by}", TargetMissedWarning,
                      stacklevel=depth)
    return report


def _with_regions(mesh, regions, options):
    """The mesh with labels of its own as a cell array, one more unless they are one of its own, and
    the option that names it."""
    if regions is None:
        return mesh, options
    if isinstance(regions, str):
        return mesh, {**options, "regions": regions}
    for name, array in mesh.cell_data.items():
        if array is regions:
            return mesh, {**options, "regions": name}
    name = "region"
    while name in mesh.cell_data or name in mesh.label_names:
        name += "_"
    regions, cells = numpy.asanyarray(regions), len(mesh.cells)
    _arrays.needs_shape("regions", regions, f"[{cells}]", regions.shape == (cells,))
    labelled = _mesh.Mesh(mesh.points, mesh.cells, mesh.fields,
                          {**mesh.cell_data, name: regions}, locked=mesh.locked, faces=mesh.faces,
                          face_labels=mesh.face_labels, locked_faces=mesh.locked_faces,
                          locked_edges=mesh.locked_edges, label_names=mesh.label_names,
                          time=mesh.time)
    return labelled, {**options, "regions": name}


def simplify_mesh(mesh, *, regions=None, weights=None, vertex_map=False, progress=None, **options):
    """tetstream.simplify of a Mesh."""
    labelled, options = _with_regions(mesh, regions, options)
    made = _made_options(options, weights)
    _options.refuse_reading(made, "arrays")
    points, cells, columns, cell_columns = _streams.mesh_columns(labelled)
    collector = core.MeshCollector(_arrays.TYPES[cells.dtype])
    reader = _streams.Reader._of_columns(labelled, points, cells, columns, cell_columns)
    writer = _streams.Writer(core.Writer.collect(collector))
    mapped = core.MapCollector(len(points)) if vertex_map else None

    def prepare(simplifier):
        if vertex_map:
            simplifier.set_map(mapped)

    with _progress.told(progress) as tell:
        report = _run(made, reader, writer, tell, prepare, 5)
    result = _mesh.collected(collector, columns, cell_columns, _mesh.Simplified)
    result.report = report
    if regions is not None and not isinstance(regions, str):
        result.regions = result.cell_data[options["regions"]]
    if vertex_map:
        result.vertex_map = _mesh.VertexMap(mapped.cells(), mapped.weights(), result.cells,
                                            len(result.points))
    return result


@_options.documented(core.SCOPE_SIMPLIFY, reads=False)
def simplify(points, tetrahedra, /, fields=None, *, cell_data=None, regions=None, locked=None,
             faces=None, face_labels=None, locked_faces=None, locked_edges=None, label_names=None,
             time=None, weights=None, vertex_map=False, progress=None, **options):
    """Simplifies a mesh in arrays: ``simplify(points, cells, {"p": p}, ratio=0.1)``.

    Dense arrays of the types below are read where they lie; others are copied first. Memory beyond
    the arrays is that of the window and of ordering.

    Args:
        points: [n][3], float32 or float64, in any unit of length.
        tetrahedra: [m][4], int32 or int64, the cells: points from 0, in either orientation.
        fields: dict of name to [n] or [n][components], values at the points, in any units. Floats
            are interpolated, integers picked.
        cell_data: dict of name to [m] or [m][components]. Floats are averaged by volume, integers
            picked.
        regions: [m], integers: the region of each cell; regions and the interfaces between them are
            kept, and the result has `regions`, too, which is also one of its `cell_data`: "region"
            unless they are one of those that were given. Or the name of one of `cell_data`, "auto"
            or "none", as the option.
        locked: [n] of bool: points that are never moved.
        faces: [f][3], labelled faces of cells, with `face_labels`: [f], and `locked_faces`: [f] of
            bool; `locked_edges`: [e][2].
        label_names: names of labels, as of a Mesh, and
        time: of the values, which the result has, too.
        weights: dict of field to its weight in the error; others are then only carried along. None:
            all float fields count alike.
        vertex_map: whether the result tells where each point went.
        progress: a function that is called with a Progress some times a second, on the thread of
            the caller; True: a bar, with tqdm. What it raises ends the run.
        **options: the target, one or more of `ratio`, `cells` and `error`, of which the first that
            is reached ends the run, and what else is listed below.

    Returns:
        A Simplified: points, cells, fields, cell_data, report, vertex_map. Fields and cell_data of
        integers have the types that they came with, of others points and floats are float32 or
        float64, cells int32 or int64.

    Raises:
        tetstream.Error or one of its kinds, TypeError, or what `progress` raised. KeyboardInterrupt
        ends a run within a second.

    Warns:
        TargetMissedWarning: where the result has more cells than asked for.
    """
    mesh = _mesh.Mesh(points, tetrahedra, fields, cell_data, locked=locked, faces=faces,
                      face_labels=face_labels, locked_faces=locked_faces,
                      locked_edges=locked_edges, label_names=label_names, time=time)
    return simplify_mesh(mesh, regions=regions, weights=weights, vertex_map=vertex_map,
                         progress=progress, **options)


@_options.documented(core.SCOPE_SIMPLIFY)
def simplify_file(source, target, *, weights=None, map_file=None, log_file=None, progress=None,
                  **options):
    """Simplifies a file into another, in memory that depends on the front and not on the mesh:
    ``simplify_file("jet.vtu", "jet-10.vtu", ratio=0.1)``. The bytes are those of the command
    `tetstream simplify` with the same options.

    Args:
        source: a path, a Reader or a Mesh.
        target: a path or a Writer.
        weights, progress: as in simplify.
        map_file: where a map of the vertices is written, .tetmap or .csv.
        log_file: where the log of collapses is written, .tetlog or .csv.
        **options: as in simplify.

    Returns:
        A Report.
    """
    def prepare(simplifier):
        if map_file is not None:
            simplifier.set_map_file(map_file, None)
        if log_file is not None:
            simplifier.set_log_file(log_file, None)

    # The options first, then the source: nothing is created where one of them is refused.
    made = _made_options(options, weights)
    with _progress.told(progress) as tell:
        reader = _streams.reader_of(source, made, tell)
        return _run(made, reader, _streams.writer_of(target), tell, prepare, 4)


@_options.documented(core.SCOPE_SIMPLIFY, reads=False)
def simplify_batches(batches, points="float64", fields=None, cell_data=None, *, weights=None,
                     vertex_count=-1, cell_count=-1, face_count=-1, front_width=-1, front_span=-1,
                     front_cells=-1, label_names=None, time=None, box=None, ranges=None, **options):
    """Simplifies a stream as a generator: takes Batches, gives Batches, while the input runs.

        for batch in tetstream.simplify_batches(solver(), fields={"p": "float64"}, ratio=0.1):
            ...

    Args:
        batches: an iterable of Batches, or of dicts with a Batch's arguments.
        points, fields, cell_data, counts, front, label_names, time, box, ranges: as in
            Reader.batches.
        weights, **options: as in simplify. A ratio needs `cell_count` to be met early.

    Yields:
        Batches of the result, in final form: what was given is never changed.

    Returns:
        A Report, as the generator's value.
    """
    schema = _batches.Schema.announced(points, fields, cell_data, label_names, time, {
        "vertex_count": vertex_count, "cell_count": cell_count, "face_count": face_count,
        "front_width": front_width, "front_span": front_span, "front_cells": front_cells},
        box=box, ranges=ranges)
    ready = []
    writer = _streams.Writer.batches(ready.append)
    made = _made_options(options, weights)
    _options.refuse_reading(made, "a stream")
    simplifier = core.Simplifier(made._handle, writer._handle, None)
    return _pushed(schema, simplifier, writer, ready, batches)


def _pushed(schema, simplifier, writer, ready, batches):
    simplifier.begin(schema.info)
    for batch in batches:
        events = core.StreamBatch()
        kept = schema.fill(events, batch)  # noqa: F841  alive until they have been read
        simplifier.push(events)
        yield from ready
        ready.clear()
    simplifier.finish()
    yield from ready
    return _reported(simplifier, 3, writer)
