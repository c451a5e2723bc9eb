## The examples of tetstream-octave(3) run, one after the other, and every function is in its page.
text = fileread (fullfile (getenv ("TETSTREAM_SOURCE"), "man", "man3", "tetstream-octave.3"));
files = dir (fullfile (fileparts (which ("tetstream_simplify")), "tetstream_*.m"));
for i = 1:numel (files)
  assert (! isempty (strfind (text, [".It Fn " files(i).name(1:end-2) "\n"])), files(i).name);
endfor

text = text(strfind (text, ".Sh EXAMPLES"):end);
begins = strfind (text, ".Bd -literal");
ends = strfind (text, ".Ed");
assert (numel (begins) >= 2);
folder = tempname ();
mkdir (folder);
before = cd (folder);
words = "";
for i = 1:numel (begins)
  [~, code] = strtok (text(begins(i):ends(i)-1), "\n");
  words = [words, evalc(strrep (code, "\\e", "\\"))];
endfor
cd (before);
confirm_recursive_rmdir (false);
rmdir (folder, "s");
assert (! isempty (regexp (words, '^600 cells, about [0-9.]+ %\n[0-9.e-]+\n$')), words);
