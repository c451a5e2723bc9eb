#include "xdmf_subset.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "cell_kinds.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr SpoolShape kSpool = {4, 8 << 10};  // there may be one for each of many grids

using Corners = std::array<int64_t, kMostCorners>;  // ascending, behind a -1 for each that it lacks

class CellWalk {
 public:
  explicit CellWalk(const XdmfCellList& list)
      : list_(list),
        values_(list.cells > 0 ? list.nodes->open(list.cells * list.nodes_each) : nullptr),
        held_(kCellsAtOnce * static_cast<size_t>(list.nodes_each)) {}

  bool next() {
    if (at_ == list_.cells) return false;
    const size_t place = static_cast<size_t>(at_ % kCellsAtOnce);
    if (place == 0) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kCellsAtOnce, list_.cells - at_));
      values_->read(at_ * list_.nodes_each, n * static_cast<size_t>(list_.nodes_each), held_.data(),
                    ScalarType::kInt64);
    }
    const int64_t* from = held_.data() + place * static_cast<size_t>(list_.nodes_each);
    checkCorners(list_, at_, from);
    corners_.fill(-1);
    std::copy_n(from, list_.corners, corners_.begin());
    std::sort(corners_.begin(), corners_.end());
    ++at_;
    return true;
  }

  uint64_t cell() const { return at_ - 1; }
  const Corners& corners() const { return corners_; }

 private:
  const XdmfCellList& list_;
  std::unique_ptr<Values> values_;
  std::vector<int64_t> held_;
  uint64_t at_ = 0;
  Corners corners_;
};

// What the rows of the part hold lies together, too: it is read behind where it belongs, at the end
// of what is asked for, and goes forward from there.
class SpreadValues final : public Values {
 public:
  SpreadValues(std::shared_ptr<XdmfSubset> subset, std::unique_ptr<Values> values,
               uint64_t components)
      : subset_(std::move(subset)), values_(std::move(values)), components_(components) {}

  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    const size_t bytes = sizeOf(type);
    auto* to = static_cast<unsigned char*>(out);
    const uint64_t from = namedBefore(first);
    const auto named = static_cast<size_t>(namedBefore(first + count) - from);
    const unsigned char* source = to + (count - named) * bytes;
    if (named > 0) values_->read(from, named, to + (count - named) * bytes, type);
    hint_ = subset_->runBehind(first / components_, hint_);
    for (uint64_t at = first, end = first + count; at < end;) {
      const XdmfSubset::Run run = subset_->run(hint_);
      const uint64_t begin = std::clamp(run.cell * components_, at, end);
      if (run.count == 0) {
        std::memset(to, 0, static_cast<size_t>(end - at) * bytes);
        return;
      }
      std::memset(to, 0, static_cast<size_t>(begin - at) * bytes);
      to += static_cast<size_t>(begin - at) * bytes;
      const uint64_t stop = std::min(run.end() * components_, end);
      const auto taken = static_cast<size_t>(stop - begin) * bytes;
      std::memmove(to, source, taken);
      to += taken;
      source += taken;
      at = stop;
      if (at < end) ++hint_;
    }
  }

 private:
  // Values of the part.
  uint64_t namedBefore(uint64_t index) {
    const uint64_t cell = index / components_;
    const XdmfSubset::Run run = subset_->run(subset_->runBehind(cell, hint_));
    if (run.count == 0) return subset_->named() * components_;
    const uint64_t begin = run.cell * components_;
    return run.row * components_ + (index > begin ? index - begin : 0);
  }

  std::shared_ptr<XdmfSubset> subset_;
  std::unique_ptr<Values> values_;
  uint64_t components_, hint_ = 0;
};

}  // namespace

void checkCorners(const XdmfCellList& list, uint64_t cell, const int64_t* nodes) {
  for (size_t k = 0; k < list.corners; ++k)
    if (static_cast<uint64_t>(nodes[k]) >= list.points)
      fail(Status::kBadData, "%s: cell %llu uses point %lld, there are %llu", list.place.c_str(),
           static_cast<unsigned long long>(cell), static_cast<long long>(nodes[k]),
           static_cast<unsigned long long>(list.points));
}

XdmfSubset::XdmfSubset(const std::string& temp_dir) : runs_(sizeof(Run), temp_dir, kSpool) {}

std::optional<uint64_t> XdmfSubset::find(const XdmfCellList& part, const XdmfCellList& mesh) {
  CellWalk rows(part), cells(mesh);
  while (rows.next()) {
    do {
      if (!cells.next()) return rows.cell();
    } while (cells.corners() != rows.corners());
    add(cells.cell());
  }
  if (last_.count > 0) runs_.append(&last_, 1);
  runs_.finish();
  return {};
}

void XdmfSubset::add(uint64_t cell) {
  if (last_.count > 0 && last_.end() != cell) {
    runs_.append(&last_, 1);
    last_ = {};
  }
  if (last_.count == 0) last_ = {cell, named_, 0};
  ++last_.count;
  ++named_;
}

XdmfSubset::Run XdmfSubset::run(uint64_t index) {
  Run run;
  if (index < runs_.rows()) std::memcpy(&run, runs_.row(index), sizeof run);
  return run;
}

uint64_t XdmfSubset::runBehind(uint64_t cell, uint64_t hint) {
  uint64_t low = 0, high = runs_.rows();
  const auto look = [&](uint64_t at) {
    if (at < low || at >= high) return;
    const bool is_behind = run(at).end() > cell;
    (is_behind ? high : low) = is_behind ? at : at + 1;
  };
  for (const uint64_t at : {hint - 1, hint, hint + 1}) look(at);  // note: 0 - 1 is behind all
  while (low < high) look(low + (high - low) / 2);
  return low;
}

MeshArray XdmfSubset::spread(const std::shared_ptr<XdmfSubset>& subset, MeshArray values) {
  const auto components = static_cast<uint64_t>(values.components);
  const uint64_t held = subset->named() * components;
  values.open = [subset, open = values.open, held, components](uint64_t) {
    return std::make_unique<SpreadValues>(subset, open(held), components);
  };
  return values;
}

}  // namespace tetstream
