#include "pilot_run.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "simplifier.h"
#include "status.h"
#include "tasks.h"

namespace tetstream {

// What simplifies all takes this share of the time of the run that it serves.
constexpr double kPilotShare = 0.5;
constexpr int64_t kPilotCells = 1 << 18;
// Larger meshes are sampled, which takes this share.
constexpr double kSampleShare = 0.1;

namespace {

class Nowhere final : public Sink {
 public:
  void begin(const Schema&) override {}
  void put(const BatchView&) override {}
  void finish() override {}
};

}  // namespace

std::optional<Pilot> PilotRun::run() {
  const SimplifyOptions& o = options_.simplify;
  const Schema& schema = stream_.source().schema();
  const int64_t cells = schema.cell_count, window = Simplifier::windowCells(schema, o);
  if (followsPaper(o.mode) || o.pilot != PilotUse::kAuto || cells <= window) return {};
  if (o.memory_bytes == 0 && cells <= kPilotCells) return simplifyAll();
  if (Sampler::serves(schema, o) && Sampler::pays(schema, o)) return sample();
  return {};
}

std::optional<Pilot> PilotRun::simplifyAll() {
  const std::unique_ptr<Source> again = stream_.source().again(Part::kAll);
  if (!again) return {};
  const auto before = readAhead(*again, stream_, options_, tasks_);
  Source& source = before ? *before : *again;
  SimplifyOptions whole = options_.simplify;
  whole.window_cells = source.schema().cell_count;
  whole.eases_in = false;
  Nowhere nowhere;
  Simplifier pilot(whole, nowhere, [this](Progress p) {
    p.phase = "pilot";
    p.cells_written = 0;
    if (p.fraction >= 0) p.fraction *= kPilotShare;
    tell_(p);
  });
  copyStream(source, pilot);
  share_ = kPilotShare;
  return pilot.pilot();
}

// Of a long stream, which is read twice for it. What is wrong with it is told as it is found from
// end to end.
std::optional<Pilot> PilotRun::sample() {
  if (overlaps(options_, tasks_) && !stream_.staysWithCaller()) {
    try {
      return sampleBy(tasks_.threads());
    } catch (const Error& error) {
      const Status status = error.status();
      if (status != Status::kBadData && status != Status::kIo && status != Status::kNoMemory) throw;
    }
  }
  return sampleBy(1);
}

std::optional<Pilot> PilotRun::sampleBy(size_t threads) {
  Sampler sampler(stream_.source().schema(), options_.simplify);
  const size_t most = std::min(threads, sampler.mostStretches());
  std::vector<Stretch> stretches = stretchesOf(Part::kPositions, most, 0);
  if (stretches.empty()) return {};
  sampler.countInStretches(stretches.size());
  const auto vertices = static_cast<double>(stream_.source().schema().vertex_count);
  read(stretches, 0, [&](const BatchView& batch, size_t stretch) {
    sampler.count(batch, stretch);
    return static_cast<double>(batch.vertex_count) / vertices;
  });
  stretches = stretchesOf(Part::kAll, most, sampler.reach());
  if (stretches.empty()) return {};
  std::vector<Stretch::Begin> begins;
  begins.reserve(stretches.size());
  for (const Stretch& stretch : stretches) begins.push_back(stretch.begin);
  sampler.takeBricks(begins);
  const auto cells = static_cast<double>(stream_.source().schema().cell_count);
  read(stretches, kSampleShare / 2, [&](const BatchView& batch, size_t stretch) {
    sampler.put(batch, stretch);
    return static_cast<double>(batch.cell_count) / cells;
  });
  share_ = kSampleShare;
  try {
    return sampler.simplify();
  } catch (const Error& error) {  // the run itself will say where, and what would do
    if (error.status() != Status::kBadData && error.status() != Status::kNoMemory) throw;
  }
  return {};
}

// For that many threads, or one of all; none where the stream can be read but once.
std::vector<Stretch> PilotRun::stretchesOf(Part part, size_t most, uint64_t before) {
  Source& source = stream_.source();
  std::vector<Stretch> stretches;
  if (most > 1) stretches = source.againInStretches(part, most, before);
  if (!stretches.empty()) return stretches;
  if (std::unique_ptr<Source> all = source.again(part)) stretches.push_back({std::move(all), {}});
  return stretches;
}

// use(batch, stretch) returns how much of the stream has been read with it, of 1.
template <class Use>
void PilotRun::read(std::vector<Stretch>& stretches, double share_before, Use use) {
  const size_t count = stretches.size();
  const auto before =
      count == 1 ? readAhead(*stretches[0].source, stream_, options_, tasks_) : nullptr;
  std::atomic<size_t> end = count;  // of no use is what comes after a part that failed
  const std::thread::id caller = std::this_thread::get_id();
  tasks_.forParts(count, [&](size_t k) {
    Source& source = before ? *before : *stretches[k].source;
    BatchView batch;
    double part = 0;
    try {
      while (k < end && source.next(batch)) {
        part += static_cast<double>(count) * use(batch, k);
        if (std::this_thread::get_id() != caller) continue;
        tellSampling(share_before, std::min(part, 1.0), source.schema().cell_count);
      }
    } catch (...) {
      for (size_t known = end; k < known && !end.compare_exchange_weak(known, k);) {
      }
      throw;
    }
  });
}

void PilotRun::tellSampling(double share_before, double part, int64_t cells) {
  Progress p;
  p.phase = "pilot";
  p.cells_total = cells;
  p.cells_read = static_cast<int64_t>(part * static_cast<double>(cells));
  // Never back: the caller's thread may read several parts, and all once more.
  p.fraction = told_ = std::max(told_, share_before + kSampleShare / 2 * part);
  tell_(p);
}

}  // namespace tetstream
