# Types of the package. Shapes and units stand in the docstrings. tests/python/stubs_test.py compares
# names and parameters with what is there, and the options with the library's table.
import os
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping
from types import SimpleNamespace
from typing import Any, Literal, TypedDict, Union

import numpy
from numpy.typing import ArrayLike, DTypeLike, NDArray
from typing_extensions import Unpack

__version__: str

_Path = Union[str, bytes, os.PathLike[str], os.PathLike[bytes]]
_Arrays = Mapping[str, ArrayLike]
_LabelNames = Mapping[Union[str, None], Mapping[int, str]]
_Columns = Mapping[str, Union[DTypeLike, tuple[DTypeLike, int]]]
_Source = Union[_Path, "Mesh", "Reader"]
_Target = Union[_Path, "Writer"]
_Told = Union[Callable[["Progress"], object], bool, None]

# Where options count; regions are an argument of their own where arrays are simplified.
class _Reading(TypedDict, total=False):
    memory: float | str
    tmpdir: str
    threads: float | str
    split: Literal["no", "yes"] | bool
    recover: Literal["no", "yes"] | bool
    step: str | int
    join_points: Literal["auto", "no", "yes"]
    cells_to_points: Literal["no", "yes"] | bool

class _Ordering(_Reading, total=False):
    axis: Literal["auto", "x", "y", "z"]
    order: str

class _Simplifying(_Ordering, total=False):
    ratio: float | str
    cells: float | str
    error: float | str
    boundary_weight: float | str
    field_range: Literal["free", "keep"]
    feature_angle: float | str
    mode: Literal["sweep", "paper", "queue"]
    seed: float | str
    quadric: Literal["determinant", "garland-zhou"]
    candidates: float | str
    pilot: Literal["auto", "none"]
    release: Literal["order", "error"]
    balance: Literal["auto", "none"]
    effort: Literal["normal", "high"]
    shape: Literal["field", "solver"]
    window: float | str

class _SimplifyingRegions(_Simplifying, total=False):
    regions: str

class _Comparing(_Reading, total=False):
    regions: str
    seed: float | str
    samples: float | str
    cut: str
    box: str
    boundary_samples: float | str

class _AllOptions(_SimplifyingRegions, _Comparing, total=False): ...

# ------------------------------------------------------------------------------- exceptions

class Error(Exception):
    status: int | None

class BadArgument(Error, ValueError): ...
class BadState(Error, RuntimeError): ...
class NoMemory(Error, MemoryError): ...
class BadData(Error, ValueError): ...
class InputOutput(Error, OSError): ...
class NoSuchFile(InputOutput, FileNotFoundError): ...
class Unsupported(Error, ValueError): ...
class Cancelled(Error): ...
class CallbackFailed(Error): ...
class InternalError(Error, RuntimeError): ...
class TargetMissedWarning(UserWarning): ...

# ---------------------------------------------------------------------------------- figures

class Record(SimpleNamespace):
    def __getattr__(self, name: str) -> Any: ...

class Progress(Record):
    fraction: float
    phase: str
    cells_read: int
    cells_total: int
    cells_written: int
    temporary_bytes: int

class Report(Record):
    cells_in: int
    vertices_in: int
    cells_out: int
    vertices_out: int
    target_cells: int
    window_cells: int
    front_width: int
    front_span: int
    front_cells: int
    collapses: int
    rejected_orientation: int
    rejected_link: int
    rejected_locked: int
    rejected_other: int
    locked_cells: int
    unused_vertices: int
    largest_error: float
    estimated_error: float
    volume_in: float
    volume_out: float
    seconds: float
    peak_window_bytes: int
    peak_resident_bytes: int
    regions: str
    limited_by: str
    reached: str
    order: str
    balance: str
    notes: list[str]

class LayoutReport(Record):
    order: str
    vertices: int
    cells: int
    unused_vertices: int
    front_width: int
    front_span: int
    front_cells: int
    temporary_bytes: int
    seconds: float
    notes: list[str]

class StreamInfo(Record):
    position_type: numpy.dtype[Any]
    fields: dict[str, tuple[numpy.dtype[Any], int]]
    cell_data: dict[str, tuple[numpy.dtype[Any], int]]
    label_names: dict[str | None, dict[int, str]]
    time: float | None
    vertex_count: int
    cell_count: int
    face_count: int
    front_width: int
    front_span: int
    front_cells: int
    front: Record
    face_labels: dict[int, int]
    indexed: bool
    box: NDArray[numpy.float64] | None
    ranges: dict[str, NDArray[numpy.float64] | None]
    notes: list[str]

