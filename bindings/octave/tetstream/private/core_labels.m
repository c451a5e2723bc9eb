## labels = core_labels (caller, name, values): integers in any shape as a column of int64.
function labels = core_labels (caller, name, values)
  need_rows (caller, name, values);
  if (any (values(:) != fix (values(:))))
    error ("tetstream:bad-argument", "%s: %s: labels are integers", caller, name);
  endif
  labels = int64 (values(:));
endfunction
