## The time of values, wherever a mesh comes from and goes to.
[points, cells, field] = box_mesh (4);
mesh = struct ("points", points, "cells", cells, "fields", struct ("f", field), "time", 1e-3);
untimed = rmfield (mesh, "time");
folder = tempname ();
mkdir (folder);
cleaner = onCleanup (@() {confirm_recursive_rmdir(false), rmdir(folder, "s")});
at = @(name) fullfile (folder, name);

## From file to file, on the way simplified.
tetstream_convert (mesh, at ("first.vtu"));
first = tetstream_read (at ("first.vtu"));
assert (first.time, 1e-3);
tetstream_simplify_file (first, at ("second.tets"), "ratio", 0.5);
assert (tetstream_info (at ("second.tets")).time, 1e-3);
assert (tetstream_info (untimed).time, []);
tetstream_convert (untimed, at ("third.tets"));
assert (tetstream_read (at ("third.tets")).time, []);

## With arrays.
[P, T, F, S] = tetstream_simplify (points, cells, field, "ratio", 0.5, "time", single (0.5));
assert (S.time, 0.5);
[P, T, F, S] = tetstream_simplify (points, cells, field, "ratio", 0.5);
assert (S.time, []);

## A stream has that of its first batch, and gives it with each.
function take (state, batch)
  state("time") = batch.time;
endfunction
for given = {mesh, untimed; 1e-3, []}
  state = containers.Map ("KeyType", "char", "ValueType", "any");
  tetstream_simplify_stream (once (given{1}), @(batch) take (state, batch), ...
                             "ratio", 0.5, "indexed", true);
  assert (state("time"), given{2});
endfor

## What is wrong.
refused = @(part, time) fails ("tetstream:bad-argument", part, ...
                               @() tetstream_info (setfield (mesh, "time", time)));
refused ("the time is not finite", NaN);
assert (tetstream_info (setfield (mesh, "time", sparse (2.5))).time, 2.5);
for time = {"noon", "", [1, 2], 2i, {1}, true}
  refused ("time: a number is wanted", time{1});
endfor
