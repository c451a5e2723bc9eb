# The vertex map and the log of collapses as files: their bytes, their names, what is refused, and
# the example of the manual.
source "${BASH_SOURCE%/*}/common.bash"

tetstream generate fluid --cells 6000 mesh.tets
tetstream convert mesh.tets mesh.vtu --quiet
tetstream simplify mesh.vtu small.vtu --ratio 0.2 --quiet --map small.tetmap --collapse-log small.tetlog
tetstream simplify mesh.vtu other.vtu --ratio 0.2 --quiet --map small.csv --collapse-log log.csv
only_files mesh.tets mesh.vtu small.vtu other.vtu small.tetmap small.tetlog small.csv log.csv
[[ $(bytes_of small.vtu) == "$(bytes_of other.vtu)" ]] || fail "another mesh"

# Without them the mesh is the same, with a budget of memory both hold.
tetstream simplify mesh.vtu other.vtu --ratio 0.2 --quiet
[[ $(bytes_of small.vtu) == "$(bytes_of other.vtu)" ]] || fail "a map changes the mesh"
tetstream generate fluid --cells 12000 many.tets --quiet
tetstream simplify many.tets sliced.tets --ratio 0.1 --quiet --shape solver
for trace in --map --collapse-log; do
  tetstream simplify many.tets traced.tets --ratio 0.1 --quiet --shape solver "$trace" many.csv
  [[ $(bytes_of traced.tets) == "$(bytes_of sliced.tets)" ]] || fail "$trace changes the mesh"
done
rm many.tets many.csv sliced.tets traced.tets
tetstream simplify mesh.tets other.tets --ratio 0.2 --quiet --memory 2M --map budget.tetmap
# Of streams and of points that are put into another order, that before counts.
mkdir orders
tetstream simplify mesh.tets orders/stream.vtu --ratio 0.2 --quiet --order hilbert --map orders/stream.tetmap
tetstream simplify mesh.vtu orders/points.vtu --ratio 0.2 --quiet --order z-order --map orders/points.tetmap

# Standard output takes one of them, as text; the report goes elsewhere then.
expect 0 simplify mesh.vtu other.vtu --ratio 0.2 --map -
[[ $out == "$(<small.csv)" ]] || fail "the map on standard output is another"
contains "$err" "collapses"
expect 0 simplify mesh.vtu other.vtu --ratio 0.2 --quiet --collapse-log -
[[ $out == "$(<log.csv)" ]] || fail "the log on standard output is another"
tetstream simplify mesh.vtu - --ratio 0.2 --quiet --map again.csv >again.tets
[[ $(bytes_of again.csv) == "$(bytes_of small.csv)" ]] || fail "another map beside a pipe"
rm again.csv again.tets budget.tetmap other.tets

