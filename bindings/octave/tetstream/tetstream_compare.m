## figures = tetstream_compare (original, simplified, ...)
##
## How well a simplified mesh stands for its original; each is a path, or a mesh in a struct.
## figures: a struct: fields, a struct of field to its error: rms, rms_percent (of the range), largest,
##   cpsnr, ...; original and simplified: cells, volume, components, least_angle, ... of each;
##   regions and face_labels: struct arrays by label; topology_kept; distance, between the boundaries;
##   only_original and only_simplified, cells with the names of fields that the other mesh does not
##   have; and the other members of tetstream_comparison_info in tetstream_comparison(3), lengths in
##   the meshes' units.
##
## Pairs: "weights", a struct of field to weight: only these are compared, those of weight 0 left out;
##   "samples", "boundary-samples", "seed", "box", "regions", "memory", "tmpdir", "threads"; "step",
##   "split", "recover", "join-points", "cells-to-points" of the original, and of the other where it is
##   a file that takes them; "picture": a path, .svg or .png: a cut through both meshes is drawn, at the
##   option "cut"; "progress", a function.
##
## See also: tetstream_simplify, tetstream_info.
function figures = tetstream_compare (original, simplified, varargin)
  if (nargin < 2)
    print_usage ();
  endif
  caller = "tetstream_compare";
  own = struct ("weights", [], "progress", [], "picture", "");
  tetstream_core;
  [options, own] = parsed (caller, own, tetstream_core.SCOPE_COMPARE, varargin);
  if (! isempty (own.picture) && strcmp (options.get_text (tetstream_core.OPTION_CUT), "none"))
    options.set_text (tetstream_core.OPTION_CUT, "auto");
  endif
  [first, kept_first] = made_reader (caller, original, options);
  [second, kept_second] = made_reader (caller, simplified, options, "result");
  comparison = tetstream_core.Comparison (options);
  comparison.read (first, second, own.progress);
  figures = comparison.get_info ();
  figures.labels = figures.regions;
  figures.only_original = regexp (figures.only_original, '[^\n]+', "match");
  figures.only_simplified = regexp (figures.only_simplified, '[^\n]+', "match");
  figures.original = comparison.get_mesh (tetstream_core.ORIGINAL);
  figures.simplified = comparison.get_mesh (tetstream_core.SIMPLIFIED);
  figures.fields = struct ();
  for i = 0:(figures.field_count - 1)
    field = comparison.get_field (i);
    figures.fields.(field.name) = field;
  endfor
  figures.regions = all_of (@(i) comparison.get_region (i), figures.region_count);
  figures.face_labels = all_of (@(i) comparison.get_face_label (i), figures.face_label_count);
  figures.notes = notes_of (first, second);
  if (! isempty (own.picture))
    comparison.write (own.picture, []);
  endif
endfunction
