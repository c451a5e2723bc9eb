// simplify/select: what a thread works on patches with, one after the other. Depends on
// patch_sweep.h, reshape.h.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "patch_sweep.h"
#include "reshape.h"

namespace tetstream {

template <class S>
class Lane {
 public:
  Lane(Core<S>& core, Account& account)
      : core_(core), account_(account), room_(account), sweep_(std::in_place, core, account) {}

  // For a window: as PatchSweep::begin.
  void begin(const Goal& goal, double unit);

  PatchSweep<S>& sweep() { return *sweep_; }
  Reshaper<S>& reshaper() { return *reshaper_; }  // where cells are flipped

  // What list(room) lists into an array that grows if need be.
  template <class List>
  const uint32_t* listed(List list) {
    return withoutPatch([&] { return list(room_); });
  }

  // What work() returns, which may be done twice: if the budget refuses it with the arrays of the
  // last patch, it is done without them.
  template <class Work>
  auto withoutPatch(Work work) {
    try {
      return work();
    } catch (const Error& error) {
      if (!isRefusal(error)) throw;
    }
    startAnew(sweep().state());
    return work();
  }

  // Calls work() with a patch loaded, or with one of each half where it is too large: for a patch,
  // or, which may show on the way, for the memory budget. `is_loaded`: it is in the sweep already.
  template <class Work>
  void onPatch(const uint32_t* owned, size_t owned_count, const uint32_t* cells, size_t cell_count,
               bool is_loaded, Work work) {
    const typename PatchSweep<S>::State before = sweep().state();
    try {
      if (is_loaded || sweep().load(owned, owned_count, cells, cell_count)) {
        work();
        return;
      }
    } catch (const Error& error) {
      if (!isRefusal(error) || owned_count < kLeastHalved || !canForget(before.tally)) throw;
      startAnew(before);
      ++refusals_;
    }
    if (owned_count == 1) return;  // a star of that size is left alone
    const size_t half = owned_count / 2;
    for (const auto& [first, count] :
         {std::pair(owned, half), std::pair(owned + half, owned_count - half)}) {
      const std::vector<uint32_t> of_half = touching(first, count, cells, cell_count);
      onPatch(first, count, of_half.data(), of_half.size(), false, work);
    }
  }

  // How often the budget has refused a patch since it was last asked for.
  int takeRefusals() { return std::exchange(refusals_, 0); }

 private:
  static constexpr size_t kLeastHalved = 32;  // vertices: less would be no help

  bool isRefusal(const Error& error) const {
    return error.status() == Status::kNoMemory && account_.refused();
  }
  bool canForget(const Tally& before) const;
  void startAnew(const typename PatchSweep<S>::State& state);
  std::vector<uint32_t> touching(const uint32_t* owned, size_t owned_count, const uint32_t* cells,
                                 size_t cell_count) const;

  Core<S>& core_;
  Account& account_;
  Array<uint32_t> room_;
  std::optional<PatchSweep<S>> sweep_;
  std::optional<Reshaper<S>> reshaper_;
  int refusals_ = 0;
};

}  // namespace tetstream
