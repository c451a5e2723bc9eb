"""Progress: from the library to the caller's function or to a bar."""
import contextlib

from ._records import Progress


class _Bar:
    """A bar of tqdm's."""

    def __init__(self, tqdm):
        self.bar = tqdm(total=1.0, leave=True,
                        bar_format="{desc}{percentage:3.0f} %|{bar}| {elapsed}<{remaining}")

    def __call__(self, progress):
        self.bar.set_description(progress.phase, refresh=False)
        if progress.fraction >= 0:
            self.bar.n = progress.fraction
        else:
            self.bar.set_postfix(cells=progress.cells_read, refresh=False)
        self.bar.refresh()


@contextlib.contextmanager
def told(progress):
    """What the library is to call: None, or a function of a struct. `progress` is None or False, a
    function of a Progress, or True for a bar."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            raise ImportError("progress=True draws its bar with tqdm, which is not installed; a "
                              "function of your own will do, too") from None
        show = _Bar(tqdm)
        with contextlib.closing(show.bar):
            yield lambda struct: show(Progress.copied(struct))
            show.bar.n = show.bar.total
            show.bar.refresh()
    elif callable(progress):
        yield lambda struct: progress(Progress.copied(struct))
    else:
        raise TypeError(f"progress: a callable, True or None is wanted, not {progress!r}")
