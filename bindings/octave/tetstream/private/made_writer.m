## writer = made_writer (path, properties): a writer of a file; properties of its format in a struct.
function writer = made_writer (path, properties)
  tetstream_core;
  writer = tetstream_core.Writer_create_file (path, []);
  if (! isempty (properties))
    for [value, name] = properties
      writer.set (name, value);
    endfor
  endif
endfunction
