## names = label_names_of (info): what labels mean, of what a stream carries, as a struct array.
function names = label_names_of (info)
  names = struct ("cell_array", {}, "label", {}, "name", {});
  for i = 1:double (info.label_name_count ())
    label = info.label_name_label (i - 1);
    if (abs (label) < flintmax ())
      label = double (label);
    endif
    names(i) = struct ("cell_array", info.label_name_cell_array (i - 1), "label", label,
                       "name", info.label_name_text (i - 1));
  endfor
endfunction
