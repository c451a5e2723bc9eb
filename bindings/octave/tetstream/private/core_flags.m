## flags = core_flags (caller, name, values): logicals, or numbers that stand for them.
function flags = core_flags (caller, name, values)
  need_rows (caller, name, values);
  if (any (isnan (values(:))))
    error ("tetstream:bad-argument", "%s: %s: NaN is neither true nor false", caller, name);
  endif
  flags = logical (values);
endfunction
