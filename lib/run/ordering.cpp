#include "ordering.h"

#include <cmath>

#include "spooled_mesh.h"
#include "status.h"

namespace tetstream {

// Ordering takes about this share of the time of a whole run on an indexed mesh.
constexpr double kOrderShare = 0.2;
// A sweep through a ball of n vertices has a front of about n^(2/3); one this many times as wide is
// worth another order. Small streams never are.
constexpr double kTooWide = 6;
constexpr int64_t kSmall = 20000;  // vertices

static bool isTooWide(const Schema& schema) {
  if (schema.front_width < 0 || schema.vertex_count < kSmall) return false;
  const double narrow = std::pow(static_cast<double>(schema.vertex_count), 2.0 / 3);
  return static_cast<double>(schema.front_width) > kTooWide * narrow;
}

std::string Ordering::wordsForNone(const Schema& schema) {
  const std::string kept = "none: the stream is as it was, with a front ";
  if (schema.front_width < 0) return kept + "that is not known";
  return kept + textOf("of %lld vertices", static_cast<long long>(schema.front_width));
}

// Null where the stream stays as it is.
IndexedSource* Ordering::indexedOf(Input& input, const RunOptions& options, const Tell& tell) {
  if (input.indexed) return input.indexed.get();
  const Order order = orderOf(options.order);
  const bool is_kept =
      options.automatic == RunOptions::Auto::kKeeps || !isTooWide(input.stream->schema());
  const bool is_fine = order == Order::kNone || (order == Order::kAuto && is_kept);
  if (is_fine) return nullptr;
  auto spooled = spoolStream(*input.stream, options.temp_dir, tell);
  spooled_bytes_ = spooled->diskBytes();
  spooled_ = std::move(spooled);
  return spooled_.get();
}

Ordering::Ordering(Input& input, const RunOptions& options, const ProgressFunction& progress,
                   std::vector<bool> measured) {
  Progress p;
  p.cells_total = input.schema().cell_count;
  p.phase = "order";
  const auto part = [&](double begin, double end) -> Tell {
    if (!progress) return [](double) {};
    return [&p, &progress, begin, end](double share) {
      p.fraction = kOrderShare * (begin + share * (end - begin));
      progress(p);
    };
  };
  OrderOptions order;
  order.order = options.order;
  order.axis = options.axis;
  order.narrowest = options.automatic == RunOptions::Auto::kNarrows;
  order.temp_dir = options.temp_dir;
  order.origins = options.origins;
  order.measured = std::move(measured);
  order.memory_bytes = static_cast<size_t>(options.simplify.memory_bytes);
  p.temporary_bytes = static_cast<int64_t>(plannedDisk(input.schema(), order));
  const double spooling = input.indexed ? 0 : 0.3;
  IndexedSource* indexed = indexedOf(input, options, part(0, spooling));
  if (!indexed) {
    source_ = input.stream.get();
    stays_with_caller_ = input.stays_with_caller;
    waiting_ = input.waiting;
    chosen_ = wordsForNone(input.stream->schema());
    return;
  }
  order.tell = part(spooling, 1);
  ordered_ = std::make_unique<OrderedSource>(*indexed, order);
  source_ = ordered_.get();
  chosen_ = ordered_->chosen();
  if (orderOf(options.order) == Order::kAuto && !order.narrowest)
    chosen_ += ": there the fewest cells are cut";
}

double Ordering::share() const {
  return ordered_ ? kOrderShare : 0;
}

uint64_t Ordering::diskBytes() const {
  return spooled_bytes_ + (ordered_ ? ordered_->diskBytes() : 0);
}

}  // namespace tetstream
