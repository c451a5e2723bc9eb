"""numpy arrays as the library takes them: dense, float32, float64, int32 or int64, uint8 for flags.
What is so already is taken as it lies; anything else is copied, if no value changes."""
import numpy

from . import core
from .errors import BadArgument

TYPES = {
    numpy.dtype(numpy.float32): core.TYPE_FLOAT32,
    numpy.dtype(numpy.float64): core.TYPE_FLOAT64,
    numpy.dtype(numpy.int32): core.TYPE_INT32,
    numpy.dtype(numpy.int64): core.TYPE_INT64,
}
DTYPES = {number: dtype for dtype, number in TYPES.items()}


def _array(name, values):
    if numpy.ma.is_masked(values):
        raise BadArgument(f"{name}: {numpy.ma.count_masked(values)} of its numbers are masked")
    array = numpy.asarray(values)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name}: its numbers are {array.dtype}; integers or floats are wanted")
    return array


def _dense(array, dtype):
    """In C order, aligned, with this type of numbers in the machine's byte order."""
    return numpy.require(array, dtype=dtype, requirements=("C", "A"))


def _holding(name, array):
    """The least of the four types that holds every value of an array's type."""
    for dtype in TYPES:
        if dtype.kind == ("f" if array.dtype.kind == "f" else "i") and numpy.can_cast(
                array.dtype, dtype, "safe"):
            return dtype
    if array.dtype.kind == "u" and (array.size == 0 or int(array.max()) < 2 ** 63):
        return numpy.dtype(numpy.int64)
    raise TypeError(f"{name}: neither float64 nor int64 holds all of its {array.dtype}")


def needs_shape(name, array, wanted, fits):
    if not fits:
        shape = "".join(f"[{size}]" for size in array.shape) or "a single number"
        raise BadArgument(f"{name}: the shape is {shape}, {wanted} is wanted")


def points(values):
    """[n][3], float32 or float64."""
    array = _array("points", values)
    if array.shape == (0,):  # as that of []
        array = array.reshape(0, 3)
    needs_shape("points", array, "[n][3]", array.ndim == 2 and array.shape[1] == 3)
    dtype = _holding("points", array)
    floats = _dense(array, dtype if dtype.kind == "f" else numpy.float64)
    with numpy.errstate(invalid="ignore"):  # of floats beyond the integers
        is_exact = dtype.kind == "f" or (floats.astype(array.dtype) == array).all()
    if not is_exact:
        raise TypeError(f"points: float64 does not hold all of their {array.dtype}")
    return floats


def ids(name, values, columns):
    """[n][columns] of int64, or [n] for one column."""
    array = _array(name, values)
    if array.size == 0 and array.ndim == 1:  # as that of [], whose numbers have no type
        array = numpy.zeros((0, columns) if columns > 1 else 0, numpy.int64)
    if array.dtype.kind == "f":
        raise TypeError(f"{name}: its numbers are {array.dtype}; integers are wanted")
    wanted = "[n]" if columns == 1 else f"[n][{columns}]"
    needs_shape(name, array, wanted, array.ndim == (1 if columns == 1 else 2)
                 and (columns == 1 or array.shape[1] == columns))
    return array if array.dtype in (numpy.int32, numpy.int64) else array.astype(
        _holding(name, array))


def wide_ids(name, values, columns):
    """The same, always int64."""
    return _dense(ids(name, values, columns), numpy.int64)


def cells(values):
    """[m][4], int32 or int64."""
    array = ids("cells", values, 4)
    return _dense(array, array.dtype.newbyteorder("="))


def bounds(name, values, components):
    """[2][components] of float64, the lowest and the highest; of one component [2] will do."""
    array = _array(name, values)
    if components == 1 and array.shape == (2,):
        array = array.reshape(2, 1)
    needs_shape(name, array, f"[2][{components}]", array.shape == (2, components))
    return _dense(array, numpy.float64)


def limits(rows):
    """Of each column the lowest and the highest of what is finite: [2][columns]; infinity and
    -infinity where nothing is."""
    rows = rows.reshape(len(rows), -1)
    if not numpy.issubdtype(rows.dtype, numpy.floating):
        return numpy.stack([rows.min(0), rows.max(0)]).astype(float)
    finite = numpy.isfinite(rows)
    return numpy.stack([numpy.min(rows, 0, initial=numpy.inf, where=finite),
                        numpy.max(rows, 0, initial=-numpy.inf, where=finite)])


def flags(name, values, rows):
    """[rows] of uint8, 1 where a value is not zero."""
    array = _array(name, values)
    needs_shape(name, array, f"[{rows}]", array.shape == (rows,))
    return _dense(array != 0, numpy.uint8)


def bits(name, values, rows):
    """[rows] of uint8, four bits each."""
    array = _array(name, values)
    needs_shape(name, array, f"[{rows}]", array.shape == (rows,))
    if array.dtype.kind == "f" or (array.size and not 0 <= array.min() <= array.max() <= 15):
        raise BadArgument(f"{name}: integers from 0 to 15 are wanted")
    return _dense(array, numpy.uint8)


class Column:
    """A named array of a mesh as rows of one to nine numbers, and what it was before."""

    def __init__(self, name, values, rows):
        if not isinstance(name, str):
            raise TypeError(f"an array's name is {name!r}, a str is wanted")
        array = _array(f'"{name}"', values)
        needs_shape(f'"{name}"', array, f"[{rows}] or [{rows}][components]",
                     array.ndim >= 1 and array.shape[0] == rows)
        self.name = name
        self.shape = array.shape[1:]
        self.components = int(numpy.prod(self.shape, dtype=int))
        if not 1 <= self.components <= 9:
            raise BadArgument(f'"{name}": {self.components} numbers in a row, 1 to 9 are possible')
        self.dtype = array.dtype
        dense = _dense(array, _holding(f'"{name}"', array))
        self.rows = dense.reshape(rows, self.components) if self.components > 1 else dense.reshape(
            rows)

    @property
    def type(self):
        """As the library numbers it."""
        return TYPES[self.rows.dtype]

    def like_before(self, array):
        """An array of the result with the shape of rows, and small integers, as they came."""
        array = array.reshape((array.shape[0],) + self.shape)
        return array.astype(self.dtype) if self.dtype.kind in "biu" and (
            self.dtype != array.dtype) else array


def named(what, values):
    """A dict of what the caller gives as one, or nothing as None; `what` is its name."""
    if values is None:
        return {}
    if not hasattr(values, "keys"):
        raise TypeError(f"{what}: a dict is wanted, not {type(values).__name__}")
    return dict(values)


def columns(what, arrays, rows):
    """A dict of arrays as a list of Columns."""
    return [Column(name, values, rows) for name, values in named(what, arrays).items()]
