# What is written, read by meshio and by Gmsh: the same arrays. What meshio writes as XDMF, read by us.
source "${BASH_SOURCE%/*}/common.bash"
peers=${BASH_SOURCE%/*}/peers.py

[[ -n ${TETSTREAM_PYTHON:-} ]] && "$TETSTREAM_PYTHON" -c 'import numpy, meshio' 2>/dev/null ||
  not_run "no meshio"

tetstream generate fluid --cells 2000 plain.sva
# A region of three labels for each cell.
awk '/^# ncells/ { print; print "# c_pnum_i 1"; print "# tetstream:cell:int32:1:region"; next }
  /^# c_pnum_i/ { next } /^c / { n += 1; print $0, 1 + int((n - 1) / 700); next } { print }' plain.sva >mesh.sva
expect 0 convert mesh.sva mesh.vtu --compress no

for way in 4.1-binary 4.1-text 2.2-binary 2.2-text; do
  expect 0 convert mesh.sva "$way.msh" --msh-version "${way%-*}" --encoding "${way#*-}"
  "$TETSTREAM_PYTHON" "$peers" meshio "$way.msh" mesh.vtu >"$logs/peer" 2>&1 ||
    fail "meshio reads $way.msh otherwise"
  code=0
  "$TETSTREAM_PYTHON" "$peers" gmsh "$way.msh" mesh.vtu >"$logs/peer" 2>&1 || code=$?
  [[ $code == 0 || $code == 77 ]] || fail "Gmsh reads $way.msh otherwise"
done
for format in mesh meshb; do
  expect 0 convert mesh.sva "a.$format"
  "$TETSTREAM_PYTHON" "$peers" meshio "a.$format" mesh.vtu >"$logs/peer" 2>&1 ||
    fail "meshio reads a.$format otherwise"
done

"$TETSTREAM_PYTHON" "$peers" xdmf theirs mesh.vtu >"$logs/peer" 2>&1 || fail "meshio writes no XDMF"
expect 0 --version
for way in XML Binary HDF; do
  [[ -e theirs-$way.xdmf ]] || continue
  [[ $way == HDF && $out != *", hdf5,"* ]] && continue
  expect 0 convert "theirs-$way.xdmf" ours.vtu --compress no --order none
  "$TETSTREAM_PYTHON" "$peers" same ours.vtu "theirs-$way.xdmf" >"$logs/peer" 2>&1 ||
    fail "values in the way $way are read otherwise"
done
[[ -e theirs-XML.xdmf ]] || not_run "without h5py meshio writes no XDMF; MSH and MEDIT are as they should be"
[[ -s theirs-Binary.xdmf ]] || fail "meshio wrote no raw files"
