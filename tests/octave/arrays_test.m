## Arrays in, arrays out.
warning ("error", "tetstream:target-missed");
[points, cells, field] = box_mesh (8);

## A field without a name comes back as one; the cube stays a cube.
[P, T, F, S] = tetstream_simplify (points, cells, field, "ratio", 0.2);
assert (rows (T) <= ceil (0.2 * rows (cells)) && rows (T) > 0.15 * rows (cells));
assert (S.report.cells_out, rows (T));
assert (S.report.reached, "ratio");
assert (size (F), [rows(P), 1]);
assert (columns (P), 3);
assert (class (T), "double");
assert (min (T(:)) == 1 && max (T(:)) == rows (P));
assert (sum (volumes (P, T)), 1, 1e-5);
assert (all (volumes (P, T) > 0));

## The same arguments give the same arrays, whatever the class of the cells, which is kept.
for type = {"int32", "int64"}
  [Q, U, G] = tetstream_simplify (points, feval (type{1}, cells), field, "ratio", 0.2);
  assert (class (U), type{1});
  assert (Q, P);
  assert (double (U), T);
  assert (G, F);
endfor

## Fields by name, of several components, single; integers are picked.
fields = struct ("p", field, "v", single ([field, 2 * field, -field]), "id", int32 ((1:rows (points)).'));
[P, T, F] = tetstream_simplify (single (points), cells, fields, "cells", 500, "weights", struct ("p", 1));
assert (class (P), "single");
assert (class (F.v), "single");
assert (size (F.v), [rows(P), 3]);
assert (class (F.id), "int32");
assert (all (ismember (F.id, fields.id)));
assert (F.v(:,2), 2 * F.v(:,1), 1e-6);

## Logicals are integers on the way, and logicals again.
[P, T, F, S] = tetstream_simplify (points, cells, struct ("p", field, "hot", field > 1), "ratio", 0.2, ...
                                   "cell_data", struct ("low", cells(:,1) < 99), "regions", "none");
assert (class (F.hot), "logical");
assert (class (S.cell_data.low), "logical");
assert (any (F.hot) && ! all (F.hot));
mesh = struct ("points", points, "cells", cells, "fields", struct ("hot", field > 1));
assert (tetstream_info (mesh).ranges.hot, [0; 1]);

## Without fields there are none.
[P, T, F] = tetstream_simplify (points, cells, [], "ratio", 0.3);
assert (size (F), [rows(P), 0]);
[P, T, F] = tetstream_simplify (points, cells, struct (), "ratio", 0.3);
assert (isempty (fieldnames (F)));

## Regions keep their volumes.
labels = 1 + (points(cells(:,1),1) >= 0.5);
[P, T, F, S] = tetstream_simplify (points, cells, field, "ratio", 0.4, "regions", labels, ...
                                   "cell_data", struct ("weight", volumes (points, cells)));
assert (unique (S.regions).', int64 ([1, 2]));
v = volumes (P, T);
assert (sum (v(S.regions == 1)), 0.5, 1e-5);
assert (sort (fieldnames (S.cell_data)), {"region"; "weight"});
assert (S.cell_data.region, S.regions);

## A mesh in one struct gives the same, as another one that can be simplified again.
mesh = struct ("points", points, "cells", cells, "fields", struct ("field", field), ...
               "cell_data", struct ("weight", volumes (points, cells)));
[small, told] = tetstream_simplify (mesh, "ratio", 0.4, "regions", labels, "vertex_map", true);
assert (small.points, P);
assert (small.cells, T);
assert (small.fields.field, F);
assert (small.cell_data, S.cell_data);
assert (told.regions, S.regions);
assert (told.report.cells_out, rows (T));
assert (rows (told.map.cells), rows (points));
[smaller, told] = tetstream_simplify (small, "ratio", 0.8);
assert (rows (smaller.cells) <= 0.8 * rows (T));
assert (! isempty (strfind (told.report.regions, "region")));
fails ("tetstream:bad-argument", "a target is missing", @() tetstream_simplify (mesh));
fails ("tetstream:bad-argument", "no option \"locked\"", ...
       @() tetstream_simplify (mesh, "ratio", 0.5, "locked", true));
fails ("tetstream:bad-argument", "a mesh has no member \"point\"", ...
       @() tetstream_simplify (struct ("point", points), "ratio", 0.5));

## The vertex map carries values that are linear in space back to the input's points.
[P, T, F, S] = tetstream_simplify (points, cells, field, "ratio", 0.2, "vertex_map", true);
assert (size (S.map.weights), [rows(points), 4]);
corners = T(S.map.cells,:);
assert (sum (S.map.weights .* reshape (P(corners,1), size (corners)), 2), points(:,1), 1e-9);

## Locked points stay; labelled faces come back.
locked = points(:,3) == 0;
[P, T, F, S] = tetstream_simplify (points, cells, field, "ratio", 0.5, "locked", locked);
assert (sum (S.locked), sum (locked));
assert (all (ismember (points(locked,:), P(S.locked,:), "rows")));
bottom = cells(all (reshape (points(cells(:,1:3),3), [], 3) == 0, 2),1:3);
[P, T, F, S] = tetstream_simplify (points, cells, field, "ratio", 0.5, "faces", bottom, ...
                                   "face_labels", 7 * ones (rows (bottom), 1));
assert (! isempty (S.faces) && all (S.face_labels == 7));
assert (max (abs (P(S.faces,3))) < 1e-30);

## Progress is told; its errors and wrong arguments are errors with identifiers.
told = containers.Map ("KeyType", "char", "ValueType", "any");
function note (told, progress)
  told(progress.phase) = progress.fraction;
endfunction
tetstream_simplify (points, cells, field, "ratio", 0.2, "progress", @(p) note (told, p));
assert (told("simplify"), 1);
fails ("mine:stop", "enough", @() tetstream_simplify (points, cells, field, "ratio", 0.2, ...
                                                       "progress", @(p) error ("mine:stop", "enough")));
fails ("tetstream:bad-argument", "a target is missing", @() tetstream_simplify (points, cells, field));
fails ("tetstream:bad-argument", "7 is outside 0 to 1", ...
       @() tetstream_simplify (points, cells, field, "ratio", 7));
fails ("tetstream:bad-argument", "no option \"ration\"", ...
       @() tetstream_simplify (points, cells, field, "ratio", 0.1, "ration", 7));
fails ("tetstream:bad-data", "cells(1,1) is 0", ...
       @() tetstream_simplify (points, cells - 1, field, "ratio", 0.1));
fails ("tetstream:bad-argument", "4 columns are wanted", ...
       @() tetstream_simplify (points, cells(:,1:3), field, "ratio", 0.1));
fails ("tetstream:bad-argument", "field has 3 rows", ...
       @() tetstream_simplify (points, cells, field(1:3), "ratio", 0.1));
fails ("tetstream:bad-argument", "a function handle", ...
       @() tetstream_simplify (points, cells, field, "ratio", 0.1, "progress", 4));
refused = @(part, points, cells, field, varargin) fails ("tetstream:bad-argument", part, ...
  @() tetstream_simplify (points, cells, field, "ratio", 0.5, varargin{:}));
refused ("points is a complex double", points * i, cells, field);
refused ("points is a double of size [8 3 2]", zeros (8, 3, 2), cells, field);
refused ("points is a cell", {points}, cells, field);
refused ("field is a complex double", points, cells, field * i);
refused ("field is uint8; double, single, int32, int64 or logical", points, cells, uint8 (field));
refused ("weights: a struct", points, cells, field, "weights", 3);
refused ("the weight of \"field\"", points, cells, field, "weights", struct ("field", "x"));
refused ("regions is a cell", points, cells, field, "regions", {1});
refused ("locked is a cell", points, cells, field, "locked", {1, 2});
refused ("face_labels and locked_faces", points, cells, field, "face_labels", 1);
refused ("option \"ratio\" is given twice", points, cells, field, "ratio", 0.5);
refused = @(part, varargin) fails ("tetstream:bad-argument", part, ...
  @() tetstream_simplify (points, cells, field, varargin{:}));
refused ("option \"ratio\" is a double", "ratio", 0.5i);
refused ("option \"boundary-weight\" is given twice", "cells", 9, "boundary_weight", 3, "boundary-weight", 3);
refused ("option \"progress\" is given twice", "cells", 9, "progress", [], "progress", []);
refused ("\"ratio\", 0 is no target", "ratio", 0, "cells", 9);
refused ("\"cells\", 0 is no target", "cells", "0");
refused ("\"error\", 0 is no target", "error", 0);
refused ("option \"cells\": 1000.5 is no integer", "cells", 1000.5);
refused ("option \"vertex_map\" is a cell", "cells", 9, "vertex_map", {1});
refused ("face_labels: labels are integers", "cells", 9, "faces", bottom, "face_labels", bottom(:,1) / 2);
left = points(cells(:,1),1) < 0.5;
for far = {intmax("uint64"), 1e300, single(1e30), 2^63, -2^64, Inf, -Inf, NaN}
  some = zeros (rows (cells), 1, class (far{1}));
  some(left) = far{1};
  refused ("regions: labels are integers of 64 bits, and one is ", "cells", 9, "regions", some);
  some = repmat (far{1}, rows (bottom), 1);
  refused ("face_labels: labels are integers of 64 bits", "cells", 9, "faces", bottom, "face_labels", some);
endfor
refused ("regions is sparse", "cells", 9, "regions", sparse (left));
refused ("locked: NaN is neither", "cells", 9, "locked", NaN (rows (points), 1));
fails ("tetstream:bad-argument", "cells is sparse", ...
       @() tetstream_simplify (points, sparse (cells), field, "ratio", 0.5));
for far = {uint64(2)^63 - 1, true, int8(-3), intmax("int64"), -2^63, single(2^40)}
  some = zeros (rows (cells), 1, class (far{1}));
  some(left) = far{1};
  [P, T, F, S] = tetstream_simplify (points, cells, field, "ratio", 0.5, "regions", some);
  assert (sort (unique (S.regions)), sort (int64 ([0; far{1}])));
endfor

## Numbers in messages are the caller's, from 1 on; no function of C's is named.
wrong = @(part, points, cells, field) fails ("tetstream:bad-data", part, ...
  @() tetstream_simplify (points, cells, field, "ratio", 0.5));
bad = field;
bad(4) = NaN;
wrong ("point 4: its field is not finite", points, cells, bad);
bad = points;
bad(4,2) = Inf;
wrong ("point 4: its position is not finite", bad, cells, field);
for type = {"double", "int32"}
  bad = feval (type{1}, cells);
  bad(5,2) = bad(5,1);
  wrong (sprintf ("cell 5: point %d is there twice", bad(5,1)), points, bad, field);
endfor
fails ("tetstream:bad-data", "labelled face 2 is the face of no cell", ...
       @() tetstream_simplify (points, cells, field, "ratio", 0.5, "faces", [bottom(1,:); 1, 2, 729]));
try
  tetstream_simplify (points, cells, field, "ratio", 7);
catch raised
  assert (strtok (raised.message, ":"), "option \"ratio\"");
end_try_catch
fails ("tetstream:target-missed", "are left", @() tetstream_simplify ...
       (points, cells, field, "ratio", 0.1, "locked", true (rows (points), 1)));
