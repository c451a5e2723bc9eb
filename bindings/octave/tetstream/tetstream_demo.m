## tetstream_demo ()
## tetstream_demo (picture)
##
## Makes a mesh of 20 x 20 x 20 boxes with the field of a wave on it, keeps a twentieth of its cells and
## prints what that came to. With `picture`, a path that ends in .png or .svg, it draws a cut through
## both meshes.
##
## See also: tetstream_simplify, tetstream_compare.
function tetstream_demo (picture)
  [points, cells] = box_mesh (20);
  wave = sin (6 * points(:,1)) .* cos (4 * points(:,2)) + points(:,3) .^ 2;
  [P, T, F, S] = tetstream_simplify (points, cells, struct ("wave", wave), "ratio", 0.05);
  printf ("%d cells -> %d cells in %.2f s\n", rows (cells), rows (T), S.report.seconds);

  before = struct ("points", points, "cells", cells, "fields", struct ("wave", wave));
  after = struct ("points", P, "cells", T, "fields", F);
  more = {};
  if (nargin > 0)
    more = {"picture", picture};
  endif
  figures = tetstream_compare (before, after, more{:});
  printf ("RMS error of the wave: %.2f %% of its range; largest: %.2f %%\n",
          figures.fields.wave.rms_percent, figures.fields.wave.largest_percent);
endfunction

## A cube of n x n x n boxes, each in six cells from its lowest corner to its highest.
function [points, cells] = box_mesh (n)
  [x, y, z] = ndgrid (0:n, 0:n, 0:n);
  points = [x(:), y(:), z(:)] / n;
  low = find (x < n & y < n & z < n);
  steps = perms ([1, n + 1, (n + 1) ^ 2]);
  cells = zeros (0, 4);
  for i = 1:6
    cells = [cells; low + [0, cumsum(steps(i,:))]];
  endfor
endfunction
