## array = core_rows (values): rows of numbers, one below the other, as the library has them.
function array = core_rows (values)
  tetstream_core;
  array = tetstream_core.Array (values.');
endfunction
