"""Exceptions: one class for each status of the library; the text is the library's sentence.

Each is also one of Python's own kinds, so that ``except ValueError`` or ``except OSError`` catch
what one expects. Exceptions that the caller's functions raise are raised again as they are.
"""


class Error(Exception):
    """Something the library could not do. ``status`` is its number, as in ``tetstream.h``."""

    status = None


class BadArgument(Error, ValueError):
    """An argument that the library does not take."""

    status = -1


class BadState(Error, RuntimeError):
    """A call that is not allowed now: a reader or a writer serves one run."""

    status = -2


class NoMemory(Error, MemoryError):
    """Memory, or the budget set for it, is used up."""

    status = -3


class BadData(Error, ValueError):
    """A file or a stream breaks its format's rules."""

    status = -4


class InputOutput(Error, OSError):
    """The system refused a read, a write or an open."""

    status = -5


class NoSuchFile(InputOutput, FileNotFoundError):
    """The file to read is not there. ``filename`` and ``errno`` are as Python has them."""

    def __str__(self):
        return super().__str__() if self.strerror is None else self.strerror


class Unsupported(Error, ValueError):
    """Valid, but this build or this format cannot hold it."""

    status = -6


class Cancelled(Error):
    """The run was stopped."""

    status = -7


class CallbackFailed(Error):
    """A callback stopped the run without an exception."""

    status = -8


class InternalError(Error, RuntimeError):
    """A defect of the library: please report it."""

    status = -9


class TargetMissedWarning(UserWarning):
    """The result is complete and valid, but has more cells than asked for."""


_CLASSES = {
    kind.status: kind
    for kind in (BadArgument, BadState, NoMemory, BadData, InputOutput, Unsupported, Cancelled,
                 CallbackFailed, InternalError)
}


def _from_status(status, sentence):
    """The exception for a status below 0; called by the wrapper."""
    return _CLASSES.get(status, InternalError)(sentence)
