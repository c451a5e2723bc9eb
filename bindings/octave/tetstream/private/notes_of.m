## notes = notes_of (...): what readers and writers left out or assumed, as sentences.
function notes = notes_of (varargin)
  notes = {};
  for i = 1:nargin
    at = 0;
    while (! isempty (note = varargin{i}.note (at++)))
      notes{end+1} = note;
    endwhile
  endfor
endfunction
