## [reader, kept] = made_reader (caller, source, options): a reader of a file, or of a mesh in a struct;
## it is good as long as `kept` is. With "result" last, of what is compared with a mesh that is opened
## with these options.
function [reader, kept] = made_reader (caller, source, options, role = "")
  tetstream_core;
  kept = {};
  is_result = strcmp (role, "result");
  if (ischar (source) && is_result)
    reader = tetstream_core.Reader_open_result (source, [], options);
    return;
  elseif (ischar (source))
    reader = tetstream_core.Reader_open_file (source, [], options);
    return;
  elseif (! is_result)
    refuse_reading (caller, options, "a struct");
  endif
  mesh = complete_mesh (caller, source);
  if (! isfield (source, "points") || ! isfield (source, "cells"))
    error ("tetstream:bad-argument", "%s: a mesh needs the members points and cells", caller);
  endif
  info = announced (caller, mesh);
  info.is_indexed = true;
  [batch, kept] = filled_batch (caller, mesh, 1, rows (mesh.points));
  reader = tetstream_core.Reader_open_mesh (info, batch, true);
endfunction