expect_error 1 "only one" simplify mesh.vtu - --ratio 0.2 --map -
expect_error 1 "only one" simplify mesh.vtu x.vtu --ratio 0.2 --map - --collapse-log -
expect_error 1 "two things" simplify mesh.vtu x.csv --ratio 0.2 --map y.csv --collapse-log y.csv
expect_error 1 "two things" simplify mesh.vtu x.vtu --ratio 0.2 --map y.csv --collapse-log ./y.csv
expect_error 6 ".tetmap" simplify mesh.vtu x.vtu --ratio 0.2 --map x.txt
expect_error 6 ".tetlog" simplify mesh.vtu x.vtu --ratio 0.2 --collapse-log x.tetmap
expect_error 3 "no/such" simplify mesh.vtu x.vtu --ratio 0.2 --map no/such/x.csv
# A run that fails leaves nothing.
head -c 20000 mesh.tets >cut.tets
expect_error 2 "cut.tets" simplify cut.tets x.vtu --ratio 0.2 --map x.csv --collapse-log x.tetlog
# Nor does one whose last steps fail: of the three files none has a new name, and old ones are as
# they were.
if [[ -n ${TETSTREAM_FAIL_WRITE:-} ]]; then
  mkdir late
  for old in no yes; do
    for renaming in 1 2 3; do
      if [[ $old == yes ]]; then echo precious | tee late/x.vtu late/x.csv >late/x.tetlog; fi
      code=0
      ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0 FAIL_RENAME=$renaming \
        LD_PRELOAD=$TETSTREAM_FAIL_WRITE tetstream simplify mesh.tets late/x.vtu --ratio 0.2 --quiet \
        --map late/x.csv --collapse-log late/x.tetlog 2>"$logs/err" || code=$?
      [[ $code == 3 ]] || fail "renaming $renaming fails: exit code $code, not 3"
      contains "$(<"$logs/err")" "rename into place"
      if [[ $old == yes ]]; then
        [[ $(cat late/*) == $'precious\nprecious\nprecious' ]] || fail "an old file was changed"
        rm late/x.vtu late/x.csv late/x.tetlog
      fi
      [[ -z $(ls -A late) ]] || fail "renaming $renaming fails: left: $(ls -A late)"
    done
  done
  rmdir late
fi
only_files cut.tets mesh.tets mesh.vtu small.vtu other.vtu small.tetmap small.tetlog small.csv log.csv orders

# What is in them, by a reader of the manual.
[[ -x $TETSTREAM_PYTHON ]] && "$TETSTREAM_PYTHON" -c 'import numpy' 2>/dev/null || exit 0
cat >check.py <<'PYTHON'
import csv
import zlib
import numpy as np


def rows_of(name, marker, dtype):
    data = open(name, "rb").read()
    version, begin = np.frombuffer(data, "<u4", 2, 8)
    count = int(np.frombuffer(data, "<i8", 1, 16)[0])
    row_bytes, fields = np.frombuffer(data, "<u4", 2, 24)
    assert data[:8] == b"\x89" + marker + b"\r\n\x1a" and version == 1 and begin % 64 == 0
    names, at = [], 64
    for _ in range(fields):
        components, length = np.frombuffer(data, "<u4", 2, at)
        names.append((data[at + 8:at + 8 + length].decode(), int(components)))
        at += (8 + int(length) + 7) // 8 * 8
    assert row_bytes == 48 + 8 * sum(components for _, components in names)
    rows = data[begin:begin + count * row_bytes]
    end = data[begin + count * row_bytes:]
    assert len(end) == 32 and end[:8] == b"\x89TEND\r\n\x1a" and end[20:] == bytes(12)
    assert np.frombuffer(end, "<i8", 1, 8)[0] == count
    assert np.frombuffer(end, "<u4", 1, 16)[0] == zlib.crc32(rows)
    return np.frombuffer(rows, dtype(names)), names


def table(name):
    with open(name, newline="") as file:
        lines = list(csv.reader(file))
    return lines[0], np.array(lines[1:], dtype=float)


places, _ = rows_of("small.tetmap", b"TMAP",
                    lambda _: [("vertex", "<i8"), ("cell", "<i8"), ("w", "<f8", 4)])
names, text = table("small.csv")
assert names == ["vertex", "cell", "w0", "w1", "w2", "w3"]
assert (text[:, 0] == places["vertex"]).all() and (text[:, 1] == places["cell"]).all()
assert (text[:, 2:] == places["w"]).all()
assert (np.sort(places["vertex"]) == np.arange(len(places))).all()
assert (np.diff(places["cell"]) >= 0).all() and abs(places["w"].sum(axis=1) - 1).max() < 1e-14

log, fields = rows_of("small.tetlog", b"TLOG", lambda names: [
    ("kept", "<i8"), ("removed", "<i8"), ("x", "<f8", 3), ("error", "<f8"),
    ("values", "<f8", sum(components for _, components in names))])
names, text = table("log.csv")
assert names == ["kept", "removed", "x", "y", "z", "error", "density", "velocity:0", "velocity:1",
                 "velocity:2"]
assert fields == [("density", 1), ("velocity", 3)]
assert (text[:, 0] == log["kept"]).all() and (text[:, 1] == log["removed"]).all()
assert (text[:, 2:5] == log["x"]).all() and (text[:, 5] == log["error"]).all()
assert (text[:, 6:] == log["values"]).all()
assert len(np.unique(log["removed"])) == len(log)
PYTHON
"$TETSTREAM_PYTHON" check.py >"$logs/check" 2>&1 || fail "not what the manual says"

"$TETSTREAM_PYTHON" -c 'import vtk' 2>/dev/null || exit 0
carrying_back >example.py
cat >>example.py <<'PYTHON'
grid = vtk.vtkUnstructuredGrid()
grid.DeepCopy(reader.GetOutput())
reader.SetFileName("mesh.vtu")
reader.Update()
was = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("density"))
error = np.sqrt(np.mean((fine - was) ** 2)) / np.ptp(was)
assert fine.shape == was.shape and error < 0.1, error
places, field = (vtk_to_numpy(g.GetPoints().GetData()) for g in (reader.GetOutput(), grid))
found = (rows["weight"][..., None] * field[cells[rows["cell"]]]).sum(axis=1)
assert abs(found - places[rows["vertex"]]).max() < 1e-14
for name in ("orders/stream", "orders/points"):
    reader.SetFileName(name + ".vtu")
    reader.Update()
    field = vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
    cells = vtk_to_numpy(reader.GetOutput().GetCells().GetConnectivityArray()).reshape(-1, 4)
    rows = np.fromfile(name + ".tetmap", row, np.fromfile(name + ".tetmap", "<i8", 3)[2], offset=64)
    found = (rows["weight"][..., None] * field[cells[rows["cell"]]]).sum(axis=1)
    assert len(rows) == len(places) and abs(found - places[rows["vertex"]]).max() < 1e-14, name
PYTHON
"$TETSTREAM_PYTHON" example.py >"$logs/example" 2>&1 || fail "the manual's example does not run"
