## fails (identifier, part, function): the function raises that error, and its message has that part.
function fails (identifier, part, run)
  try
    run ();
  catch raised
    assert (raised.identifier, identifier);
    assert (! isempty (strfind (raised.message, part)), "\"%s\" is not in: %s", part, raised.message);
    return;
  end_try_catch
  error ("no error was raised; %s is wanted", identifier);
endfunction
