// python: what the shared part leaves to a language, and how numpy's arrays and Python's exceptions
// cross. Part of the wrapper that SWIG generates.
#define NPY_NO_DEPRECATED_API NPY_1_7_API_VERSION
#include <numpy/arrayobject.h>

#include <pthread.h>

#include <chrono>
#include <cstring>
#include <memory>
#include <new>
#include <thread>

#include "failure.h"
#include "handles.h"

namespace tetstream::swig {

// ------------------------------------------------------------------------- the lock, functions

[[noreturn]] static void waitForTheEnd() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

// Runs a call that may wait for the interpreter's lock. Before 3.14 Python ends a thread that waits
// for it while the interpreter ends: a daemon's, when the program is over. Where that unwinds the
// thread, it would come to frames that let nothing out, and the process be aborted.
// note: as from 3.14 on, such a thread waits for the end of the process. Nothing else is thrown.
template <class Call>
auto waiting(Call&& call) noexcept {
  try {
    return call();
  } catch (...) {
    waitForTheEnd();
  }
}

// The number of the thread that ends the interpreter; 0: not known.
static unsigned long main_thread = 0;

static void findMainThread() {
  PyObject* const threading = PyImport_ImportModule("threading");
  PyObject* const main =
      threading ? PyObject_CallMethod(threading, "main_thread", nullptr) : nullptr;
  PyObject* const number = main ? PyObject_GetAttrString(main, "ident") : nullptr;
  if (number) main_thread = PyLong_AsUnsignedLong(number);
  if (PyErr_Occurred()) main_thread = 0;
  PyErr_Clear();
  Py_XDECREF(number);
  Py_XDECREF(main);
  Py_XDECREF(threading);
  ::pthread_atfork(nullptr, nullptr, [] { main_thread = PyThread_get_thread_ident(); });
}

// A daemon that comes when the interpreter is gone would ask it for a state of the thread.
static void waitIfItEnds() {
  if (main_thread != 0 && !Py_IsInitialized() && PyThread_get_thread_ident() != main_thread)
    waitForTheEnd();
}

// The interpreter's lock, whether or not this thread has it.
class Locked {
 public:
  Locked() : state_(ensure()) {}
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
  ~Locked() { PyGILState_Release(state_); }

 private:
  static PyGILState_STATE ensure() {
    waitIfItEnds();
    return waiting([] { return PyGILState_Ensure(); });
  }
  PyGILState_STATE state_;
};

Unlocked::Unlocked() : state_(PyEval_SaveThread()) {}

Unlocked::~Unlocked() {
  waitIfItEnds();
  waiting([this] { PyEval_RestoreThread(static_cast<PyThreadState*>(state_)); });
}

// An exception of Python's on its way through C++: type, value, traceback. It is the last of its
// copies that gives them up, which happens where the wrapper has the lock.
class Raised {
 public:
  Raised() : parts_(new Parts, [](Parts* parts) { drop(parts); }) {
    PyErr_Fetch(&parts_->type, &parts_->value, &parts_->traceback);
  }
  void restore() const {
    PyErr_Restore(parts_->type, parts_->value, parts_->traceback);
    *parts_ = {};
  }

 private:
  struct Parts {
    PyObject *type = nullptr, *value = nullptr, *traceback = nullptr;
  };
  static void drop(Parts* parts) {
    const Locked locked;
    waiting([parts] {
      Py_XDECREF(parts->type);
      Py_XDECREF(parts->value);
      Py_XDECREF(parts->traceback);
    });
    delete parts;
  }

  std::shared_ptr<Parts> parts_;
};

Function::Function(void* object) : object_(object) {
  Py_XINCREF(static_cast<PyObject*>(object_));
}

Function::Function(const Function& other) : Function(other.object_) {}

Function::~Function() {
  if (!object_) return;
  const Locked locked;
  waiting([this] { Py_DECREF(static_cast<PyObject*>(object_)); });
}

void Function::operator()(const char* type, void* object) const {
  const Locked locked;
  swig_type_info* const wrapped_as = SWIG_TypeQuery(type);
  const bool is_done = waiting([&] {
    PyObject* const argument = SWIG_NewPointerObj(object, wrapped_as, 0);
    PyObject* const result =
        argument ? PyObject_CallFunctionObjArgs(static_cast<PyObject*>(object_), argument, nullptr)
                 : nullptr;
    Py_XDECREF(argument);
    Py_XDECREF(result);
    return result != nullptr;
  });
  if (!is_done) throw Raised();
}

void checkInterrupt() {
  const Locked locked;
  if (waiting([] { return PyErr_CheckSignals(); }) != 0) throw Raised();
}

// ---------------------------------------------------------------------------------- exceptions

// tetstream.errors makes the exception that belongs to a status. A sentence may name a file or a
// field that is not in UTF-8.
static void raiseStatus(tetstream_status status, const char* sentence) {
  PyObject* const module = PyImport_ImportModule("tetstream.errors");
  if (!module) return;
  PyObject* const exception = PyObject_CallMethod(
      module, "_from_status", "iN", status,
      PyUnicode_DecodeUTF8(sentence, static_cast<Py_ssize_t>(std::strlen(sentence)),
                           "surrogateescape"));
  if (exception) PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception)), exception);
  Py_XDECREF(exception);
  Py_DECREF(module);
}

