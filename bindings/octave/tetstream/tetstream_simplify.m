## [P, T, F, S] = tetstream_simplify (points, cells, fields, "ratio", 0.1, ...)
##
## Simplifies a tetrahedral mesh in arrays, following its fields.
##
## points: n x 3, double or single, in any unit of length.
## cells: m x 4, the rows of `points` of each cell, from 1 on, in either orientation.
## fields: values at the points, in any units: n x k, or a struct of such arrays by name, or [].
##   double and single are interpolated, int32, int64 and logical picked.
## P, T, F are the same of the result; F is a struct if `fields` was one. S has more of it: report,
##   what was done; cell_data; regions; locked; faces, face_labels; label_names; time; and the vertex
##   map.
##
## One target at least is wanted; the first that is reached ends the run:
##   "ratio"   cells out / cells in
##   "cells"   cells out
##   "error"   RMS error of the fields in percent of their range
## Further pairs:
##   "cell_data"    struct of m x k arrays; floats are averaged by volume, integers picked
##   "regions"      m labels, whose regions and interfaces are kept; or the name of one of the cell
##                  data, "auto", "none"
##   "weights"      struct of field to its weight in the error; others are then only carried along
##   "locked"       n logicals: points that are never moved
##   "faces", "face_labels", "locked_faces", "locked_edges"   f x 3, f, f logicals, e x 2
##   "label_names"  what labels mean, as in tetstream_read; "time" of the values
##   "vertex_map"   true: S.map.cells (n; 0: in no cell) and S.map.weights (n x 4) tell in which cell
##                  of the result each point lies
##   "progress"     a function that is called with a struct some times a second; its error ends the
##                  run
##   and every option of `tetstream simplify`, "boundary_weight" or "boundary-weight"; numbers may be
##   texts: "memory", "64M"
##
## Errors have identifiers such as "tetstream:bad-data"; a target that was missed is the warning
## "tetstream:target-missed". Ctrl-C ends a run.
##
## See also: tetstream_simplify_file, tetstream_simplify_stream, tetstream_read, tetstream_compare,
## tetstream_demo, and tetstream-octave(3).
function [P, T, F, S] = tetstream_simplify (points, cells, fields, varargin)
  if (nargin < 3)
    print_usage ();
  endif
  caller = "tetstream_simplify";
  own = struct ("cell_data", [], "regions", "auto", "weights", [], "locked", [], "faces", [],
                "face_labels", [], "locked_faces", [], "locked_edges", [], "label_names", [],
                "time", [], "vertex_map", false, "progress", []);
  tetstream_core;
  [options, own] = parsed (caller, own, tetstream_core.SCOPE_SIMPLIFY, varargin);
  need_target (caller, options, varargin);
  mesh = struct ("points", {points}, "cells", {cells}, "fields", {named(fields)},
                 "cell_data", {own.cell_data}, "locked", {own.locked}, "faces", {own.faces},
                 "face_labels", {own.face_labels}, "locked_faces", {own.locked_faces},
                 "locked_edges", {own.locked_edges}, "label_names", {own.label_names},
                 "time", {own.time});
  mesh = complete_mesh (caller, mesh);
  [mesh, label] = with_regions (caller, mesh, own.regions);
  options.set_text (tetstream_core.OPTION_REGIONS, label);

  [reader, kept] = made_reader (caller, mesh, options);
  type = tetstream_core.TYPE_INT64;
  if (isa (cells, "int32"))
    type = tetstream_core.TYPE_INT32;
  endif
  collector = tetstream_core.MeshCollector (type);
  writer = tetstream_core.Writer_collect (collector);
  simplifier = tetstream_core.Simplifier (options, writer, own.progress);
  if (own.vertex_map)
    map = tetstream_core.MapCollector (rows (points));
    simplifier.set_map (map);
  endif
  simplifier.run (reader);

  S = collected (collector, class (cells));
  S.fields = with_logicals (S.fields, mesh.fields);
  S.cell_data = with_logicals (S.cell_data, mesh.cell_data);
  P = S.points;
  T = S.cells;
  F = S.fields;
  if (! isstruct (fields))
    F = zeros (rows (P), 0);
    if (! isempty (fields))
      F = S.fields.field;
    endif
  endif
  S = rmfield (S, {"points", "cells", "fields"});
  if (! ischar (own.regions))
    S.regions = S.cell_data.(label);
    S.cell_data = rmfield (S.cell_data, label);
  endif
  S.report = reported (simplifier, reader, writer);
  if (own.vertex_map)
    S.map = struct ("cells", map.cells ().' + 1, "weights", map.weights ().');
  endif
endfunction

## Fields by name: one without is "field".
function fields = named (fields)
  if (isempty (fields) && ! isstruct (fields))
    fields = struct ();
  elseif (! isstruct (fields))
    fields = struct ("field", {fields});
  endif
endfunction

## Arrays of the result, which are logical again where those were.
function arrays = with_logicals (arrays, given)
  for [values, name] = given
    if (islogical (values))
      arrays.(name) = logical (arrays.(name));
    endif
  endfor
endfunction

## Labels of the caller's become one more cell array, whose name is the option.
function [mesh, label] = with_regions (caller, mesh, regions)
  label = regions;
  if (ischar (regions))
    return;
  endif
  label = "region";
  used = fieldnames (mesh.cell_data);
  if (isfield (mesh.label_names, "cell_array"))
    used = [used; {mesh.label_names.cell_array}(:)];
  endif
  while (any (strcmp (label, used)))
    label = [label "_"];
  endwhile
  mesh.cell_data.(label) = core_labels (caller, "regions", regions);
endfunction

%!demo
%! tetstream_demo ();
