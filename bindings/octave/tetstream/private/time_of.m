## time = time_of (info): of the values of what a stream carries; [] where it is not known.
function time = time_of (info)
  time = [];
  if (info.is_timed)
    time = info.time;
  endif
endfunction
