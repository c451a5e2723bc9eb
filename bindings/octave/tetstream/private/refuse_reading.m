## refuse_reading (caller, options, source): options that say how a file is read are for files alone.
function refuse_reading (caller, options, source)
  rows = table ();
  for name = reading ()
    row = rows.(name{1});
    if (! strcmp (options.get_text (row.id), row.default_text))
      error ("tetstream:bad-argument", "%s: %s says how a file is read, and the source is %s", caller,
             row.name, source);
    endif
  endfor
endfunction
