## type = type_of (caller, name, values): the library's number for an array's class; logicals are
## integers there.
function type = type_of (caller, name, values)
  tetstream_core;
  need_rows (caller, name, values);
  switch (class (values))
    case "double"
      type = tetstream_core.TYPE_FLOAT64;
    case "single"
      type = tetstream_core.TYPE_FLOAT32;
    case {"int32", "logical"}
      type = tetstream_core.TYPE_INT32;
    case "int64"
      type = tetstream_core.TYPE_INT64;
    otherwise
      error ("tetstream:bad-argument", "%s: %s is %s; double, single, int32, int64 or logical is wanted",
             caller, name, class (values));
  endswitch
endfunction
