## need_target (caller, arguments): one of the three targets is given.
function need_target (caller, arguments)
  names = arguments(1:2:end);
  if (! any (cellfun (@(name) any (strcmp (name, {"ratio", "cells", "error"})), names)))
    error ("tetstream:bad-argument",
           "%s: a target is missing: \"ratio\" (cells out / cells in), \"cells\" or \"error\" (percent)",
           caller);
  endif
endfunction
