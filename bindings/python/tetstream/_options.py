"""The library's options as properties and as a mapping, made from its own table."""
import collections.abc
import difflib
import functools
import operator

import numpy

from . import _arrays, core
from .errors import BadArgument


class _Row:
    """A row of the table."""

    def __init__(self, index):
        info = core.option_at(index)
        self.id, self.type, self.flag = info.id, info.type, info.name
        self.text, self.default, self.choices = info.text, info.default_text, info.choices
        self.minimum, self.maximum, self.scope = info.minimum, info.maximum, info.scope
        self.name = self.flag.replace("-", "_")

    def range_text(self):
        if self.type == core.OPTION_IS_TEXT:
            return f"one of: {self.choices}" if self.choices else "text"
        kind = "int" if self.type == core.OPTION_IS_INT64 else "float"
        if abs(self.maximum) >= 2.0 ** 63 or self.minimum < 0:
            return kind
        return f"{kind}, {self.minimum:g} to {self.maximum:g}"

    def describe(self):
        default = f"; default {self.default}" if self.default else ""
        return f"{self.text} ({self.range_text()}{default})"

    def describe_for(self, scope):
        """As for a function: there no target stands in for one that is missing."""
        if self.name == "ratio" and scope == core.SCOPE_SIMPLIFY:
            return f"cells out / cells in; 0: not asked for ({self.range_text()}; default 0)"
        return self.describe()

    def get(self, handle):
        if self.type == core.OPTION_IS_INT64:
            return handle.get_int64(self.id)
        if self.type == core.OPTION_IS_DOUBLE:
            return handle.get_double(self.id)
        return handle.get_text(self.id)

    def set(self, handle, value):
        if self.type == core.OPTION_IS_TEXT:
            handle.set_text(self.id, self._text_of(value))
        elif isinstance(value, str):  # "2G", "1e6"
            handle.parse(self.flag, value)
        elif self.type == core.OPTION_IS_INT64:
            handle.set_int64(self.id, whole(self.name, value))
        else:
            handle.set_double(self.id, real(self.name, value))

    def _text_of(self, value):
        """Of a text option: True and False are yes and no, a number of a step is its text."""
        if isinstance(value, str):
            return value
        if isinstance(value, (bool, numpy.bool_)) and self.choices == "no yes":
            return "yes" if value else "no"
        if self.name == "step" and not isinstance(value, (bool, numpy.bool_)):
            return str(whole(self.name, value))
        raise TypeError(f"{self.name}: a str is wanted, not {type(value).__name__}")


def whole(name, value, bits=64):
    """An int of so many bits; 1e6 is one, too."""
    is_whole = isinstance(value, (float, numpy.floating)) and float(value).is_integer()
    try:
        number = operator.index(int(value) if is_whole else value)
    except TypeError:
        raise TypeError(f"{name}: an int is wanted, not {type(value).__name__}") from None
    if not -2 ** (bits - 1) <= number < 2 ** (bits - 1):
        raise BadArgument(f"{name}: {number} has more than {bits} bits")
    return number


def real(name, value):
    """A float."""
    try:
        if isinstance(value, (str, bytes, bool, numpy.bool_)) or numpy.iscomplexobj(value):
            raise TypeError
        return float(value)
    except OverflowError:
        raise BadArgument(f"{name}: the number is too large") from None
    except (TypeError, ValueError):
        raise TypeError(f"{name}: a number is wanted, not {type(value).__name__}") from None


ROWS = {row.name: row for row in map(_Row, range(core.option_count()))}


def _named(name, known=(*ROWS, "weights")):
    if name in ROWS:
        return ROWS[name]
    close = difflib.get_close_matches(name.replace("-", "_"), known, 1)
    raise TypeError(f"there is no option {name}" + (f": is {close[0]} meant?" if close else ";") +
                    f" there are {', '.join(known)}")


class Options(collections.abc.Mapping):
    """Options to be kept, checked when they are set, and given to several runs:

        options = tetstream.Options(ratio=0.1, memory="64M", weights={"pressure": 1})
        options.boundary_weight = 3
        tetstream.simplify_file("jet.vtu", "jet-10.vtu", **options)

    Each is a property; those that are not set have their defaults. Numbers may be given as text,
    with a suffix k, M or G. As a mapping it has what was set, as numbers where they are numbers.
    """

    __slots__ = ("_handle", "_set")  # the name of an option that is misspelt is none

    def __init__(self, *, weights=None, **values):
        self._handle, self._set = core.Options(), {}
        for name, value in values.items():
            row = _named(name)
            if value is not None:
                setattr(self, row.name, value)
        for name, weight in _arrays.named("weights", weights).items():
            self.add_field(name, weight)

    def add_field(self, name, weight=1.0):
        """Measures this field with this weight; 0: carried along. Fields that are not named are
        then carried."""
        self._handle.add_field(name, real(f'the weight of "{name}"', weight))
        self._set["weights"] = {**self._set.get("weights", {}), name: weight}

    def __getitem__(self, name):
        return self._set[name]

    def __iter__(self):
        return iter(self._set)

    def __len__(self):
        return len(self._set)

    def __reduce__(self):
        return functools.partial(Options, **self), ()

    def __repr__(self):
        return f"Options({', '.join(f'{name}={value!r}' for name, value in self.items())})"


def _add_property(row):
    def put(self, value):
        row.set(self._handle, value)
        self._set[row.name] = row.get(self._handle)
    setattr(Options, row.name, property(lambda self: row.get(self._handle), put,
                                        doc=row.describe()))


for _row in ROWS.values():
    _add_property(_row)


def refuse_reading(options, source):
    """For a source that is open already, or was never a file."""
    for row in ROWS.values():
        if row.scope == core.SCOPE_READ and row.get(options._handle) != row.default:
            raise BadArgument(f"{row.name} says how a file is read, and the source is {source}")


_DOING = {core.SCOPE_READ: "opened", core.SCOPE_ORDER: "ordered or copied",
          core.SCOPE_SIMPLIFY: "simplified", core.SCOPE_COMPARE: "compared"}


def made(values, scope, weights=None):
    """Options from keyword arguments, each of which counts there, and a dict of fields' weights."""
    known = [name for name, row in ROWS.items() if row.scope & (scope | core.SCOPE_READ)]
    if scope & (core.SCOPE_SIMPLIFY | core.SCOPE_COMPARE):
        known.append("weights")
    for name, value in values.items():
        if value is not None and _named(name, known).name not in known:
            raise TypeError(f"the option {name} does not count where a mesh is {_DOING[scope]}")
    return Options(weights=weights, **values)


def documented(scope, reads=True):
    """A decorator: adds the options that count there to what a function says of itself; without
    those of files where it `reads` none."""
    def with_table(function):
        counted = scope | core.SCOPE_READ if reads else scope
        lines = [f"    {row.name}: {row.describe_for(scope)}" for row in ROWS.values()
                 if row.scope & counted]
        function.__doc__ += "\n    Options:\n\n" + "\n".join("    " + line for line in lines) + "\n"
        return function
    return with_table
