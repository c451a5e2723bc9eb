## need_dense (caller, name, values): real numbers or logicals, in rows, all of which are there.
function need_dense (caller, name, values)
  need_rows (caller, name, values);
  if (issparse (values))
    error ("tetstream:bad-argument", "%s: %s is sparse; rows of numbers are wanted", caller, name);
  endif
endfunction
