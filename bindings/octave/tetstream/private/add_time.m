## add_time (caller, info, time): of the values, a number, or [] where it is not known, goes into what
## a stream carries.
function add_time (caller, info, time)
  if (isnumeric (time) && isempty (time))
    return;
  endif
  if (! isnumeric (time) || ! isreal (time) || ! isscalar (time))
    error ("tetstream:bad-argument", "%s: time: a number is wanted", caller);
  endif
  info.time = full (double (time));
  info.is_timed = true;
endfunction
