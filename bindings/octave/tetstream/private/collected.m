## mesh = collected (collector, cell_class): what a collector holds, as a mesh; points from 1 on.
function mesh = collected (collector, cell_class)
  info = collector.info ();
  mesh = struct ("points", collector.positions ().');
  mesh.cells = cast (collector.cells () + 1, cell_class).';
  mesh.fields = mesh.cell_data = struct ();
  for i = 0:(info.field_count () - 1)
    mesh.fields.(info.field_name (i)) = collector.field (i).';
  endfor
  for i = 0:(info.cell_data_count () - 1)
    mesh.cell_data.(info.cell_data_name (i)) = collector.cell_data (i).';
  endfor
  mesh.locked = logical (collector.locked ().');
  mesh.faces = collector.faces ().' + 1;
  mesh.face_labels = collector.face_labels ().';
  mesh.locked_faces = logical (collector.locked_faces ().');
  mesh.locked_edges = collector.locked_edges ().' + 1;
  mesh.label_names = label_names_of (info);
  mesh.time = time_of (info);
endfunction
