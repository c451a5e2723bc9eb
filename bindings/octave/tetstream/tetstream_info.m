## info = tetstream_info (source, ...)
##
## Reads everything and tells what a mesh is, of a file or in a struct: vertex_count, cell_count,
## face_count (labelled faces); fields and cell_data: structs of name to the number of components;
## box: 2 x 3, least and largest coordinates; ranges: a struct of field to its least and largest
## values, 2 x k; label_names and time, as in tetstream_read; face_labels: a struct array
## of label and faces, their number (empty where more than 65536 labels number the faces); front:
## how coherent its order is, width and span in vertices, cells that touch them; notes. An indexed
## mesh's front is that of the order in which it is streamed.
##
## Pairs: "memory", "order", "axis", "tmpdir", "threads"; of files "step", "split", "recover",
## "join-points", "cells-to-points"; "progress", a function.
##
## See also: tetstream_compare, tetstream_read.
function info = tetstream_info (source, varargin)
  if (nargin < 1)
    print_usage ();
  endif
  caller = "tetstream_info";
  tetstream_core;
  [options, own] = parsed (caller, struct ("progress", []), tetstream_core.SCOPE_ORDER, varargin);
  [reader, kept] = made_reader (caller, source, options);
  found = reader.inspect (options, own.progress);
  info = struct ("vertex_count", double (found.vertex_count),
                 "cell_count", double (found.cell_count), "face_count", double (found.face_count),
                 "fields", struct (), "cell_data", struct (), "box", [], "ranges", struct (),
                 "indexed", found.is_indexed, "front", reader.get_front ());
  limits = [found.box_min(); found.box_max()];
  if (! isempty (limits))
    info.box = limits(:,1:3);
  endif
  at = 4;
  for i = 0:(found.field_count () - 1)
    count = double (found.field_components (i));
    info.fields.(found.field_name (i)) = count;
    if (! isempty (limits))
      info.ranges.(found.field_name (i)) = limits(:,at:at+count-1);
    endif
    at += count;
  endfor
  for i = 0:(found.cell_data_count () - 1)
    info.cell_data.(found.cell_data_name (i)) = double (found.cell_data_components (i));
  endfor
  info.label_names = label_names_of (found);
  info.time = time_of (found);
  info.face_labels = all_of (@(i) reader.get_face_label (i), double (reader.face_label_count ()));
  info.notes = notes_of (reader);
endfunction
