## A struct array of what `get` gives for 0, 1, ..., count - 1.
function found = all_of (get, count)
  found = [struct([]), arrayfun(get, 0:(count - 1), "UniformOutput", false){:}];
endfunction
