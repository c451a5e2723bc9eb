## [options, own] = parsed (caller, own, scope, arguments)
## Pairs of name and value: options of the library that count where a file is read, or in that scope,
## go into a handle, names that `own` has as members replace those.
function [options, own] = parsed (caller, own, scope, arguments)
  tetstream_core;
  options = tetstream_core.Options ();
  rows = table ();
  given = {};
  if (mod (numel (arguments), 2) != 0)
    error ("tetstream:bad-argument", "%s: options come in pairs of name and value", caller);
  endif
  for i = 1:2:numel (arguments)
    [name, value] = arguments{i:i+1};
    if (! ischar (name))
      error ("tetstream:bad-argument", "%s: the name of an option is a %s", caller, class (name));
    endif
    plain = strrep (name, "-", "_");
    if (any (strcmp (plain, given)))
      error ("tetstream:bad-argument", "%s: option \"%s\" is given twice", caller, name);
    endif
    given{end+1} = plain;
    if (isfield (own, plain))
      need_like (caller, name, own.(plain), value);
      own.(plain) = value;
    elseif (isfield (rows, plain))
      if (! bitand (rows.(plain).scope, bitor (scope, tetstream_core.SCOPE_READ)))
        error ("tetstream:bad-argument", "%s: option \"%s\" does not count here", caller,
               rows.(plain).name);
      endif
      set_option (caller, options, rows.(plain), value);
    else
      error ("tetstream:bad-argument", "%s: there is no option \"%s\"", caller, name);
    endif
  endfor
  if (isfield (own, "progress"))
    options.set_progress (own.progress);
  endif
  if (isfield (own, "weights") && ! isempty (own.weights))
    if (! isstruct (own.weights) || ! isscalar (own.weights))
      error ("tetstream:bad-argument", "%s: weights: a struct of field to weight is wanted, not a %s",
             caller, class (own.weights));
    endif
    for [weight, field] = own.weights
      if (! isnumeric (weight) || ! isreal (weight) || ! isscalar (weight))
        error ("tetstream:bad-argument", "%s: the weight of \"%s\" is no number", caller, field);
      endif
      options.add_field (field, weight);
    endfor
  endif
endfunction

## The default tells what is wanted: "" a text, false a logical, -1 an integer; the others are looked
## at where they are used.
function need_like (caller, name, default, value)
  if (ischar (default) && isempty (default) && ! ischar (value) && ! isempty (value))
    error ("tetstream:bad-argument", "%s: option \"%s\": a text is wanted, not a %s", caller, name,
           class (value));
  elseif (islogical (default) || isequal (default, -1))
    need_number (caller, name, value);
  endif
  if (isequal (default, -1))
    need_integer (caller, name, value);
  endif
endfunction

function need_number (caller, name, value)
  if (! (isnumeric (value) || islogical (value)) || ! isscalar (value) || ! isreal (value))
    error ("tetstream:bad-argument", "%s: option \"%s\" is a %s of size %s", caller, name,
           class (value), mat2str (size (value)));
  endif
endfunction

function need_integer (caller, name, value)
  if (value != fix (value))
    error ("tetstream:bad-argument", "%s: option \"%s\": %g is no integer", caller, name, value);
  endif
endfunction

## A text is read as on a command line: "2G", "1e6".
function set_option (caller, options, row, value)
  tetstream_core;
  if (ischar (value))
    options.parse (row.name, value);
    return;
  endif
  need_number (caller, row.name, value);
  if (islogical (value) && strcmp (row.choices, "no yes"))
    options.set_text (row.id, {"no", "yes"}{1 + value});
  elseif (strcmp (row.name, "step") && value == fix (value))
    options.set_text (row.id, sprintf ("%d", value));
  elseif (row.type == tetstream_core.OPTION_IS_TEXT)
    error ("tetstream:bad-argument", "%s: option \"%s\": a text is wanted", caller, row.name);
  elseif (row.type == tetstream_core.OPTION_IS_INT64)
    need_integer (caller, row.name, value);
    options.parse (row.name, sprintf ("%d", value));
  else
    options.set_double (row.id, double (value));
  endif
endfunction
