## Files: the same bytes as the command's, and what is said about them.
folder = tempname ();
mkdir (folder);
cleaner = onCleanup (@() {confirm_recursive_rmdir(false), rmdir(folder, "s")});
at = @(name) fullfile (folder, name);
bracket = fullfile (getenv ("TETSTREAM_SOURCE"), "tests", "data", "bracket", "bracket.vtu");

report = tetstream_simplify_file (bracket, at ("small.vtu"), "ratio", 0.05, "weights", ...
                                  struct ("von_mises", 1), "map_file", at ("small.tetmap"));
assert (report.cells_in, 75232);
assert (report.target_cells, 3761);
assert (report.cells_out <= 3761 && report.cells_out >= 3751);
assert (! isempty (dir (at ("small.tetmap"))));
command = getenv ("TETSTREAM_COMMAND");
if (! isempty (command))
  [status, words] = system (sprintf ("'%s' simplify '%s' '%s' --ratio 0.05 --field von_mises --quiet", ...
                                     command, bracket, at ("command.vtu")));
  assert (status, 0);
  assert (fileread (at ("small.vtu")), fileread (at ("command.vtu")));
endif

info = tetstream_info (at ("small.vtu"));
assert (info.cell_count, report.cells_out);
assert (info.vertex_count, report.vertices_out);
assert (isfield (info.fields, "von_mises"));
assert (size (info.box), [2, 3]);
assert (size (info.ranges.von_mises), [2, 1]);
assert (info.front.width > 0);

figures = tetstream_compare (bracket, at ("small.vtu"), "weights", struct ("von_mises", 1), ...
                             "picture", at ("both.svg"));
assert (figures.original.cells, 75232);
assert (figures.simplified.cells, report.cells_out);
assert (figures.fields.von_mises.rms_percent > 0 && figures.fields.von_mises.rms_percent < 5);
assert (figures.topology_kept, 1);
assert (! isempty (strfind (fileread (at ("both.svg")), "<svg")));
assert (isempty (figures.face_labels));

