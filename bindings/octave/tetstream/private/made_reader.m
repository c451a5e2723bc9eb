## [reader, kept] = made_reader (caller, source, options): a reader of a file, or of a mesh in a struct;
## it is good as long as `kept` is.
function [reader, kept] = made_reader (caller, source, options)
  tetstream_core;
  kept = {};
  if (ischar (source))
    reader = tetstream_core.Reader_open_file (source, [], options);
    return;
  endif
  refuse_reading (caller, options, "a struct");
  mesh = complete_mesh (caller, source);
  info = announced (caller, mesh);
  info.is_indexed = true;
  [batch, kept] = filled_batch (caller, mesh, rows (mesh.points));
  reader = tetstream_core.Reader_open_mesh (info, batch);
endfunction
