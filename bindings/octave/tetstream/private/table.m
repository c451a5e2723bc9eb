## rows = table (): the library's table of options, by name.
function rows = table ()
  persistent known;
  if (isempty (known))
    tetstream_core;
    known = struct ();
    for i = 0:(tetstream_core.option_count () - 1)
      row = tetstream_core.option_at (i);
      known.(strrep (row.name, "-", "_")) = row;
    endfor
  endif
  rows = known;
endfunction
