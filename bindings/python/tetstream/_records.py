"""Figures that the library hands out, copied into plain objects."""
import types


class Record(types.SimpleNamespace):
    """Named figures. ``vars(record)`` is a dict of them."""

    @classmethod
    def copied(cls, struct, **more):
        """The members of one of the library's structs, whose texts may not live as long; `more` has
        members beside or in place of those."""
        kind = type(struct)
        names = (name for name in vars(kind)
                 if isinstance(vars(kind)[name], property) and name != "thisown")
        return cls(**{**{name: getattr(struct, name) for name in names}, **more})


class Progress(Record):
    """How far a run is: ``fraction`` of the whole, 0 to 1, or -1 where it is not known; ``phase``,
    a word; ``cells_read``, ``cells_total`` (-1: not known), ``cells_written``;
    ``temporary_bytes``, of disk that ordering takes."""


class Report(Record):
    """What a simplification came to: ``cells_in``, ``cells_out``, ``vertices_in``,
    ``vertices_out``, ``target_cells``, ``reached`` (the target that ended the run, or ""),
    ``limited_by`` (what stopped it short of its target, or ""), ``estimated_error`` (RMS, percent
    of the fields' range), ``volume_in`` and ``volume_out`` (of all cells), ``seconds`` and the
    other members of ``tetstream_report`` in tetstream_simplifier(3); ``notes``, sentences on what
    the reader and the writer left out or assumed."""


class LayoutReport(Record):
    """What bringing a mesh into an order came to: ``order``, ``vertices``, ``cells``,
    ``front_width``, ``seconds`` and the other members of ``tetstream_layout_report``."""


class StreamInfo(Record):
    """What a stream carries: ``position_type``; ``fields`` and ``cell_data``, each a dict of name
    to (numpy dtype, components); ``vertex_count``, ``cell_count``, ``face_count`` (labelled
    faces); the front, in ``front_width``, ``front_span``, ``front_cells``, and ``front``, which
    has more; ``box``, [2][3]: least and largest coordinates; ``ranges``, a dict of field to
    [2][components]: least and largest values; ``label_names`` and ``time``, as of a Mesh;
    ``indexed``; ``notes``. Counts that are not known are -1, boxes None. ``front`` and
    ``face_labels``, a dict of label to the number of its faces (empty where more than 65536 number
    the faces), are there where all was read."""
