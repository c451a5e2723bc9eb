## refuse_reading (caller, options, source): options that say how a file is read are for files alone.
function refuse_reading (caller, options, source)
  tetstream_core;
  for [row, name] = table ()
    if (row.scope == tetstream_core.SCOPE_READ
        && ! strcmp (options.get_text (row.id), row.default_text))
      error ("tetstream:bad-argument", "%s: %s says how a file is read, and the source is %s", caller,
             row.name, source);
    endif
  endfor
endfunction
