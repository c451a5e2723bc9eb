## [points, cells, field] = box_mesh (n): a cube of n x n x n boxes, each in six cells from its lowest
## corner to its highest, with a bend in the field.
function [points, cells, field] = box_mesh (n)
  [x, y, z] = ndgrid (0:n, 0:n, 0:n);
  points = [x(:), y(:), z(:)] / n;
  low = find (x < n & y < n & z < n);
  steps = perms ([1, n + 1, (n + 1) ^ 2]);
  cells = [];
  for i = 1:6
    cells = [cells; low + [0, cumsum(steps(i,:))]];
  endfor
  field = abs (points(:,1) - 0.4) + points(:,2) .^ 2;
endfunction
