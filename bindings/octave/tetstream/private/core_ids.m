## ids = core_ids (caller, name, values, width, first, count): numbers of points from 1 on as the
## library's from `first` on, int64, or int32 if they are; 0 < each <= count, which may be Inf.
function ids = core_ids (caller, name, values, width, first, count)
  need_dense (caller, name, values);
  if (! isnumeric (values) || columns (values) != width)
    error ("tetstream:bad-argument", "%s: %s: %d columns are wanted, the size is %s", caller, name,
           width, mat2str (size (values)));
  endif
  bad = find (! (values >= 1 & values <= count & values == fix (values)), 1);
  if (! isempty (bad))
    [row, column] = ind2sub (size (values), bad);
    error ("tetstream:bad-data", "%s: %s(%d,%d) is %g; points are numbered from 1 to %g", caller, name,
           row, column, double (values(bad)), count);
  endif
  if (! isa (values, "int32"))
    values = int64 (values);
  endif
  ids = values - (1 - first);
endfunction
