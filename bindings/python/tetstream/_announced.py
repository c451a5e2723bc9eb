"""What a mesh has besides arrays: names of labels, a dict of a cell array's name, or None for
labelled faces, to a dict of label to name; and the time of its values, or None."""
import operator

from . import _arrays, _options


def add(info, label_names, time):
    """Announces both in a StreamInfo of the library's."""
    _add_names(info, label_names)
    if time is not None:
        info.time, info.is_timed = _options.real("time", time), True


def _add_names(info, names):
    for array, of_labels in _arrays.named("label_names", names).items():
        if not hasattr(of_labels, "items"):
            raise TypeError(f"label_names of {_shown(array)}: a dict of label to name is wanted, "
                            f"not {type(of_labels).__name__}")
        for label, name in of_labels.items():
            info.add_label_name(array, _integer(array, label), name)


def time_of(info):
    """The time that a StreamInfo of the library's has, or None."""
    return info.time if info.is_timed else None


def names_of(info):
    """The names that it has."""
    names = {}
    for i in range(info.label_name_count()):
        of_labels = names.setdefault(info.label_name_cell_array(i) or None, {})
        of_labels[info.label_name_label(i)] = info.label_name_text(i)
    return names


def _integer(array, label):
    try:
        return operator.index(label)
    except TypeError:
        raise TypeError(f"label_names of {_shown(array)}: {label!r} is no integer") from None


def _shown(array):
    return "faces" if array is None else repr(array)
