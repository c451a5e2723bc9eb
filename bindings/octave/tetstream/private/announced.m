## info = announced (caller, mesh): what a stream carries, as a mesh or a first batch shows.
function info = announced (caller, mesh)
  tetstream_core;
  info = tetstream_core.StreamInfo ();
  info.position_type = type_of (caller, "points", mesh.points);
  for [values, name] = mesh.fields
    info.add_field (name, columns (values), type_of (caller, name, values));
  endfor
  for [values, name] = mesh.cell_data
    info.add_cell_data (name, columns (values), type_of (caller, name, values));
  endfor
  add_label_names (caller, info, mesh.label_names);
  add_time (caller, info, mesh.time);
endfunction
