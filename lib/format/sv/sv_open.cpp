#include "sv_open.h"

#include <cmath>

#include "status.h"
#include "sv_check.h"

namespace tetstream {

// How much of a pipe is looked at before it is spooled. A stream shows that it is one at its first
// finalization or its first vertex after a cell, which comes within its front.
static constexpr size_t kPipeProbeBytes = 1 << 20;
static constexpr size_t kScanBytes = 1 << 18;

SvForm findSvForm(SvBytes& bytes, SvScanner& scanner, const std::string& temp_dir) {
  SvForm form = scanner.feed(bytes.data(), bytes.size());
  size_t fed = bytes.size();
  while (form == SvForm::kUndecided && fed < kPipeProbeBytes) {
    if (!bytes.more()) return scanner.end();
    form = scanner.feed(bytes.data() + fed, bytes.size() - fed);
    fed = bytes.size();
  }
  if (form != SvForm::kUndecided) return form;
  bytes.makeSeekable(temp_dir);
  std::vector<unsigned char> part(kScanBytes);
  for (uint64_t place = bytes.offset() + fed; form == SvForm::kUndecided;) {
    const size_t got = bytes.readAt(place, part.data(), part.size());
    if (got == 0) return scanner.end();
    form = scanner.feed(part.data(), got);
    place += got;
  }
  return form;
}

template <class T>
static size_t firstNotFiniteOf(const T* values, size_t count) {
  for (size_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) return i;
  return count;
}

size_t firstNotFinite(const void* values, ScalarType type, size_t count) {
  return type == ScalarType::kFloat32 ? firstNotFiniteOf(static_cast<const float*>(values), count)
                                      : firstNotFiniteOf(static_cast<const double*>(values), count);
}

void checkSvPositions(const SvElements& elements, SvBlock& block) {
  const size_t count = block.rows.vertexCount();
  if (count == 0) return;
  const size_t bad =
      firstNotFinite(block.rows.position(0), elements.schema().position_type, 3 * count) / 3;
  if (bad == count) return;
  size_t element = 0;
  for (size_t row = 0;; ++element)
    if (block.kinds[element] == SvKind::kVertex && row++ == bad) break;
  fail(Status::kBadData, "%s: vertex %llu has a position that is not a finite number",
       elements.where(block.places[element]).c_str(),
       static_cast<unsigned long long>(block.rows.firstVertex() + bad));
}

static void checkCount(const SvElements& elements, const char* what, int64_t said, int64_t found) {
  if (said >= 0 && said != found)
    fail(Status::kBadData, "%s: %lld %s were read, the header says %lld",
         elements.whereEnd().c_str(), static_cast<long long>(found), what,
         static_cast<long long>(said));
}

void checkSvCounts(const SvElements& elements, int64_t vertex_count, int64_t cell_count) {
  const Schema& schema = elements.schema();
  checkCount(elements, "vertices", schema.vertex_count, vertex_count);
  checkCount(elements, "cells", schema.cell_count, cell_count);
  if (vertex_count == 0 && cell_count == 0 && schema.vertex_count != 0)
    fail(Status::kBadData, "%s: there is no vertex and no cell", elements.whereEnd().c_str());
}

namespace {

// Elements of a pre-order file are events already: only the references change.
class PreOrderStream final : public Source {
 public:
  explicit PreOrderStream(std::unique_ptr<SvElements> elements)
      : elements_(std::move(elements)), block_(elements_->schema()) {}

  const Schema& schema() const override { return elements_->schema(); }

  bool next(BatchView& batch) override {
    block_.clear(static_cast<uint64_t>(check_.introduced()));
    if (!elements_->read(block_)) {
      checkSvCounts(*elements_, check_.introduced(), cells_);
      return false;
    }
    checkSvPositions(*elements_, block_);
    resolve();
    batch = block_.rows.view();
    return true;
  }

 private:
  void resolve() {
    size_t cell = 0, finalized = 0;
    for (size_t i = 0; i < block_.kinds.size(); ++i) {
      bool good = true;
      switch (block_.kinds[i]) {
        case SvKind::kVertex:
          check_.introduce();
          break;
        case SvKind::kCell:
          good = check_.resolveCell(block_.rows.cell(cell), &block_.rows.lastUses(cell));
          ++cell;
          break;
        case SvKind::kFinalize: {
          int64_t& ref = block_.finalized[finalized++];
          good = check_.resolveFinalized(&ref);
          block_.rows.addFinalized(ref);
          break;
        }
      }
      if (!good)
        fail(Status::kBadData, "%s: %s", elements_->where(block_.places[i]).c_str(),
             check_.problem().c_str());
    }
    cells_ += static_cast<int64_t>(cell);
  }

  std::unique_ptr<SvElements> elements_;
  SvBlock block_;
  SvCheck check_;
  int64_t cells_ = 0;
};

}  // namespace

std::unique_ptr<Source> makeSvStream(SvForm form, std::unique_ptr<SvElements> elements) {
  if (form == SvForm::kPostOrder) return makeSvPostOrder(std::move(elements));
  return std::make_unique<PreOrderStream>(std::move(elements));
}

}  // namespace tetstream
