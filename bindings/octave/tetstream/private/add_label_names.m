## add_label_names (caller, info, names): what labels mean, a struct array, goes into what a stream
## carries.
function add_label_names (caller, info, names)
  if (isempty (names))
    return;
  endif
  members = {"cell_array"; "label"; "name"};
  if (! isstruct (names) || ! isequal (sort (fieldnames (names)), members))
    error ("tetstream:bad-argument",
           "%s: label_names: a struct array of cell_array, label and name is wanted", caller);
  endif
  for i = 1:numel (names)
    row = names(i);
    if (! (ischar (row.cell_array) || isempty (row.cell_array)) || ! ischar (row.name))
      error ("tetstream:bad-argument", "%s: label_names(%d): cell_array and name are texts",
             caller, i);
    endif
    if (! (isnumeric (row.label) && isreal (row.label) && isscalar (row.label)
           && int64 (row.label) == row.label))
      error ("tetstream:bad-argument", "%s: label_names(%d): the label is no integer",
             caller, i);
    endif
    info.add_label_name (char (row.cell_array), int64 (row.label), row.name);
  endfor
endfunction
