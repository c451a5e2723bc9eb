## [batch, kept] = filled_batch (caller, mesh, first, count): the library's batch of a mesh or a batch,
## with point numbers up to `count`, which the library has from `first` on. It is good as long as
## `kept` is.
function [batch, kept] = filled_batch (caller, mesh, first, count)
  tetstream_core;
  batch = tetstream_core.StreamBatch ();
  kept = {};
  if (! isempty (mesh.points))
    if (columns (mesh.points) != 3)
      error ("tetstream:bad-argument", "%s: points: 3 columns are wanted, the size is %s", caller,
             mat2str (size (mesh.points)));
    endif
    kept{end+1} = core_rows (mesh.points);
    batch.set_positions (kept{end});
    kept = add_columns (caller, mesh.fields, rows (mesh.points), "points",
                        @(array) batch.add_field (array), kept);
  endif
  if (! isempty (mesh.cells))
    kept{end+1} = core_rows (core_ids (caller, "cells", mesh.cells, 4, first, count));
    batch.set_cells (kept{end});
    kept = add_columns (caller, mesh.cell_data, rows (mesh.cells), "cells",
                        @(array) batch.add_cell_data (array), kept);
  endif
  if (! isempty (mesh.last_uses))
    uses = core_flags (caller, "last_uses", mesh.last_uses);
    if (columns (mesh.last_uses) != 4)
      error ("tetstream:bad-argument", "%s: last_uses: 4 columns are wanted, the size is %s", caller,
             mat2str (size (mesh.last_uses)));
    endif
    kept{end+1} = core_rows (uint8 (uses * [1; 2; 4; 8]));
    batch.set_last_uses (kept{end});
  endif
  for [set, name] = struct ("locked", @(array) batch.set_locked (array),
                            "locked_faces", @(array) batch.set_locked_faces (array))
    if (! isempty (mesh.(name)))
      kept{end+1} = core_rows (core_flags (caller, name, mesh.(name))(:));
      set (kept{end});
    endif
  endfor
  for [set, name] = struct ("finalized", {{1, @(array) batch.set_finalized (array)}},
                            "faces", {{3, @(array) batch.set_faces (array)}},
                            "locked_edges", {{2, @(array) batch.set_locked_edges (array)}})
    if (! isempty (mesh.(name)))
      kept{end+1} = core_rows (int64 (core_ids (caller, name, mesh.(name), set{1}, first, count)));
      set{2} (kept{end});
    endif
  endfor
  if (! isempty (mesh.faces))
    labels = mesh.face_labels;
    if (isempty (labels))
      labels = zeros (rows (mesh.faces), 1);
    endif
    kept{end+1} = core_rows (core_labels (caller, "face_labels", labels));
    batch.set_face_labels (kept{end});
  elseif (! isempty (mesh.face_labels) || ! isempty (mesh.locked_faces))
    error ("tetstream:bad-argument",
           "%s: face_labels and locked_faces are of faces, which are not there", caller);
  endif
endfunction

function kept = add_columns (caller, arrays, count, of, add, kept)
  for [values, name] = arrays
    if (rows (values) != count)
      error ("tetstream:bad-argument", "%s: %s has %d rows, there are %d %s", caller, name,
             rows (values), count, of);
    endif
    if (islogical (values))
      values = int32 (values);
    endif
    kept{end+1} = core_rows (values);
    add (kept{end});
  endfor
endfunction