class Diagram(Record):
    coverage: NDArray[numpy.float32]
    widths: NDArray[numpy.int64]
    lowest: NDArray[numpy.int64]
    newest: NDArray[numpy.int64]
    cell_count: int
    vertex_count: int
    front_width: int
    front_span: int
    front_cells: int
    mean_width: float
    mean_span: float
    mean_life: float
    longest_life: int
    widest_cell: int
    longest_cell: int
    columns: int
    rows: int
    cells_per_column: int
    vertices_per_row: int
    notes: list[str]
    def plot(self, ax: Any = None, **look: Any) -> Any: ...
    def write(self, path: _Path, title: str | None = None) -> None: ...

class Comparison(Record):
    original: Record
    simplified: Record
    fields: dict[str, Record]
    regions: dict[int, Record]
    face_labels: dict[int, Record]
    labels: str
    only_original: list[str]
    only_simplified: list[str]
    notes: list[str]
    field_count: int
    region_count: int
    face_label_count: int
    topology_kept: int
    is_exact: int
    samples: int
    boundary_samples: int
    diagonal: float
    compared_cells: int
    compared_volume: float
    outside_volume: float
    repeated_volume: float
    distance: float
    rms_distance: float
    distance_place: tuple[float, float, float]
    distance_back: float
    rms_distance_back: float
    distance_back_place: tuple[float, float, float]
    seconds: float
    peak_bytes: int
    def write(self, path: _Path, title: str | None = None) -> None: ...

class Options(Mapping[str, Any]):
    ratio: float | str
    cells: float | str
    error: float | str
    boundary_weight: float | str
    field_range: str
    regions: str
    feature_angle: float | str
    mode: str
    seed: float | str
    quadric: str
    candidates: float | str
    pilot: str
    release: str
    balance: str
    effort: str
    shape: str
    samples: float | str
    cut: str
    box: str
    boundary_samples: float | str
    window: float | str
    memory: float | str
    tmpdir: str
    threads: float | str
    axis: str
    order: str
    split: str
    join_points: str
    cells_to_points: str
    recover: str
    step: str
    def __init__(self, *, weights: Mapping[str, float] | None = None,
                 **values: Unpack[_AllOptions]) -> None: ...
    def add_field(self, name: str, weight: float = 1.0) -> None: ...
    def __getitem__(self, name: str) -> Any: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...

# ----------------------------------------------------------------------------------- meshes

class Mesh:
    points: ArrayLike
    cells: ArrayLike
    fields: dict[str, Any]
    cell_data: dict[str, Any]
    locked: ArrayLike | None
    faces: ArrayLike | None
    face_labels: ArrayLike | None
    locked_faces: ArrayLike | None
    locked_edges: ArrayLike | None
    label_names: dict[str | None, Any]
    time: float | None
    def __init__(self, points: ArrayLike, cells: ArrayLike, fields: _Arrays | None = None,
                 cell_data: _Arrays | None = None, *, locked: ArrayLike | None = None,
                 faces: ArrayLike | None = None, face_labels: ArrayLike | None = None,
                 locked_faces: ArrayLike | None = None,
                 locked_edges: ArrayLike | None = None,
                 label_names: _LabelNames | None = None,
                 time: float | None = None) -> None: ...
    def simplify(self, *, regions: ArrayLike | str | None = None,
                 weights: Mapping[str, float] | None = None, vertex_map: bool = False,
                 progress: _Told = None, **options: Unpack[_Simplifying]) -> Simplified: ...
    def write(self, path: _Path, format: str | None = None, **properties: str) -> list[str]: ...
    def to_pyvista(self) -> Any: ...
    def to_meshio(self) -> Any: ...

class VertexMap:
    cells: NDArray[numpy.int64]
    weights: NDArray[numpy.float64]
    def prolong(self, values: ArrayLike) -> NDArray[numpy.float64]: ...
    def matrix(self) -> Any: ...

class Simplified(Mesh):
    points: NDArray[Any]
    cells: NDArray[Any]
    regions: NDArray[Any] | None
    report: Report
    vertex_map: VertexMap | None

class Batch:
    points: ArrayLike | None
    fields: dict[str, Any]
    locked: ArrayLike | None
    cells: ArrayLike | None
    last_uses: ArrayLike | None
    cell_data: dict[str, Any]
    finalized: ArrayLike | None
    faces: ArrayLike | None
    face_labels: ArrayLike | None
    locked_faces: ArrayLike | None
    locked_edges: ArrayLike | None
    def __init__(self, points: ArrayLike | None = None, cells: ArrayLike | None = None,
                 fields: _Arrays | None = None, cell_data: _Arrays | None = None,
                 **more: ArrayLike | None) -> None: ...

_Batches = Iterable[Union[Batch, dict[str, Any]]]

