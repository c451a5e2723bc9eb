## need_target (caller, options, arguments): one of the three targets is given, and none is 0.
function need_target (caller, options, arguments)
  tetstream_core;
  targets = struct ("ratio", options.get_double (tetstream_core.OPTION_RATIO),
                    "cells", options.get_int64 (tetstream_core.OPTION_CELLS),
                    "error", options.get_double (tetstream_core.OPTION_ERROR));
  given = intersect (fieldnames (targets), arguments(1:2:end));
  for i = 1:numel (given)
    if (targets.(given{i}) == 0)
      error ("tetstream:bad-argument", "%s: \"%s\", 0 is no target: give more than 0", caller, given{i});
    endif
  endfor
  if (isempty (given))
    error ("tetstream:bad-argument",
           "%s: a target is missing: \"ratio\" (cells out / cells in), \"cells\" or \"error\" (percent)",
           caller);
  endif
endfunction
