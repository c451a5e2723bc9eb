## v = volumes (points, cells): of each cell, without signs.
function v = volumes (points, cells)
  a = points(cells(:,2),:) - points(cells(:,1),:);
  b = points(cells(:,3),:) - points(cells(:,1),:);
  c = points(cells(:,4),:) - points(cells(:,1),:);
  v = abs (dot (a, cross (b, c, 2), 2)) / 6;
endfunction