// Called while a C++ exception is handled: sets Python's.
static void raise() {
  try {
    throw;
  } catch (const Raised& raised) {
    raised.restore();
  } catch (const Failure& failure) {
    raiseStatus(failure.status(), failure.what());
  } catch (const std::bad_alloc&) {
    raiseStatus(TETSTREAM_NO_MEMORY, "there is no memory for the result");
  } catch (const std::exception& other) {
    raiseStatus(TETSTREAM_INTERNAL, other.what());
  }
}

// --------------------------------------------------------------------------------------- texts

// A str as bytes, which the caller gives up; the other way it was decoded alike. None leaves them
// null. False with an exception set for what is no text.
static bool textOf(PyObject* object, PyObject*& encoded) {
  if (object == Py_None) return true;
  if (!PyUnicode_Check(object)) {
    PyErr_Format(PyExc_TypeError, "a str is wanted, not %s", Py_TYPE(object)->tp_name);
    return false;
  }
  encoded = PyUnicode_AsEncodedString(object, "utf-8", "surrogateescape");
  if (!encoded) return false;
  const auto size = static_cast<size_t>(PyBytes_GET_SIZE(encoded));
  if (std::strlen(PyBytes_AS_STRING(encoded)) == size) return true;
  PyErr_Format(PyExc_ValueError, "there is a null character in %R", object);
  return false;
}

// -------------------------------------------------------------------------------------- arrays

struct NumberType {
  int32_t type;
  int numpy;
};
static constexpr NumberType kNumberTypes[] = {{TETSTREAM_TYPE_FLOAT32, NPY_FLOAT32},
                                              {TETSTREAM_TYPE_FLOAT64, NPY_FLOAT64},
                                              {TETSTREAM_TYPE_INT32, NPY_INT32},
                                              {TETSTREAM_TYPE_INT64, NPY_INT64},
                                              {kBytes, NPY_UINT8}};

static int32_t typeOf(PyArrayObject* array) {
  for (const NumberType& t : kNumberTypes)
    if (PyArray_EquivTypenums(PyArray_TYPE(array), t.numpy)) return t.type;
  return 0;
}

static int numpyType(int32_t type) {
  for (const NumberType& t : kNumberTypes)
    if (t.type == type) return t.numpy;
  return NPY_NOTYPE;
}

// A dense array of one or two axes as it lies, or None. False with an exception set for another.
static bool viewOf(PyObject* object, ArrayView& view) {
  if (object == Py_None) return true;
  if (!PyArray_Check(object)) {
    PyErr_Format(PyExc_TypeError, "a numpy array is wanted, not %s", Py_TYPE(object)->tp_name);
    return false;
  }
  auto* const array = reinterpret_cast<PyArrayObject*>(object);
  const int axes = PyArray_NDIM(array);
  const int32_t type = typeOf(array);
  const bool is_dense = PyArray_ISCARRAY_RO(array);
  if (!is_dense || type == 0 || axes < 1 || axes > 2 ||
      (axes == 2 && PyArray_DIM(array, 1) > INT32_MAX)) {
    PyErr_SetString(PyExc_TypeError,
                    "a dense array [n] or [n][k] of float32, float64, int32, int64 or uint8 is "
                    "wanted");
    return false;
  }
  view.data = PyArray_DATA(array);
  view.type = type;
  view.rows = PyArray_DIM(array, 0);
  view.columns = axes == 2 ? static_cast<int32_t>(PyArray_DIM(array, 1)) : 1;
  return true;
}

// [rows], or [rows][columns] where there are several.
static int shapeOf(int64_t rows, int32_t columns, npy_intp shape[2]) {
  shape[0] = static_cast<npy_intp>(rows);
  shape[1] = columns;
  return columns == 1 ? 1 : 2;
}

// None where there is no array.
static PyObject* copyOf(const ArrayView& view) {
  if (!view.data) Py_RETURN_NONE;
  npy_intp shape[2];
  const int axes = shapeOf(view.rows, view.columns, shape);
  PyObject* const array = PyArray_SimpleNew(axes, shape, numpyType(view.type));
  if (array && view.rows > 0)
    std::memcpy(
        PyArray_DATA(reinterpret_cast<PyArrayObject*>(array)), view.data,
        static_cast<size_t>(view.rows) * static_cast<size_t>(view.columns) * sizeOfType(view.type));
  return array;
}

// An array that frees the memory when nobody needs it any more.
static PyObject* handOver(OwnedArray& owned) {
  npy_intp shape[2];
  const int axes = shapeOf(owned.rows(), owned.columns(), shape);
  const int type = numpyType(owned.type());
  void* const data = owned.release();
  PyObject* const owner = PyCapsule_New(
      data, nullptr, [](PyObject* capsule) { std::free(PyCapsule_GetPointer(capsule, nullptr)); });
  if (!owner) {
    std::free(data);
    return nullptr;
  }
  PyObject* const array = PyArray_SimpleNewFromData(axes, shape, type, data);
  if (!array) {
    Py_DECREF(owner);
    return nullptr;
  }
  // note: it takes `owner` also when it fails.
  if (PyArray_SetBaseObject(reinterpret_cast<PyArrayObject*>(array), owner) != 0) {
    Py_DECREF(array);
    return nullptr;
  }
  return array;
}

}  // namespace tetstream::swig