class Reader:
    @classmethod
    def file(cls, path: _Path, format: str | None = None,
             **options: Unpack[_Reading]) -> Reader: ...
    @classmethod
    def memory(cls, data: Any, format: str,
               **options: Unpack[_Reading]) -> Reader: ...
    @classmethod
    def mesh(cls, mesh: Mesh) -> Reader: ...
    @classmethod
    def stream(cls, mesh: Mesh) -> Reader: ...
    @classmethod
    def generate(cls, kind: Literal["fluid", "ball", "fluid+stress", "ball+stress"], cells: float,
                 seed: int = 1) -> Reader: ...
    @classmethod
    def batches(cls, batches: _Batches, points: DTypeLike = "float64",
                fields: _Columns | None = None, cell_data: _Columns | None = None, *,
                indexed: bool = False, vertex_count: int = -1, cell_count: int = -1,
                face_count: int = -1, front_width: int = -1, front_span: int = -1,
                front_cells: int = -1, label_names: _LabelNames | None = None,
                time: float | None = None, box: ArrayLike | None = None,
                ranges: _Arrays | None = None) -> Reader: ...
    def info(self) -> StreamInfo: ...
    @property
    def notes(self) -> list[str]: ...

class Writer:
    @classmethod
    def file(cls, path: _Path, format: str | None = None, **properties: str) -> Writer: ...
    @classmethod
    def memory(cls, format: str, **properties: str) -> Writer: ...
    @classmethod
    def arrays(cls, cell_type: DTypeLike = "int64") -> Writer: ...
    @classmethod
    def batches(cls, put: Callable[[Batch], object] | Generator[Any, Batch, Any],
                open: Callable[[StreamInfo], object] | None = None,
                finish: Callable[[], object] | None = None) -> Writer: ...
    def getbytes(self) -> bytes: ...
    def getmesh(self) -> Mesh: ...
    @property
    def notes(self) -> list[str]: ...

# -------------------------------------------------------------------------------- functions

def simplify(__points: ArrayLike, __tetrahedra: ArrayLike, fields: _Arrays | None = None, *,
             cell_data: _Arrays | None = None, regions: ArrayLike | str | None = None,
             locked: ArrayLike | None = None, faces: ArrayLike | None = None,
             face_labels: ArrayLike | None = None, locked_faces: ArrayLike | None = None,
             locked_edges: ArrayLike | None = None, label_names: _LabelNames | None = None,
             time: float | None = None, weights: Mapping[str, float] | None = None,
             vertex_map: bool = False, progress: _Told = None, **options: Unpack[_Simplifying]) -> Simplified: ...
def simplify_file(source: _Source, target: _Target, *, weights: Mapping[str, float] | None = None,
                  map_file: _Path | None = None, log_file: _Path | None = None,
                  progress: _Told = None, **options: Unpack[_SimplifyingRegions]) -> Report: ...
def simplify_batches(batches: _Batches, points: DTypeLike = "float64",
                     fields: _Columns | None = None, cell_data: _Columns | None = None, *,
                     weights: Mapping[str, float] | None = None, vertex_count: int = -1,
                     cell_count: int = -1, face_count: int = -1, front_width: int = -1,
                     front_span: int = -1, front_cells: int = -1,
                     label_names: _LabelNames | None = None, time: float | None = None,
                     box: ArrayLike | None = None, ranges: _Arrays | None = None,
                     **options: Unpack[_SimplifyingRegions]) -> Generator[Batch, None, Report]: ...
def layout(source: _Source, target: _Target, *, progress: _Told = None,
           **options: Unpack[_Ordering]) -> LayoutReport: ...
def convert(source: _Source, target: _Target, *, progress: _Told = None,
            **options: Unpack[_Ordering]) -> list[str]: ...
def read(source: _Source, *, cell_type: DTypeLike = "int64", progress: _Told = None,
         **options: Unpack[_Ordering]) -> Mesh: ...
def info(source: _Source, *, progress: _Told = None,
         **options: Unpack[_Ordering]) -> StreamInfo: ...
def diagram(source: _Source, *, columns: int = 1200, rows: int = 800, sweep: bool = False,
            progress: _Told = None, **options: Unpack[_Ordering]) -> Diagram: ...
def compare(original: _Source, simplified: _Source, *, weights: Mapping[str, float] | None = None,
            progress: _Told = None, **options: Unpack[_Comparing]) -> Comparison: ...
def formats() -> list[Record]: ...
def from_pyvista(grid: Any) -> Mesh: ...
def to_pyvista(mesh: Mesh) -> Any: ...
def from_meshio(mesh: Any) -> Mesh: ...
def to_meshio(mesh: Mesh) -> Any: ...
