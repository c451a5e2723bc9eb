## reader = once (batch): a function that gives the batch, then nothing.
function reader = once (batch)
  state = containers.Map ("KeyType", "char", "ValueType", "any");
  reader = @() given (state, batch);
endfunction

function batch = given (state, batch)
  if (state.isKey ("given"))
    batch = [];
  endif
  state("given") = true;
endfunction
