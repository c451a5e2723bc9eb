## mesh = complete_mesh (caller, mesh): the struct with all members that a mesh or a batch may have;
## those that are missing are empty.
function mesh = complete_mesh (caller, mesh)
  whole = struct ("points", [], "cells", [], "fields", struct (), "cell_data", struct (),
                  "last_uses", [], "locked", [], "finalized", [], "faces", [], "face_labels", [],
                  "locked_faces", [], "locked_edges", [], "label_names", [], "time", []);
  if (! isstruct (mesh) || ! isscalar (mesh))
    error ("tetstream:bad-argument", "%s: a mesh is a struct with members points, cells, ..., not a %s",
           caller, class (mesh));
  endif
  for [value, name] = mesh
    if (! isfield (whole, name))
      error ("tetstream:bad-argument", "%s: a mesh has no member \"%s\"", caller, name);
    endif
    whole.(name) = value;
  endfor
  for name = {"fields", "cell_data"}
    if (isempty (whole.(name{1})))
      whole.(name{1}) = struct ();
    elseif (! isstruct (whole.(name{1})))
      error ("tetstream:bad-argument", "%s: %s: a struct of arrays by name is wanted, not a %s", caller,
             name{1}, class (whole.(name{1})));
    endif
  endfor
  mesh = whole;
endfunction