## Read, written, and the same again.
mesh = tetstream_read (at ("small.vtu"));
assert (rows (mesh.cells), report.cells_out);
assert (min (mesh.cells(:)), 1);
notes = tetstream_convert (mesh, at ("again.vtk"), "order", "none");
assert (iscellstr (notes));
again = tetstream_read (at ("again.vtk"));
assert (sort (again.fields.von_mises), sort (mesh.fields.von_mises));
tetstream_convert (mesh, at ("plain.vtu"), "properties", struct ("compress", "no"));
tetstream_convert (mesh, at ("packed.vtu"), "properties", struct ("compress", "yes"));
assert (dir (at ("plain.vtu")).bytes > dir (at ("packed.vtu")).bytes);
figures = tetstream_compare (mesh, mesh);
assert (figures.fields.von_mises.largest_percent, 0, 1e-9);
assert (isempty (figures.only_original) && isempty (figures.only_simplified));
renamed = mesh;
renamed.fields = struct ("stress", mesh.fields.von_mises, "s1", mesh.fields.von_mises);
figures = tetstream_compare (mesh, renamed, "boundary-samples", 100);
assert (figures.only_simplified, {"stress", "s1"});
assert (figures.only_original, fieldnames (mesh.fields)');

## Opening a text tells how far it is.
told = containers.Map ();
function note (told, progress)
  told(progress.phase) = progress.fraction;
endfunction
tetstream_convert (at ("small.vtu"), at ("told.mesh"));
tetstream_info (at ("told.mesh"), "progress", @(p) note (told, p));
assert (told("open") > 0 && told("open") <= 1);
fails ("mine:stop", "enough", ...
       @() tetstream_read (at ("told.mesh"), "progress", @(p) error ("mine:stop", "enough")));

## Options of the reading count where a file is opened, and only there.
file = fopen (at ("cube.vtk"), "w");
fprintf (file, ["# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n" ...
                "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\nCELLS 1 9\n8 0 1 2 3 4 5 6 7\n" ...
                "CELL_TYPES 1\n12\n"]);
fclose (file);
cube = tetstream_read (at ("cube.vtk"), "split", "yes");
assert (any (rows (cube.cells) == [5, 6]));
assert (tetstream_info (at ("cube.vtk"), "split", "yes").cell_count, rows (cube.cells));
tetstream_convert (at ("cube.vtk"), at ("cube.tets"), "split", "yes");
figures = tetstream_compare (at ("cube.vtk"), at ("cube.tets"), "split", "yes");
assert (figures.simplified.cells, rows (cube.cells));
assert (tetstream_compare (at ("cube.vtk"), cube, "split", "yes").original.cells, rows (cube.cells));
tetstream_convert (cube, at ("cube.vtu"));
figures = tetstream_compare (at ("cube.tets"), at ("cube.vtu"), "recover", "yes");
assert (figures.simplified.cells, rows (cube.cells));
fails ("tetstream:unsupported", "split", @() tetstream_read (at ("cube.vtk")));
fails ("tetstream:unsupported", "recover", ...
       @() tetstream_read (at ("cube.vtk"), "split", "yes", "recover", "yes"));
fails ("tetstream:bad-argument", "step", @() tetstream_info (cube, "step", "7"));
fails ("tetstream:bad-argument", "step", ...
       @() tetstream_simplify (cube.points, cube.cells, [], "cells", 5, "step", "7"));
assert (rows (tetstream_read (at ("cube.vtk"), "split", true).cells), rows (cube.cells));
fails ("tetstream:bad-argument", "needs the members points and cells", ...
       @() tetstream_info (struct ("points", cube.points)));
fails ("tetstream:bad-argument", "there is no option \"ratoi\"", ...
       @() tetstream_simplify_file (at ("cube.vtk"), at ("none.tets"), "ratoi", 1));
fails ("tetstream:unsupported", "there is no time step 3", ...
       @() tetstream_read (at ("cube.vtk"), "split", true, "step", 3));
fails ("tetstream:bad-argument", "tetstream_read: option \"ratio\" does not count here", ...
       @() tetstream_read (at ("cube.tets"), "ratio", 0.5));
fails ("tetstream:bad-argument", "option \"order\" does not count here", ...
       @() tetstream_compare (at ("cube.tets"), cube, "order", "none"));
fails ("tetstream:bad-argument", "split", ...
       @() tetstream_simplify_stream (@() [], @(batch) 0, "cells", 5, "split", "yes"));

faced = setfield (setfield (cube, "faces", cube.cells([1, 1],1:3)), "face_labels", [7; 8]);
faced.faces(2,:) = cube.cells(1,2:4);
figures = tetstream_compare (faced, faced);
assert ([figures.face_labels.label], [7, 8]);
assert ([figures.face_labels.simplified_faces], [1, 1]);
fails ("tetstream:bad-argument", "fields: a struct of arrays by name", ...
       @() tetstream_info (setfield (cube, "fields", 5)));
fails ("tetstream:bad-argument", "option \"map_file\": a text", ...
       @() tetstream_simplify_file (cube, at ("none.tets"), "cells", 5, "map_file", 3));
fails ("tetstream:bad-argument", "option \"picture\": a text", ...
       @() tetstream_compare (cube, cube, "picture", 3));
fails ("tetstream:io", "nothing.vtu", @() tetstream_info (at ("nothing.vtu")));
fails ("tetstream:bad-argument", "not a double", @() tetstream_convert (mesh, 3));
fails ("tetstream:bad-argument", "\"compress\" is a text", ...
       @() tetstream_convert (mesh, at ("x.vtu"), "properties", struct ("compress", 3)));
fails ("tetstream:unsupported", "x.xyz", @() tetstream_convert (mesh, at ("x.xyz")));
fails ("tetstream:bad-argument", "no member \"point\"", @() tetstream_info (struct ("point", 1)));
