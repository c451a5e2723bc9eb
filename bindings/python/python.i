// The module tetstream._core: how Python's objects are what the shared interface speaks of.
%module(package="tetstream") core

%begin %{
#define PY_SSIZE_T_CLEAN
%}
%{
#include "python_language.inl"
%}
%init %{
  import_array();
  tetstream::swig::findMainThread();
%}

// ------------------------------------------------------------------------------- exceptions
%exception {
  try {
    $action
  } catch (...) {
    tetstream::swig::raise();
    SWIG_fail;
  }
}

// ------------------------------------------------------------------------------------ texts
// Names out of files may be in another encoding; None stands for none.
%typemap(in) const char * (PyObject *encoded = nullptr) {
  if (!tetstream::swig::textOf($input, encoded)) SWIG_fail;
  if (encoded) $1 = PyBytes_AS_STRING(encoded);
}
%typemap(freearg) const char * "Py_XDECREF(encoded$argnum);"

// What os.fsencode takes, and os.PathLike.
%typemap(in) const char *path (PyObject *encoded = nullptr) {
  if (!PyUnicode_FSConverter($input, &encoded)) SWIG_fail;
  $1 = PyBytes_AS_STRING(encoded);
}
%typemap(freearg) const char *path "Py_XDECREF(encoded$argnum);"

// ----------------------------------------------------------------------------------- arrays
%typemap(in) const tetstream::swig::ArrayView & (tetstream::swig::ArrayView view) {
  if (!tetstream::swig::viewOf($input, view)) SWIG_fail;
  $1 = &view;
}
%typemap(typecheck, precedence=SWIG_TYPECHECK_POINTER) const tetstream::swig::ArrayView & "$1 = 1;"
%typemap(out) tetstream::swig::ArrayView {
  $result = tetstream::swig::copyOf($1);
  if (!$result) SWIG_fail;
}
%typemap(out) tetstream::swig::OwnedArray & {
  $result = tetstream::swig::handOver(*$1);
  if (!$result) SWIG_fail;
}
%typemap(out) double [3] "$result = Py_BuildValue(\"(ddd)\", $1[0], $1[1], $1[2]);"

// -------------------------------------------------------------------------------- functions
%typemap(in) const tetstream::swig::Function & {
  if ($input != Py_None && !PyCallable_Check($input)) {
    PyErr_Format(PyExc_TypeError, "a callable or None is wanted, not %s", Py_TYPE($input)->tp_name);
    SWIG_fail;
  }
  $1 = new tetstream::swig::Function($input == Py_None ? nullptr : $input);
}
%typemap(freearg) const tetstream::swig::Function & "delete $1;"

%include "tetstream.i"
