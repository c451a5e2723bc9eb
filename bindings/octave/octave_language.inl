// octave: what the shared part leaves to a language, and how Octave's arrays and errors cross. Part
// of the wrapper that SWIG generates.
#include <octave/oct.h>
#include <octave/parse.h>
#include <octave/quit.h>

#include <any>
#include <cctype>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>

#include "failure.h"
#include "handles.h"

namespace tetstream::swig {

// --------------------------------------------------------------------------------- functions

// note: Octave runs on one thread and has no lock.
Unlocked::Unlocked() : state_(nullptr) {}
Unlocked::~Unlocked() = default;

static octave_value* valueOf(void* object) {
  return static_cast<octave_value*>(object);
}

Function::Function(void* object) : object_(object ? new octave_value(*valueOf(object)) : nullptr) {}

Function::Function(const Function& other) : Function(other.object_) {}

Function::~Function() {
  delete valueOf(object_);
}

// Integers as doubles, in which people calculate; those that no double holds stay.
static octave_value figureOf(const octave_value& value) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (!value.isinteger()) return value;
  const octave_value number = value.as_double();
  return std::fabs(number.double_value()) < kExact ? number : value;
}

// A struct of figures as one of Octave's: every member that the interface knows.
static octave_value structOf(swig_type_info* type, void* object) {
  octave_scalar_map figures;
  const octave_value_list self(SWIG_NewPointerObj(object, type, 0));
  const auto* const known = static_cast<const swig_octave_class*>(type->clientdata);
  for (const swig_octave_member* member = known->members; member->name; ++member)
    if (member->get_method) figures.assign(member->name, figureOf(member->get_method(self, 1)(0)));
  return figures;
}

// What the function raises is an exception of C++ already.
void Function::operator()(const char* type, void* object) const {
  swig_type_info* const wrapped_as = SWIG_TypeQuery(type);
  const bool is_figures = std::strcmp(type, "tetstream_progress *") == 0;
  const octave_value argument =
      is_figures ? structOf(wrapped_as, object) : SWIG_NewPointerObj(object, wrapped_as, 0);
  octave::feval(*valueOf(object_), octave_value_list(argument), 0);
}

void checkInterrupt() {
  octave_quit();
}

// A function handle, a function's name, or [] for none.
static void* checkedFunction(octave_value& value) {
  if (value.isempty()) return nullptr;
  if (!value.is_function_handle() && !value.is_string() && !value.is_inline_function())
    error_with_id("tetstream:bad-argument", "a function handle or [] is wanted, not a %s",
                  value.class_name().c_str());
  return &value;
}

// ------------------------------------------------------------------------------------ errors

// "tetstream:bad-data" of TETSTREAM_BAD_DATA.
static std::string identifierOf(tetstream_status status) {
  constexpr size_t kPrefix = sizeof "TETSTREAM_" - 1;
  std::string name = std::string(tetstream_status_name(status)).substr(kPrefix);
  for (char& c : name)
    c = c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return "tetstream:" + name;
}

[[noreturn]] static void raise(tetstream_status status, const char* sentence) {
  error_with_id(identifierOf(status).c_str(), "%s", sentence);
}

// ------------------------------------------------------------------------------------ arrays

// An array of Octave's, k x n, which in memory is [n][k]. It lives as long as this.
class Array : public ArrayView {
 public:
  explicit Array(const octave_value& values) {
    if (values.is_double_type())
      hold(values.array_value(), TETSTREAM_TYPE_FLOAT64);
    else if (values.is_single_type())
      hold(values.float_array_value(), TETSTREAM_TYPE_FLOAT32);
    else if (values.is_int32_type())
      hold(values.int32_array_value(), TETSTREAM_TYPE_INT32);
    else if (values.is_int64_type())
      hold(values.int64_array_value(), TETSTREAM_TYPE_INT64);
    else if (values.is_uint8_type())
      hold(values.uint8_array_value(), kBytes);
    else if (values.islogical())
      hold(uint8NDArray(values.bool_array_value()), kBytes);
    else
      failArgument("an array is " + values.class_name() +
                   ": double, single, int32, int64, uint8 or logical is wanted");
  }

 private:
  template <class A>
  void hold(A array, int32_t the_type) {
    if (array.ndims() > 2) failArgument("an array has more than two dimensions");
    data = array.data();
    type = the_type;
    rows = array.columns();
    columns = static_cast<int32_t>(array.rows());
    array_ = std::move(array);  // whose elements stay where they are
  }
  std::any array_;
};

template <class A>
static octave_value filledArray(const void* data, const dim_vector& shape) {
  A array(shape);
  std::memcpy(static_cast<void*>(array.fortran_vec()), data,
              static_cast<size_t>(array.numel()) * sizeof(typename A::element_type));
  return array;
}

// k x n; [] where there is no array.
static octave_value copyOf(const ArrayView& view) {
  if (!view.data) return Matrix();
  const dim_vector shape(view.columns, view.rows);
  switch (view.type) {
    case TETSTREAM_TYPE_FLOAT32:
      return filledArray<FloatNDArray>(view.data, shape);
    case TETSTREAM_TYPE_FLOAT64:
      return filledArray<NDArray>(view.data, shape);
    case TETSTREAM_TYPE_INT32:
      return filledArray<int32NDArray>(view.data, shape);
    case TETSTREAM_TYPE_INT64:
      return filledArray<int64NDArray>(view.data, shape);
    default:
      return filledArray<uint8NDArray>(view.data, shape);
  }
}

// note: Octave's arrays allocate by themselves; the library's is freed as soon as it is copied.
static octave_value handOver(OwnedArray& owned) {
  const ArrayView view = {owned.data() ? owned.data() : "", owned.type(), owned.rows(),
                          owned.columns()};
  octave_value array = copyOf(view);
  std::free(owned.release());
  return array;
}

}  // namespace tetstream::swig
