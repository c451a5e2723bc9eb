## Names of labels, of faces and of cell arrays, wherever a mesh comes from and goes to.
[points, cells, field] = box_mesh (4);
bottom = cells(all (reshape (points(cells(:,1:3),3), [], 3) == 0, 2),1:3);
part = int32 (1 + (points(cells(:,1),1) >= 0.5));
names = struct ("cell_array", {"", "part", "part"}, "label", {7, 1, 2}, ...
                "name", {"inlet", "steel", "oil"});
mesh = struct ("points", points, "cells", cells, "fields", struct ("f", field), ...
               "cell_data", struct ("part", part), "faces", bottom, ...
               "face_labels", 7 * ones (rows (bottom), 1), "label_names", names);
folder = tempname ();
mkdir (folder);
cleaner = onCleanup (@() {confirm_recursive_rmdir(false), rmdir(folder, "s")});
at = @(name) fullfile (folder, name);

## From file to file, on the way simplified.
tetstream_convert (mesh, at ("first.msh"));
first = tetstream_read (at ("first.msh"));
assert (first.label_names, names);
tetstream_simplify_file (first, at ("second.msh"), "ratio", 0.5);
assert (! isempty (strfind (fileread (at ("second.msh")), "\"inlet\"")));
assert (tetstream_info (at ("second.msh")).label_names, names);
told = tetstream_info (mesh);
assert (told.face_count, rows (bottom));
assert (double ([told.face_labels.label]), 7);
assert (double ([told.face_labels.faces]), rows (bottom));
assert (isempty (tetstream_info (struct ("points", points, "cells", cells)).face_labels));
notes = tetstream_convert (mesh, at ("third.vtu"));
assert (! isempty (strfind ([notes{:}], "faces 7 \"inlet\"")), "%s", notes{:});
assert (isempty (tetstream_info (at ("third.vtu")).label_names));

## With arrays; labels of regions that have no name of their own are not mistaken for others.
more = {"ratio", 0.5, "cell_data", mesh.cell_data, "faces", bottom, ...
        "face_labels", mesh.face_labels};
[P, T, F, S] = tetstream_simplify (points, cells, field, "label_names", names, more{:});
assert (S.label_names, names);
[P, T, F, S] = tetstream_simplify (points, cells, field, more{:});
assert (isempty (S.label_names) && isstruct (S.label_names));
region = struct ("cell_array", "region", "label", 2, "name", "oil");
fails ("tetstream:bad-argument", "label name \"oil\": there is no cell array \"region\"", ...
       @() tetstream_simplify (points, cells, field, "ratio", 0.5, "regions", part, ...
                               "label_names", region));

## Labels that no double holds stay what they are.
far = struct ("cell_array", {"part", "part"}, "label", {-3, intmax("int64")}, "name", {"a", "b"});
told = tetstream_info (setfield (mesh, "label_names", far)).label_names;
assert ({told.label}, {-3, intmax("int64")});

## A stream has those of its first batch, and gives them with each.
function take (state, batch)
  state("names") = batch.label_names;
endfunction
state = containers.Map ("KeyType", "char", "ValueType", "any");
tetstream_simplify_stream (once (mesh), @(batch) take (state, batch), "ratio", 0.5, ...
                           "indexed", true);
assert (state("names"), names);

## What is wrong.
refused = @(part, names) fails ("tetstream:bad-argument", part, ...
                                @() tetstream_info (setfield (mesh, "label_names", names)));
one = names(1);
refused ("label name \"inlet\": there is no cell array \"nowhere\"", ...
         setfield (one, "cell_array", "nowhere"));
refused ("faces 7 has two names, \"inlet\" and \"inlet\"", [one, one]);
refused ("the name of faces 7 has no bytes", setfield (one, "name", ""));
refused ("a struct array of cell_array, label and name", {7, "inlet"});
refused ("a struct array of cell_array, label and name", rmfield (one, "label"));
refused ("label_names(2): cell_array and name are texts", [one, setfield(one, "name", 3)]);
refused ("label_names(1): cell_array and name are texts", setfield (one, "cell_array", 3));
for label = {3.5, "7", [1, 2], 2i, 1e300, uint64(2)^63}
  refused ("label_names(1): the label is no integer", setfield (one, "label", label{1}));
endfor
