## mesh = tetstream_read (source, ...)
##
## A mesh of everything that a file has, as a struct: points (n x 3), cells (m x 4, from 1 on), fields
## and cell_data (structs of arrays), locked, faces, face_labels, locked_faces, locked_edges;
## label_names, what labels mean: a struct array of cell_array, "" for faces, label and name; and
## time, of the values, [] where it is not known. A stream keeps its order; the cells of an indexed
## mesh come in that of a sweep, points as they are used first, those of no cell left out.
##
## Pairs: "step", "split", "recover", "join-points", "cells-to-points", of files; "order", "axis",
## "memory", "tmpdir"; "progress", a function.
##
## See also: tetstream_convert, which writes one.
function mesh = tetstream_read (source, varargin)
  if (nargin < 1)
    print_usage ();
  endif
  tetstream_core;
  caller = "tetstream_read";
  [options, own] = parsed (caller, struct ("progress", []), tetstream_core.SCOPE_ORDER, varargin);
  [reader, kept] = made_reader (caller, source, options);
  collector = tetstream_core.MeshCollector (tetstream_core.TYPE_INT64);
  writer = tetstream_core.Writer_collect (collector);
  writer.convert (reader, options, own.progress);
  mesh = collected (collector, "double");
endfunction
