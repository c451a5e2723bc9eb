## need_rows (caller, name, values): real numbers or logicals, in rows.
function need_rows (caller, name, values)
  if (! (isnumeric (values) || islogical (values)) || ! isreal (values)
      || ndims (values) > 2)
    kind = class (values);
    if (isnumeric (values) && ! isreal (values))
      kind = ["complex " kind];
    endif
    error ("tetstream:bad-argument", "%s: %s is a %s of size %s; rows of real numbers are wanted",
           caller, name, kind, mat2str (size (values)));
  endif
endfunction
