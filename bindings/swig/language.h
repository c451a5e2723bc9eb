// swig: what a language brings, so that the rest knows none: its functions, its lock, its way to be
// interrupted. Declared here, defined in the language's folder.
#pragma once

namespace tetstream::swig {

// A function of the language, kept alive by this; empty if the language has its word for nothing.
// It is made, copied and destroyed under the language's lock.
class Function {
 public:
  Function() = default;
  explicit Function(void* object);
  Function(const Function& other);
  Function& operator=(const Function&) = delete;
  ~Function();

  explicit operator bool() const { return object_ != nullptr; }
  // Calls it with one argument: an object that the wrapper knows as `type`, "tetstream_progress *",
  // and that lives during the call. Takes the lock. What the function raises leaves as a C++
  // exception, which the language's wrapper turns into its own again.
  void operator()(const char* type, void* object) const;

 private:
  void* object_ = nullptr;
};

// While this lives, the language may run something else on another thread.
class Unlocked {
 public:
  Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked();

 private:
  void* state_;
};

// Throws, as a function does that raises, if the user has asked to stop. Takes the lock.
void checkInterrupt();

}  // namespace tetstream::swig
