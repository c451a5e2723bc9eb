## names = reading (): the options that say what is made of a file when it is opened.
function names = reading ()
  names = {"split", "recover", "step", "join_points", "cells_to_points"};
endfunction
