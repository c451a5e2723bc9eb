// The module tetstream_core: how Octave's values are what the shared interface speaks of.
%module tetstream_core

%{
#include "octave_language.inl"
%}

// ------------------------------------------------------------------------------------ errors
// Octave's own, and the user's interruption, go on as they are.
%exception {
  try {
    $action
  } catch (const tetstream::swig::Failure& failure) {
    tetstream::swig::raise(failure.status(), failure.what());
  } catch (const std::bad_alloc&) {
    tetstream::swig::raise(TETSTREAM_NO_MEMORY, "there is no memory for the result");
  }
}

// ------------------------------------------------------------------------------------- texts
// [] stands for none.
%typemap(in) const char *format (std::string held) {
  if ($input.isempty() && !$input.is_string()) {
    $1 = nullptr;
  } else {
    held = $input.xstring_value("a text is wanted");
    $1 = held.data();
  }
}
%typemap(freearg) const char *format "";
%apply const char *format { const char *title };

// ------------------------------------------------------------------------------------ arrays
%typemap(in) const octave_value & "$1 = const_cast<octave_value*>(&$input);"
%typemap(typecheck, precedence=SWIG_TYPECHECK_POINTER) const octave_value & "$1 = 1;"
%typemap(out) tetstream::swig::ArrayView "$result = tetstream::swig::copyOf($1);"
%typemap(out) tetstream::swig::OwnedArray & "$result = tetstream::swig::handOver(*$1);"
%typemap(out) double [3] {
  RowVector place(3);
  std::copy($1, $1 + 3, place.fortran_vec());
  $result = place;
}

// ----------------------------------------------------------------------------------- figures
%define FIGURES(TYPE)
%typemap(out) TYPE "$result = tetstream::swig::structOf($&1_descriptor, &$1);"
%enddef
FIGURES(tetstream_option_info)
FIGURES(tetstream_report)
FIGURES(tetstream_layout_report)
FIGURES(tetstream_front_info)
FIGURES(tetstream_face_label_info)
FIGURES(tetstream_comparison_info)
FIGURES(tetstream_mesh_figures)
FIGURES(tetstream_field_comparison)
FIGURES(tetstream_region_comparison)
FIGURES(tetstream_face_label_comparison)
FIGURES(tetstream::swig::FormatInfo)

// --------------------------------------------------------------------------------- functions
%typemap(in) const tetstream::swig::Function &
    (octave_value value, std::unique_ptr<tetstream::swig::Function> function) {
  value = $input;
  function = std::make_unique<tetstream::swig::Function>(tetstream::swig::checkedFunction(value));
  $1 = function.get();
}
%typemap(typecheck, precedence=SWIG_TYPECHECK_POINTER) const tetstream::swig::Function & "$1 = 1;"

%include "tetstream.i"

namespace tetstream::swig {
struct ArrayView {};
class Array : public ArrayView {
 public:
  explicit Array(const octave_value& values);
};
}  // namespace tetstream::swig
