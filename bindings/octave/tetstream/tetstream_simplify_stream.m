## report = tetstream_simplify_stream (reader, writer, "ratio", 0.1, ...)
##
## Simplifies a mesh while it is being made: `reader` gives it in batches, `writer` takes the result in
## batches, in final form.
##
## reader: a function without arguments; each call gives the next batch, a struct; one with nothing
##   in it, or [], ends the stream. Members of a batch, all optional:
##   points (n x 3), fields (struct of n x k), locked (n logicals); cells (m x 4, numbers of points
##   from 1 on, counted through all batches), cell_data (struct of m x k), last_uses (m x 4 logicals:
##   no later cell uses that point), finalized (points that no later cell uses); faces, face_labels,
##   locked_faces, locked_edges. What the first batch has, classes too, is what the stream carries, by
##   the same names later, in any order; its label_names and time, as in tetstream_read, are the
##   stream's. Messages number points and cells of the stream from 0.
## writer: a function that is called with such batches.
## report: what was done.
##
## Further pairs:
##   "cell_count"    how many cells will come; a ratio is met early only where it is known
##   "vertex_count", "face_count", "front_width", "front_span", "front_cells"   as far as they are
##                   known; face_count: labelled faces
##   "box", "ranges" as of tetstream_info, if they are known: 2 x 3, and a struct of 2 x k for each
##                   field; errors are then measured in units of these from the first cell on
##   "indexed"       true: points are never finalized; the mesh is collected and ordered first
##   "weights", "progress", and every option of `tetstream simplify`.
##
## See also: tetstream_simplify, tetstream_simplify_file.
function report = tetstream_simplify_stream (reader, writer, varargin)
  if (nargin < 2)
    print_usage ();
  endif
  caller = "tetstream_simplify_stream";
  for given = {reader, writer}
    if (! is_function_handle (given{1}))
      error ("tetstream:bad-argument", "%s: reader and writer are function handles, not a %s", caller,
             class (given{1}));
    endif
  endfor
  own = struct ("cell_count", -1, "vertex_count", -1, "face_count", -1, "front_width", -1,
                "front_span", -1, "front_cells", -1, "box", [], "ranges", [], "indexed", false,
                "weights", [], "progress", []);
  tetstream_core;
  [options, own] = parsed (caller, own, tetstream_core.SCOPE_SIMPLIFY, varargin);
  need_target (caller, options, varargin);
  refuse_reading (caller, options, "a stream");
  state = containers.Map ("KeyType", "char", "ValueType", "any");  # what the writer is told when it begins
  core_writer = tetstream_core.Writer_create (@(info) begun (state, info),
                                              @(batch) writer (shown (batch, state)), []);
  simplifier = tetstream_core.Simplifier (options, core_writer, own.progress);

  batch = complete_mesh (caller, next_batch (reader));
  info = announced (caller, batch);
  info.is_indexed = logical (own.indexed);
  for name = {"cell_count", "vertex_count", "face_count", "front_width", "front_span", "front_cells"}
    info.(name{1}) = own.(name{1});
  endfor
  add_bounds (caller, info, batch.fields, own.box, own.ranges);
  simplifier.begin (info);
  first = batch;
  while (has_any (batch))
    [events, kept] = filled_batch (caller, batch, 0, Inf);
    simplifier.push (events);
    batch = in_order_of (caller, first, complete_mesh (caller, next_batch (reader)));
  endwhile
  simplifier.finish ();
  report = reported (simplifier, core_writer);
endfunction

function any_there = has_any (batch)
  any_there = false;
  for name = {"points", "cells", "finalized", "faces", "locked_edges"}
    any_there = any_there || ! isempty (batch.(name{1}));
  endfor
endfunction

## The library goes by the order in which the first batch has its arrays.
function batch = in_order_of (caller, first, batch)
  for part = {"fields", "cell_data"; "points", "cells"}
    if (isempty (batch.(part{2})))
      continue;
    endif
    names = {fieldnames(first.(part{1})), fieldnames(batch.(part{1}))};
    if (! isequal (sort (names{1}), sort (names{2})))
      error ("tetstream:bad-argument", "%s: %s: a batch has %s, the first one has %s", caller, part{1},
             listed (names{2}), listed (names{1}));
    endif
    batch.(part{1}) = orderfields (batch.(part{1}), first.(part{1}));
  endfor
endfunction

function text = listed (names)
  text = "none";
  if (! isempty (names))
    text = strjoin (cellfun (@(name) ["\"", name, "\""], names(:).', "UniformOutput", false), ", ");
  endif
endfunction

function batch = next_batch (reader)
  batch = reader ();
  if (isempty (batch) && ! isstruct (batch))
    batch = struct ();
  endif
endfunction

function begun (state, info)
  names = {};
  for i = 0:(info.field_count () - 1)
    names{end+1} = info.field_name (i);
  endfor
  state("fields") = names;
  names = {};
  for i = 0:(info.cell_data_count () - 1)
    names{end+1} = info.cell_data_name (i);
  endfor
  state("cell_data") = names;
  state("label_names") = label_names_of (info);
  state("time") = time_of (info);
endfunction

## A batch of the library's as a struct.
function batch = shown (source, state)
  batch = struct ("points", source.positions ().', "cells", source.cells ().' + 1,
                  "fields", struct (), "cell_data", struct ());
  names = state("fields");
  for i = 1:numel (names)
    batch.fields.(names{i}) = source.field (i - 1).';
  endfor
  names = state("cell_data");
  for i = 1:numel (names)
    batch.cell_data.(names{i}) = source.cell_data (i - 1).';
  endfor
  batch.last_uses = logical (mod (floor (double (source.last_uses ().') ./ [1, 2, 4, 8]), 2));
  batch.locked = logical (source.locked ().');
  batch.finalized = source.finalized ().' + 1;
  batch.faces = source.faces ().' + 1;
  batch.face_labels = source.face_labels ().';
  batch.locked_edges = source.locked_edges ().' + 1;
  batch.label_names = state("label_names");
  batch.time = state("time");
endfunction
