## report = tetstream_simplify_file (source, target, "ratio", 0.1, ...)
##
## Simplifies a file into another, in memory that depends on the front of the stream and not on the
## size of the mesh. The bytes are those of the command `tetstream simplify` with the same options.
##
## source: a path, or a mesh in a struct with members points, cells, fields, cell_data, ...
## target: a path. The formats follow from the paths' endings.
## report: what was done, a struct: cells_in, cells_out, estimated_error, seconds, ..., notes.
##
## One of the targets "ratio", "cells" and "error" is wanted. Further pairs:
##   "weights", "progress"    as in tetstream_simplify
##   "map_file", "log_file"   where a map of the vertices, or the log of collapses, is written
##   "properties"             struct of properties of the target's format, such as compress, "no"
##   and every option of `tetstream simplify`.
##
## See also: tetstream_simplify, tetstream_convert, tetstream_info.
function report = tetstream_simplify_file (source, target, varargin)
  if (nargin < 2)
    print_usage ();
  endif
  caller = "tetstream_simplify_file";
  own = struct ("weights", [], "progress", [], "map_file", "", "log_file", "", "properties", []);
  tetstream_core;
  [options, own] = parsed (caller, own, tetstream_core.SCOPE_SIMPLIFY, varargin);
  need_target (caller, options, varargin);
  [reader, kept] = made_reader (caller, source, options);
  writer = made_writer (target, own.properties);
  simplifier = tetstream_core.Simplifier (options, writer, own.progress);
  if (! isempty (own.map_file))
    simplifier.set_map_file (own.map_file, []);
  endif
  if (! isempty (own.log_file))
    simplifier.set_log_file (own.log_file, []);
  endif
  simplifier.run (reader);
  report = reported (simplifier, reader, writer);
endfunction
