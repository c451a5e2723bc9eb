## report = reported (simplifier, ...): what was done, with the notes of readers and writers; warns of a
## target that was missed.
function report = reported (simplifier, varargin)
  report = simplifier.get_report ();
  report.notes = notes_of (varargin{:});
  if (! isempty (report.limited_by))
    warning ("tetstream:target-missed",
             "the target of %d cells was missed, %d are left; limited by: %s", report.target_cells,
             report.cells_out, report.limited_by);
  endif
endfunction
