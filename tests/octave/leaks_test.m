## Many calls, also those that fail, leave the process as large as it was.
[points, cells, field] = box_mesh (5);

function kilobytes = resident ()
  words = fileread ("/proc/self/status");
  kilobytes = str2double (regexp (words, 'VmRSS:\s*(\d+)', "tokens"){1}{1});
endfunction

function call_all (points, cells, field, times)
  for i = 1:times
    [P, T, F, S] = tetstream_simplify (points, cells, field, "ratio", 0.4, "vertex_map", true);
    try
      tetstream_simplify (points, cells, field, "ratio", 0.4, "progress", @(p) error ("my:stop", "stop"));
    catch
    end_try_catch
    try
      tetstream_info ("/nowhere/nothing.vtu");
    catch
    end_try_catch
  endfor
endfunction

if (! exist ("/proc/self/status", "file"))
  exit (77);
endif
call_all (points, cells, field, 50);
before = resident ();
call_all (points, cells, field, 150);
grown = resident () - before;
assert (grown < 1000, "150 rounds took %d kB, of which one mesh is %d", grown, ...
        round (8 * numel (cells) / 1024));
