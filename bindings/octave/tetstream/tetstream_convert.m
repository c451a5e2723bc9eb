## notes = tetstream_convert (source, target, ...)
##
## Writes a mesh, from a file or in a struct as tetstream_read gives it, into a file; the formats follow
## from the paths' endings. An indexed mesh is brought into an order.
## notes: what was left out or assumed, sentences in a cell array.
##
## Pairs: "order", "axis", "memory", "tmpdir" and the other options of `tetstream convert`; "progress", a
## function; "properties", a struct of properties of the target's format, such as compress, "no".
##
## See also: tetstream_read, tetstream_simplify_file.
function notes = tetstream_convert (source, target, varargin)
  if (nargin < 2)
    print_usage ();
  endif
  caller = "tetstream_convert";
  tetstream_core;
  [options, own] = parsed (caller, struct ("progress", [], "properties", []),
                           tetstream_core.SCOPE_ORDER, varargin);
  [reader, kept] = made_reader (caller, source, options);
  writer = made_writer (target, own.properties);
  writer.convert (reader, options, own.progress);
  notes = notes_of (reader, writer);
endfunction
