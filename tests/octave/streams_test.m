## Batches from a function to a function.
[points, cells, field] = box_mesh (8);

## Slabs of the mesh, in which points are numbered as they come and finalized by their last uses.
order = sortrows ([max(cells, [], 2), (1:rows (cells)).'])(:,2);
cells = cells(order,:);
[~, last] = unique (flipud (cells.'(:)), "first");
is_last = false (numel (cells), 1);
is_last(numel (cells) + 1 - last) = true;
is_last = reshape (is_last, 4, []).';

function batch = next (state, points, cells, field, is_last)
  step = 200;
  part = state("at"):min (state("at") + step - 1, rows (cells));
  state("at") = state("at") + step;
  batch = struct ();
  if (isempty (part))
    return;
  endif
  fresh = (state("points") + 1):max (max (max (cells(part,:))), state("points"));
  state("points") = max (max (max (cells(part,:))), state("points"));
  batch = struct ("points", points(fresh,:), "fields", struct ("f", field(fresh)), ...
                  "cells", cells(part,:), "last_uses", is_last(part,:));
endfunction
function take (state, batch)
  state("result_points") = [state("result_points"); batch.points];
  state("result_field") = [state("result_field"); batch.fields.f];
  state("result_cells") = [state("result_cells"); batch.cells];
  state("calls") = state("calls") + 1;
endfunction
function state = fresh_state ()
  state = containers.Map ("KeyType", "char", "ValueType", "any");
  for [value, name] = struct ("at", 1, "points", 0, "result_points", [], "result_field", [], ...
                              "result_cells", [], "calls", 0)
    state(name) = value;
  endfor
endfunction

state = fresh_state ();
report = tetstream_simplify_stream (@() next (state, points, cells, field, is_last), ...
                                    @(batch) take (state, batch), "ratio", 0.3, ...
                                    "cell_count", rows (cells));
assert (report.cells_in, rows (cells));
assert (report.cells_out, rows (state("result_cells")));
assert (rows (state("result_cells")) <= ceil (0.3 * rows (cells)));
assert (sum (volumes (state("result_points"), state("result_cells"))), 1, 1e-5);
assert (numel (state("result_field")), rows (state("result_points")));

## A box and ranges that are told are those that it finds, where it holds all.
limits = @(values) [min(values); max(values)];
told = fresh_state ();
tetstream_simplify_stream (@() next (told, points, cells, field, is_last), ...
                           @(batch) take (told, batch), "ratio", 0.3, "cell_count", rows (cells), ...
                           "box", limits (points), "ranges", struct ("f", limits (field)));
assert (told("result_cells"), state("result_cells"));
function report = bounded (points, cells, field, is_last, varargin)
  state = fresh_state ();
  report = tetstream_simplify_stream (@() next (state, points, cells, field, is_last), ...
                                      @(batch) 0, "ratio", 0.3, varargin{:});
endfunction
for wrong = {{"box", limits(points)}, {"ranges", struct("f", [0, 1])}, ...
             {"box", limits(points), "ranges", struct("f", [0, 1], "g", [0, 1])}, ...
             {"box", [0, 1], "ranges", struct("f", [0, 1])}, ...
             {"box", flipud(limits(points)), "ranges", struct("f", [0, 1])}; ...
             "that of \"f\" is missing", "beside a box", "\"g\" is no field", "2 x 3", "upside down"}
  fails ("tetstream:bad-argument", wrong{2}, ...
         @() bounded (points, cells, field, is_last, wrong{1}{:}));
endfor

## An indexed mesh, in one batch, comes back as tetstream_simplify gives it.
state = fresh_state ();
function batch = whole (state, points, cells, field)
  batch = [];
  if (state("at") == 1)
    batch = struct ("points", points, "fields", struct ("f", field), "cells", cells);
    state("at") = 2;
  endif
endfunction
tetstream_simplify_stream (@() whole (state, points, cells, field), @(batch) take (state, batch), ...
                           "ratio", 0.3, "indexed", true);
[P, T, F] = tetstream_simplify (points, cells, struct ("f", field), "ratio", 0.3);
assert (state("result_points"), P);
assert (double (state("result_cells")), T);
assert (state("result_field"), F.f);

## Arrays of later batches are known by their names, in whatever order.
function batch = in_turns (state, later)
  state("at") += 1;
  batch = [];
  if (state("at") == 2)
    batch = struct ("points", eye (4, 3), "cells", [1, 2, 3, 4], ...
                    "fields", struct ("p", [1; 2; 3; 4], "u", [-1; -2; -3; -4]), ...
                    "cell_data", struct ("a", int32 (1), "b", int32 (2)));
  elseif (state("at") == 3)
    batch = struct ("points", [1, 1, 1], "cells", [2, 3, 4, 5], "fields", later, ...
                    "cell_data", struct ("b", int32 (2), "a", int32 (1)));
  endif
endfunction
function keep (state, batch)
  if (! isempty (batch.points))
    state("result_field") = [state("result_field"); batch.fields.p, batch.fields.u];
  endif
  if (! isempty (batch.cells))
    state("result_cells") = [state("result_cells"); batch.cell_data.a, batch.cell_data.b];
  endif
endfunction
state = fresh_state ();
tetstream_simplify_stream (@() in_turns (state, struct ("u", -5, "p", 5)), ...
                           @(batch) keep (state, batch), "ratio", 1);
assert (sortrows (state("result_field")), [(1:5)', -(1:5)']);
assert (double (state("result_cells")), [1, 2; 1, 2]);
for wrong = {struct("x", 5, "y", -5), struct("p", 5), struct("p", 5, "u", -5, "more", 1), struct(); ...
             "\"x\", \"y\", the first one has \"p\", \"u\"", "has \"p\", the", "\"more\", the", ...
             "none, the"}
  state = fresh_state ();
  fails ("tetstream:bad-argument", wrong{2}, ...
         @() tetstream_simplify_stream (@() in_turns (state, wrong{1}), @(batch) 0, "ratio", 1));
endfor

## Errors of either function come out as they are; what is none is refused.
fails ("tetstream:bad-argument", "function handles, not a double", ...
       @() tetstream_simplify_stream (3, @(batch) 0, "ratio", 0.3));
fails ("tetstream:bad-argument", "last_uses: 4 columns", @() tetstream_simplify_stream ...
       (@() struct ("points", points, "cells", cells, "last_uses", true (rows (cells), 1)), ...
        @(batch) 0, "ratio", 0.3));
fails ("tetstream:bad-argument", "option \"cell_count\": 1000.5 is no integer", ...
       @() tetstream_simplify_stream (@() [], @(batch) 0, "ratio", 0.3, "cell_count", 1000.5));
fails ("my:reader", "no more", @() tetstream_simplify_stream (@() error ("my:reader", "no more"), ...
                                                               @(batch) 0, "ratio", 0.3));
state = fresh_state ();
fails ("my:writer", "full", @() tetstream_simplify_stream ...
       (@() whole (state, points, cells, field), @(batch) error ("my:writer", "full"), "ratio", 0.3, ...
        "indexed", true));
