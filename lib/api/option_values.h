// api: the values of all options, by number or by name. Depends on options.def, run.h.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "run.h"

namespace tetstream {

constexpr int32_t kMostThreads = 1024;

struct OptionRow {
  int32_t id, type;  // TETSTREAM_OPTION_...
  const char *name, *text;
  double minimum, maximum;  // of numbers, for show and for doubles
  int64_t lowest, highest;  // of integers, exactly
  const char *default_text, *choices;
  int32_t scope;  // TETSTREAM_SCOPE_...
};

int32_t optionCount() noexcept;
const OptionRow& optionRow(int32_t index);  // throws kBadArgument outside

// All of these throw kBadArgument, naming the option, and then have changed nothing.
class OptionValues {
 public:
  OptionValues();  // the defaults

  void setInt64(int32_t id, int64_t value);
  void setDouble(int32_t id, double value);
  void setText(int32_t id, const char* value);
  void parse(const char* name, const char* value);
  void reset(const OptionRow& row);  // to its default
  int64_t getInt64(int32_t id) const;
  double getDouble(int32_t id) const;
  const char* getText(int32_t id) const;
  void addField(const char* name, double weight);
  void setWorkers(std::shared_ptr<Workers> workers) { workers_ = std::move(workers); }
  const std::shared_ptr<Workers>& workers() const { return workers_; }
  void setProgress(ProgressFunction progress) { progress_ = std::move(progress); }
  const ProgressFunction& progress() const { return progress_; }

  RunOptions runOptions() const;  // borrows the workers

 private:
  static constexpr int kCount = 0
#define OPTION_DOUBLE(...) +1
#define OPTION_INT64(...) +1
#define OPTION_TEXT(...) +1
#include "options.def"
#undef OPTION_DOUBLE
#undef OPTION_INT64
#undef OPTION_TEXT
      ;
  std::array<std::variant<int64_t, double, std::string>, kCount> values_;
  std::vector<std::pair<std::string, double>> fields_;
  std::shared_ptr<Workers> workers_;
  ProgressFunction progress_;
};

}  // namespace tetstream
