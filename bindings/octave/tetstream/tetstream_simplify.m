## [P, T, F, S] = tetstream_simplify (points, cells, fields, "ratio", 0.1, ...)
## [small, S] = tetstream_simplify (mesh, "ratio", 0.1, ...)
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
## mesh: all of that in one struct, as tetstream_read makes it; small is another one, and S has the
##   report, the regions and the vertex map.
##
## One target at least is wanted; the first that is reached ends the run:
##   "ratio"   cells out / cells in
##   "cells"   cells out
##   "error"   RMS error of the fields in percent of their range
## Further pairs:
##   "regions"      m labels, whose regions and interfaces are kept, also among the cell data of the
##                  result; or the name of one of the cell data, "auto", "none"
##   "weights"      struct of field to its weight in the error; others are then only carried along
##   "vertex_map"   true: S.map.cells (n; 0: in no cell) and S.map.weights (n x 4) tell in which cell
##                  of the result each point lies
##   "progress"     a function that is called with a struct some times a second; its error ends the
##                  run
##   and every option of `tetstream simplify`, "boundary_weight" or "boundary-weight"; numbers may be
##   texts: "memory", "64M"
## and, of a mesh in arrays:
##   "cell_data"    struct of m x k arrays; floats are averaged by volume, integers picked
##   "locked"       n logicals: points that are never moved
##   "faces", "face_labels", "locked_faces", "locked_edges"   f x 3, f, f logicals, e x 2
##   "label_names"  what labels mean, as in tetstream_read; "time" of the values
##
## Errors have identifiers such as "tetstream:bad-data"; a target that was missed is the warning
## "tetstream:target-missed". Ctrl-C ends a run.
##
## See also: tetstream_simplify_file, tetstream_simplify_stream, tetstream_read, tetstream_compare,
## tetstream_demo, and tetstream-octave(3).
function [P, T, F, S] = tetstream_simplify (points, varargin)
  caller = "tetstream_simplify";
  own = struct ("regions", "auto", "weights", [], "vertex_map", false, "progress", []);
  if (nargin > 0 && isstruct (points))
    [P, T] = simplified (caller, points, own, varargin);
    return;
  endif
  if (nargin < 3)
    print_usage ();
  endif
  [cells, fields] = varargin{1:2};
  parts = {"cell_data", "locked", "faces", "face_labels", "locked_faces", "locked_edges", ...
           "label_names", "time"};
  for part = parts
    own.(part{1}) = [];
  endfor
  mesh = struct ("points", {points}, "cells", {cells}, "fields", {named(fields)});
  [small, S] = simplified (caller, mesh, own, varargin(3:end));
  P = small.points;
  T = small.cells;
  F = small.fields;
  if (! isstruct (fields))
    F = zeros (rows (P), 0);
    if (! isempty (fields))
      F = small.fields.field;
    endif
  endif
  for [value, name] = rmfield (small, {"points", "cells", "fields"})
    S.(name) = value;
  endfor
endfunction

## The small mesh, and in S what is told of it. `own` has the pairs that are the caller's own; parts of
## a mesh among them become parts of this one.
function [small, S] = simplified (caller, mesh, own, arguments)
  tetstream_core;
  [options, own] = parsed (caller, own, tetstream_core.SCOPE_SIMPLIFY, arguments);
  need_target (caller, options, arguments);
  for [value, name] = rmfield (own, {"regions", "weights", "vertex_map", "progress"})
    mesh.(name) = value;
  endfor
  mesh = complete_mesh (caller, mesh);
  [mesh, label] = with_regions (caller, mesh, own.regions);
  options.set_text (tetstream_core.OPTION_REGIONS, label);

  [reader, kept] = made_reader (caller, mesh, options);
  type = tetstream_core.TYPE_INT64;
  if (isa (mesh.cells, "int32"))
    type = tetstream_core.TYPE_INT32;
  endif
  collector = tetstream_core.MeshCollector (type);
  writer = tetstream_core.Writer_collect (collector);
  simplifier = tetstream_core.Simplifier (options, writer, own.progress);
  if (own.vertex_map)
    map = tetstream_core.MapCollector (rows (mesh.points));
    simplifier.set_map (map);
  endif
  simplifier.run (reader);

  small = collected (collector, class (mesh.cells));
  small.fields = with_logicals (small.fields, mesh.fields);
  small.cell_data = with_logicals (small.cell_data, mesh.cell_data);
  S = struct ("report", {reported(simplifier, reader, writer)});
  if (! ischar (own.regions))
    S.regions = small.cell_data.(label);
  endif
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
