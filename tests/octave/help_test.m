## Every function has a help text that begins with how it is called; the demonstration runs.
place = fileparts (which ("tetstream_simplify"));
files = dir (fullfile (place, "tetstream_*.m"));
assert (numel (files) >= 8);
for i = 1:numel (files)
  name = files(i).name(1:end-2);
  text = get_help_text (name);
  assert (! isempty (strfind (strtok (text, "\n"), name)), "help %s begins with: %s", name, ...
          strtok (text, "\n"));
endfor

picture = [tempname(), ".svg"];
words = evalc ("tetstream_demo (picture)");
assert (! isempty (strfind (words, "48000 cells -> 239")), words);
assert (! isempty (strfind (words, "RMS error")), words);
assert (! isempty (strfind (fileread (picture), "<svg")));
delete (picture);
