"""tetstream simplifies tetrahedral meshes with fields as a stream.

    result = tetstream.simplify(points, cells, {"pressure": p}, ratio=0.1)
    result.points, result.cells, result.fields["pressure"], result.report

    tetstream.simplify_file("jet.vtu", "jet-10.vtu", ratio=0.1, progress=True)

Shapes are written [n][3]: n rows of 3. The manual is in tetstream-python(3) and tetstream(7).
"""
from . import core as _core
from ._batches import Batch
from ._interchange import from_meshio, from_pyvista, to_meshio, to_pyvista
from ._mesh import Mesh, Simplified, VertexMap
from ._operations import Comparison, Diagram, compare, convert, diagram, formats, info, layout, read
from ._options import Options
from ._records import LayoutReport, Progress, Record, Report, StreamInfo
from ._simplify import simplify, simplify_batches, simplify_file
from ._streams import Reader, Writer
from .errors import (BadArgument, BadData, BadState, CallbackFailed, Cancelled, Error, InputOutput,
                     InternalError, NoMemory, NoSuchFile, TargetMissedWarning, Unsupported)

__version__ = f"{_core.VERSION_MAJOR}.{_core.VERSION_MINOR}.{_core.VERSION_PATCH}"

__all__ = [name for name in dir() if not name.startswith("_") and name not in ("core", "errors")]
