## writer = made_writer (path, properties): a writer of a file; properties of its format in a struct.
function writer = made_writer (path, properties)
  tetstream_core;
  if (! ischar (path))
    error ("tetstream:bad-argument", "the target is a path, not a %s", class (path));
  endif
  writer = tetstream_core.Writer_create_file (path, []);
  if (! isempty (properties))
    for [value, name] = properties
      if (! ischar (value))
        error ("tetstream:bad-argument", "%s: property \"%s\" is a text, not a %s", path, name,
               class (value));
      endif
      writer.set (name, value);
    endfor
  endif
endfunction
