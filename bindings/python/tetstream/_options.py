"""The library's options as properties, made from its own table."""
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
            handle.set_double(self.id, _real(self.name, value))

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


def _real(name, value):
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: a number is wanted, not {type(value).__name__}") from None


ROWS = {row.name: row for row in map(_Row, range(core.option_count()))}


class Options:
    """The options of a run, each a property; those that are not set have their defaults.

    ``Options(ratio=0.1, memory="64M")``; numbers may be given as text, with a suffix k, M or G.
    """

    __slots__ = ("_handle", "_weights")  # the name of an option that is misspelt is none

    def __init__(self, **values):
        self._handle, self._weights = core.Options(), {}
        for name, value in values.items():
            if name not in ROWS:
                raise TypeError(f"there is no option {name}; there are {', '.join(ROWS)}")
            if value is not None:
                setattr(self, name, value)

    def add_field(self, name, weight=1.0):
        """Measures this field with this weight; 0: carried along. Fields that are not named are
        then carried."""
        self._handle.add_field(name, _real(f'the weight of "{name}"', weight))
        self._weights[name] = weight

    def __reduce__(self):
        return _rebuilt, ({name: getattr(self, name) for name in ROWS}, self._weights)

    def __repr__(self):
        return f"Options({', '.join(f'{name}={getattr(self, name)!r}' for name in ROWS)})"


def _rebuilt(values, weights):
    """A copy of Options, also out of a pickle."""
    options = Options(**values)
    for name, weight in weights.items():
        options.add_field(name, weight)
    return options


def _add_property(row):
    setattr(Options, row.name, property(lambda self: row.get(self._handle),
                                        lambda self, value: row.set(self._handle, value),
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
    for name, value in values.items():
        if name in ROWS and value is not None and not ROWS[name].scope & (scope | core.SCOPE_READ):
            raise TypeError(f"the option {name} does not count where a mesh is {_DOING[scope]}")
    return _rebuilt(values, _arrays.named("weights", weights))


def documented(scope):
    """A decorator: adds the options that count there to what a function says of itself."""
    def with_table(function):
        lines = [f"    {row.name}: {row.describe()}" for row in ROWS.values()
                 if row.scope & (scope | core.SCOPE_READ)]
        function.__doc__ += "\n    Options:\n\n" + "\n".join("    " + line for line in lines) + "\n"
        return function
    return with_table
