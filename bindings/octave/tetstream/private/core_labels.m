## labels = core_labels (caller, name, values): integers in any shape as a column of int64.
function labels = core_labels (caller, name, values)
  need_dense (caller, name, values);
  ## note: Octave compares int64 with double wrongly at their ends.
  if (isfloat (values))
    bad = ! (values == fix (values) & -2^63 <= values & values < 2^63);
  else
    bad = uint64 (values) > uint64 (intmax ("int64"));
  endif
  bad = find (bad(:), 1);
  if (! isempty (bad))
    error ("tetstream:bad-argument", "%s: %s: labels are integers of 64 bits, and one is %g", caller,
           name, double (values(bad)));
  endif
  labels = int64 (values(:));
endfunction
