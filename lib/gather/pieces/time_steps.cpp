#include "time_steps.h"

#include <charconv>
#include <cmath>

#include "status.h"

namespace tetstream {

int64_t parseStep(const std::string& text) {
  if (text == "last") return kLastStep;
  if (text == "first") return 0;
  int64_t step = 0;
  const std::from_chars_result r = std::from_chars(text.data(), text.data() + text.size(), step);
  if (r.ec != std::errc() || r.ptr != text.data() + text.size() || step < 0)
    fail(Status::kBadArgument,
         "option \"step\": \"%s\" is neither first nor last nor a number from 0", text.c_str());
  return step;
}

void takeTime(MeshPieces& mesh, std::optional<double> time) {
  if (mesh.time || !time) return;
  if (std::isfinite(*time))
    mesh.time = time;
  else
    mesh.addNote("the time is left out: it is not finite");
}

std::optional<double> readTime(MeshPieces& mesh,
                               const std::function<std::optional<double>()>& read) {
  try {
    return read();
  } catch (const Error& error) {
    if (error.status() != Status::kBadData && error.status() != Status::kUnsupported) throw;
    mesh.addNote("the time is left out: " + error.text());
    return {};
  }
}

double timeIn(Values& times, uint64_t step) {
  double time = 0;
  times.read(step, 1, &time, ScalarType::kFloat64);
  return time;
}

uint64_t chooseStep(MeshPieces& mesh, uint64_t count, const ReadOptions& options,
                    const StepTimes& time) {
  mesh.has_steps = true;
  const uint64_t step = options.step == kLastStep ? count - 1 : static_cast<uint64_t>(options.step);
  if (step >= count)
    fail(count == 1 ? Status::kUnsupported : Status::kBadArgument,
         "%s: there is no time step %llu (option step, --step): there are 0 "
         "to %llu",
         mesh.name.c_str(), static_cast<unsigned long long>(step),
         static_cast<unsigned long long>(count - 1));
  if (count == 1) {
    if (time) takeTime(mesh, readTime(mesh, [&] { return time(step); }));
    return step;
  }
  const std::optional<double> told = time ? time(step) : std::nullopt;
  takeTime(mesh, told);
  std::string text = textOf(
      "of %llu time steps, 0 to %llu, step %llu is read", static_cast<unsigned long long>(count),
      static_cast<unsigned long long>(count - 1), static_cast<unsigned long long>(step));
  if (told && std::isfinite(*told)) text += textOf(", at time %.9g", *told);
  mesh.addNote(text);
  return step;
}

}  // namespace tetstream
