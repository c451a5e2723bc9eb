## The shared problem in Octave, as README.md states it: a mesh in a struct into a file, and arrays into
## arrays.
boxes = 12;
side = boxes + 1;
[x, y, z] = ndgrid (0:boxes, 0:boxes, 0:boxes);
points = [x(:), y(:), z(:)] / 4;
pressure = x(:) .^ 2 .* y(:) - 3 * z(:);
velocity = single ([y(:) - z(:), x(:) .* z(:), x(:) + y(:)]);

corner = find (x < boxes & y < boxes & z < boxes).';
steps = [1, side, side ^ 2](flipud (perms (1:3)));
cells = reshape (corner + reshape ([zeros(6, 1), cumsum(steps, 2)].', 24, 1), 4, []).';
material = int32 (1 + (x(corner) >= boxes / 2));
material = reshape (repmat (material(:).', 6, 1), [], 1);

fields = struct ("pressure", pressure, "velocity", velocity);
cell_data = struct ("material", material);
options = {"ratio", 0.2, "boundary-weight", 4, "regions", "material", ...
           "weights", struct("pressure", 1, "velocity", 0.5)};

mesh = struct ("points", points, "cells", cells, "fields", fields, "cell_data", cell_data);
tetstream_simplify_file (mesh, "octave.tets", options{:});
[P, T, F, S] = tetstream_simplify (points, cells, fields, "cell_data", cell_data, options{:});
file = fopen ("octave.raw", "wb");
fwrite (file, P.', "double");
fwrite (file, F.pressure, "double");
fwrite (file, F.velocity.', "single");
fwrite (file, int64 (T.') - 1, "int64");
fwrite (file, S.cell_data.material, "int32");
fclose (file);
