## add_bounds (caller, info, fields, box, ranges): the box of a stream, 2 x 3, and the ranges of its
## fields, a struct of 2 x k, go into what it carries; none, if the box is [].
function add_bounds (caller, info, fields, box, ranges)
  if (isempty (ranges))
    ranges = struct ();
  endif
  if (! isstruct (ranges))
    error ("tetstream:bad-argument", "%s: ranges: a struct is wanted, not a %s", caller, class (ranges));
  endif
  if (isempty (box))
    if (numfields (ranges) > 0)
      error ("tetstream:bad-argument", "%s: ranges: they count beside a box, which is not given", caller);
    endif
    return;
  endif
  for [values, name] = ranges
    if (! isfield (fields, name))
      error ("tetstream:bad-argument", "%s: ranges: \"%s\" is no field", caller, name);
    endif
  endfor
  bounds = checked (caller, "box", box, 3);
  for [values, name] = fields
    if (! isfield (ranges, name))
      error ("tetstream:bad-argument", "%s: ranges: that of \"%s\" is missing", caller, name);
    endif
    bounds = [bounds, checked(caller, name, ranges.(name), columns (values))];
  endfor
  for limits = bounds
    info.add_bound (limits(1), limits(2));
  endfor
endfunction

function limits = checked (caller, name, limits, count)
  if (count == 1 && isvector (limits))
    limits = limits(:);
  endif
  if (! isnumeric (limits) || ! isequal (size (limits), [2, count]))
    error ("tetstream:bad-argument", "%s: bounds of %s: a matrix of 2 x %d is wanted", caller, name, count);
  endif
  limits = double (limits);
endfunction
