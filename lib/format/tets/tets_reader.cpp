// format/tets: reads `.tets`. Depends on tets_input.h, tets_codec.h, tets_places.h.
//
// A chunk is read whole and checked, then handed out in batches whose arrays point into it; only
// 32-bit ids are widened, a batch at a time. What sizes a chunk may have is known before it is
// read.
#include <algorithm>
#include <limits>

#include "status.h"
#include "tets_codec.h"
#include "tets_format.h"
#include "tets_input.h"
#include "tets_places.h"
#include "tets_recovery.h"
#include "tets_stretches.h"

namespace tetstream {
namespace tets {
namespace {

using ull = unsigned long long;

class Reader final : public Source {
 public:
  // With `losses`, what is damaged is gone past and told there; cells may then name vertices that
  // did not come.
  explicit Reader(std::unique_ptr<ByteSource> bytes, Losses* losses = nullptr);
  // A part of a seekable file: what stands between its chunks is not looked at.
  Reader(std::unique_ptr<ByteSource> bytes, const ChunkRange& range);
  const Schema& schema() const override { return schema_; }
  bool next(BatchView& batch) override;
  std::unique_ptr<Source> again(Part part) override {
    if (!in_.bytes().seekable() || losses_) return nullptr;
    if (part == Part::kPositions) return openPlaces(readAgain(in_.bytes()));
    return std::make_unique<Reader>(readAgain(in_.bytes()));
  }
  std::vector<Stretch> againInStretches(Part part, size_t most, uint64_t before) override;

 private:
  bool nextChunk();
  bool nextWholeChunk();
  void readChunk();
  void goPastLostRows(uint64_t first_cell);
  void checkPlace() const;
  void unpack(uint32_t codec, const unsigned char* stored);
  void checkChunkColumns();
  void checkRange(size_t column, const char* what) const;
  void checkOrder(size_t column, const char* what) const;
  void checkIndex();
  void checkTotals();
  void readEnd();
  void skipUnknown();

  size_t endOfBatch() const;
  uint64_t takeCells(size_t end, BatchView& batch);
  void takeMarks(size_t end, uint64_t* vertices, BatchView& batch);
  void takeVertices(uint64_t end, BatchView& batch);
  [[noreturn]] void failAtCell(size_t cell, int64_t vertex) const;
  template <class T>
  const T* column(size_t i) const {
    return reinterpret_cast<const T*>(payload_ + shape_->columns()[i].offset);
  }
  const void* row(size_t i, size_t r) const {
    return column<unsigned char>(i) + r * (*shape_)[i].bytesPerRow();
  }

  SectionReader in_;
  Losses* losses_;
  Schema schema_;
  std::unique_ptr<ChunkShape> shape_;
  Codec codec_;

  // The chunk in hand.
  ChunkOwn counts_ = {};
  uint32_t flags_ = 0;
  const unsigned char* payload_ = nullptr;
  Account account_;
  Array<unsigned char> unpacked_;
  std::vector<int64_t> wide_;
  size_t vertex_ = 0, cell_ = 0, finalized_ = 0, face_ = 0;  // handed out
  std::vector<const void*> field_rows_, cell_rows_;

  // The file so far.
  bool in_chunk_ = false, ended_ = false, have_totals_ = false;
  Totals seen_ = {};
  std::unique_ptr<Box> box_, chunk_box_;
  std::vector<IndexEntry> not_indexed_;
  uint64_t last_index_ = 0, totals_at_ = 0;

  bool is_part_ = false;
  uint64_t end_chunk_ = 0;  // of a part
};

// ------------------------------------------------------------------------------- the sections

Reader::Reader(std::unique_ptr<ByteSource> bytes, Losses* losses)
    : in_(std::move(bytes)), losses_(losses), unpacked_(account_) {
  schema_ = readHeader(in_);
  if (in_.bytes().seekable() && !losses_) completeFromEnd(in_.bytes(), schema_);
  shape_ = std::make_unique<ChunkShape>(schema_);
  box_ = std::make_unique<Box>(schema_.boxSize());
  chunk_box_ = std::make_unique<Box>(schema_.boxSize());
  field_rows_.resize(schema_.fields.size());
  cell_rows_.resize(schema_.cell_data.size());
}

Reader::Reader(std::unique_ptr<ByteSource> bytes, const ChunkRange& range)
    : Reader(std::move(bytes)) {
  in_.goTo(range.offset, range.first);
  seen_.vertices = static_cast<int64_t>(range.vertices);
  seen_.cells = static_cast<int64_t>(range.cells);
  is_part_ = true;
  end_chunk_ = range.end;
}

std::vector<Stretch> Reader::againInStretches(Part part, size_t most, uint64_t before) {
  if (!in_.bytes().seekable() || losses_) return {};
  const bool all = part == Part::kAll;
  std::vector<Stretch> stretches;
  for (const ChunkRange& range : cutChunks(tets::readIndex(in_.bytes()), most, all ? before : 0)) {
    std::unique_ptr<ByteSource> bytes = readAgain(in_.bytes());
    std::unique_ptr<Source> source;
    if (all)
      source = std::make_unique<Reader>(std::move(bytes), range);
    else
      source = openPlaces(std::move(bytes), &range);
    stretches.push_back({std::move(source), {range.own_vertex, range.own_cell, range.cells}});
  }
  return stretches;
}

// Reads on to the next chunk; false at the end.
bool Reader::nextChunk() {
  while (!ended_) {
    if (is_part_ && in_.chunks() == end_chunk_) return false;
    const SectionHead& head = in_.next();
    if (head.is(kChunk)) {
      readChunk();
      return true;
    }
    if ((losses_ || is_part_) && (head.is(kIndex) || head.is(kTotals)))
      in_.skipBody();  // they repeat what the chunks tell
    else if (losses_ && head.is(kEnd))
      ended_ = losses_->complete = true;
    else if (head.is(kIndex))
      checkIndex();
    else if (head.is(kTotals))
      checkTotals();
    else if (head.is(kEnd))
      readEnd();
    else
      skipUnknown();
  }
  return false;
}

// As nextChunk, past what is damaged.
bool Reader::nextWholeChunk() {
  for (;;) {
    const Totals before = seen_;
    try {
      return nextChunk();
    } catch (const Error& error) {
      if (!losses_ || error.status() != Status::kBadData) throw;
      losses_->add(error.text());
      seen_ = before;
    }
    if (!in_.resume()) return false;
  }
}

void Reader::skipUnknown() {
  const SectionHead& head = in_.head();
  if (head.is(kHeader)) fail(Status::kBadData, "%s: a second header", in_.place().c_str());
  if (head.flags & kMustUnderstand)
    fail(Status::kUnsupported, "%s: it is of a kind that this library does not know and must know",
         in_.place().c_str());
  in_.skipBody();
}

// What the head tells of the chunk's place in the file.
void Reader::checkPlace() const {
  if (!losses_ && counts_.first_vertex != static_cast<uint64_t>(seen_.vertices))
    fail(Status::kBadData, "%s: it begins with vertex %llu, but %lld vertices stand before",
         in_.place().c_str(), ull{counts_.first_vertex}, static_cast<long long>(seen_.vertices));
  if (have_totals_) fail(Status::kBadData, "%s: it follows the totals", in_.place().c_str());
}

void Reader::unpack(uint32_t codec, const unsigned char* stored) {
  payload_ = stored;
  if (codec == kCodecNone) return;
  unpacked_.makeRoomFor(shape_->payloadBytes());
  if (!codec_.decompress(*shape_, stored, in_.head().value, unpacked_.data()))
    fail(Status::kBadData, "%s: its columns cannot be decompressed", in_.place().c_str());
  payload_ = unpacked_.data();
}

void Reader::readChunk() {
  const SectionHead& head = in_.head();
  const uint32_t codec = setShape(in_, schema_, *shape_);
  counts_ = head.get<ChunkOwn>();
  flags_ = head.flags;
  checkPlace();
  const unsigned char* body = in_.body();
  ChunkStart start;
  std::memcpy(&start, body, sizeof start);
  if (losses_)
    goPastLostRows(start.first_cell);
  else if (start.first_cell != static_cast<uint64_t>(seen_.cells))
    fail(Status::kBadData, "%s: it begins with cell %llu, but %lld cells stand before",
         in_.place().c_str(), ull{start.first_cell}, static_cast<long long>(seen_.cells));
  const size_t box_bytes = schema_.boxSize() * sizeof(double);
  std::memcpy(chunk_box_->min.data(), body + sizeof start, box_bytes);
  std::memcpy(chunk_box_->max.data(), body + sizeof start + box_bytes, box_bytes);
  box_->add(*chunk_box_);
  unpack(codec, body + chunkStartBytes(schema_));

  IndexEntry entry = {in_.at(),
                      head.length,
                      counts_.first_vertex,
                      start.first_cell,
                      counts_.vertices,
                      counts_.cells,
                      counts_.finalized,
                      counts_.faces,
                      {},
                      {}};
  std::memcpy(entry.box_min, chunk_box_->min.data(), sizeof entry.box_min);
  std::memcpy(entry.box_max, chunk_box_->max.data(), sizeof entry.box_max);
  if (!losses_ && !is_part_) {
    if (not_indexed_.size() == kIndexEntries)
      fail(Status::kBadData, "%s: the index of the %u chunks before is missing",
           in_.place().c_str(), kIndexEntries);
    not_indexed_.push_back(entry);
  }
  seen_.vertices += counts_.vertices;
  seen_.cells += counts_.cells;
  seen_.finalized += counts_.finalized;
  seen_.faces += counts_.faces;
  ++seen_.chunks;
  checkChunkColumns();
  vertex_ = cell_ = finalized_ = face_ = 0;
  in_chunk_ = true;
}

// Chunks tell which vertices and cells stand before them: what is missing is so many.
void Reader::goPastLostRows(uint64_t first_cell) {
  const uint64_t vertex = counts_.first_vertex, most = uint64_t{1} << 62;
  if (vertex < static_cast<uint64_t>(seen_.vertices) || vertex > most ||
      first_cell < static_cast<uint64_t>(seen_.cells) || first_cell > most)
    fail(Status::kBadData,
         "%s: it begins with vertex %llu and cell %llu, %lld and %lld came before",
         in_.place().c_str(), ull{vertex}, ull{first_cell}, static_cast<long long>(seen_.vertices),
         static_cast<long long>(seen_.cells));
  losses_->cells += first_cell - static_cast<uint64_t>(seen_.cells);
  seen_.vertices = static_cast<int64_t>(vertex);
  seen_.cells = static_cast<int64_t>(first_cell);
}

void Reader::checkRange(size_t i, const char* what) const {
  const ColumnPlace& c = (*shape_)[i];
  const int64_t* ids = column<int64_t>(i);
  for (size_t n = 0; n < c.rows * c.components; ++n)
    if (static_cast<uint64_t>(ids[n]) >= static_cast<uint64_t>(seen_.vertices))
      fail(Status::kBadData, "%s: %s %zu names vertex %lld, but only %lld have come",
           in_.place().c_str(), what, n / c.components, static_cast<long long>(ids[n]),
           static_cast<long long>(seen_.vertices));
}

void Reader::checkOrder(size_t i, const char* what) const {
  const uint32_t* after = column<uint32_t>(i);
  uint32_t last = 0;
  for (size_t n = 0; n < (*shape_)[i].rows; ++n) {
    if (after[n] < last || after[n] > counts_.cells)
      fail(Status::kBadData, "%s: %s %zu stands after %u of its %u cells, the one before after %u",
           in_.place().c_str(), what, n, after[n], counts_.cells, last);
    last = after[n];
  }
}

void Reader::checkChunkColumns() {
  checkRange(shape_->finalized(), "finalization");
  checkOrder(shape_->finalizedAfter(), "finalization");
  checkRange(shape_->faces(), "face");
  checkOrder(shape_->facesAfter(), "face");
  const uint8_t* uses = column<uint8_t>(shape_->lastUses());
  for (size_t n = 0; n < (*shape_)[shape_->lastUses()].rows; ++n)
    if (uses[n] > 15)
      fail(Status::kBadData, "%s: cell %zu has last uses 0x%02x, there are four bits",
           in_.place().c_str(), n, uses[n]);
}

void Reader::checkIndex() {
  const SectionHead& head = in_.head();
  const IndexOwn own = head.get<IndexOwn>();
  if (head.value != not_indexed_.size() || own.entry_bytes < sizeof(IndexEntry) ||
      own.entry_bytes > kMaxEntryBytes || !bodyHolds(head, not_indexed_.size() * own.entry_bytes) ||
      own.previous != last_index_ ||
      own.first_chunk != static_cast<uint64_t>(seen_.chunks) - not_indexed_.size())
    fail(Status::kBadData, "%s: the index does not fit the %zu chunks before it",
         in_.place().c_str(), not_indexed_.size());
  const unsigned char* body = in_.body();
  for (size_t i = 0; i < not_indexed_.size(); ++i)
    if (std::memcmp(body + i * own.entry_bytes, &not_indexed_[i], sizeof(IndexEntry)) != 0)
      fail(Status::kBadData, "%s: the index describes another chunk %llu", in_.place().c_str(),
           ull{own.first_chunk} + i);
  not_indexed_.clear();
  last_index_ = in_.at();
}

void Reader::checkTotals() {
  const auto differ = [this](const char* what, int64_t claimed, int64_t real) {
    if (claimed >= 0 && claimed != real)
      fail(Status::kBadData, "%s: %lld %s are claimed, %lld have come", in_.place().c_str(),
           static_cast<long long>(claimed), what, static_cast<long long>(real));
  };
  if (have_totals_) fail(Status::kBadData, "%s: second totals", in_.place().c_str());
  if (!bodyHolds(in_.head(), totalsBytes(schema_)))
    fail(Status::kBadData, "%s: the totals have %llu bytes, %zu are needed", in_.place().c_str(),
         ull{in_.head().length}, sizeof(SectionHead) + totalsBytes(schema_));
  Box box(schema_.boxSize());
  const Totals totals = decodeTotals(schema_, in_.body(), &box);
  // What the header claims is compared, too: it may have come through a pipe.
  differ("vertices", schema_.vertex_count, seen_.vertices);
  differ("cells", schema_.cell_count, seen_.cells);
  differ("faces", schema_.face_count, seen_.faces);
  if (std::min({totals.vertices, totals.cells, totals.finalized, totals.faces, totals.chunks}) < 0)
    fail(Status::kBadData, "%s: a negative count", in_.place().c_str());
  differ("vertices", totals.vertices, seen_.vertices);
  differ("cells", totals.cells, seen_.cells);
  differ("finalizations", totals.finalized, seen_.finalized);
  differ("faces", totals.faces, seen_.faces);
  differ("chunks", totals.chunks, seen_.chunks);
  if (box.min != box_->min || box.max != box_->max)
    fail(Status::kBadData, "%s: the box is not that of the chunks", in_.place().c_str());
  have_totals_ = true;
  totals_at_ = in_.at();
}

void Reader::readEnd() {
  const EndOwn own = in_.head().get<EndOwn>();
  if (in_.head().length != sizeof(SectionHead) || !have_totals_ || !not_indexed_.empty() ||
      own.totals != totals_at_ || own.last_index != last_index_ || own.file_bytes != in_.offset())
    fail(Status::kBadData, "%s: the end marker does not fit what stands before it",
         in_.place().c_str());
  in_.skipBody();
  ended_ = true;
}

// -------------------------------------------------------------------------------- the batches

// Where the next batch ends: after kBatchCells, but not inside a batch that came with faces, and
// where explicit finalizations stand.
size_t Reader::endOfBatch() const {
  size_t end = std::min<size_t>(cell_ + kBatchCells, counts_.cells);
  if (face_ < counts_.faces)
    end = std::max<size_t>(end, column<uint32_t>(shape_->facesAfter())[face_]);
  if (finalized_ < counts_.finalized)
    end = std::min<size_t>(end, column<uint32_t>(shape_->finalizedAfter())[finalized_]);
  return end;
}

void Reader::failAtCell(size_t cell, int64_t vertex) const {
  fail(Status::kBadData, "%s: cell %llu names vertex %lld, but only %lld have come",
       in_.place().c_str(), ull{static_cast<uint64_t>(seen_.cells)} - counts_.cells + cell,
       static_cast<long long>(vertex), static_cast<long long>(seen_.vertices));
}

// As unsigned numbers negative ids are larger than any count.
uint64_t highestOf(const int64_t* ids, size_t count) {
  uint64_t highest = 0;
  for (size_t i = 0; i < count; ++i) highest = std::max(highest, static_cast<uint64_t>(ids[i]));
  return highest;
}
// The same of `base` + the numbers, which `ids` become: many at once, as 32-bit numbers are.
uint64_t widen(const int32_t* narrow, size_t count, int64_t base, int64_t* ids) {
  int32_t least = std::numeric_limits<int32_t>::max(), most = std::numeric_limits<int32_t>::min();
  for (size_t i = 0; i < count; ++i) {
    ids[i] = base + narrow[i];
    least = std::min(least, narrow[i]);
    most = std::max(most, narrow[i]);
  }
  return static_cast<uint64_t>(base + (base + least < 0 ? least : most));
}

// Hands out the cells up to `end`; returns 1 + the highest vertex in them.
uint64_t Reader::takeCells(size_t end, BatchView& batch) {
  const size_t count = end - cell_, ids = 4 * count;
  batch.cell_count = count;
  uint64_t highest = 0;
  if (flags_ & kChunkWideCells) {
    batch.cells = column<int64_t>(shape_->cells()) + 4 * cell_;
    highest = highestOf(batch.cells, ids);
  } else {
    if (wide_.size() < ids) wide_.resize(ids);
    batch.cells = wide_.data();
    if (count > 0)
      highest = widen(column<int32_t>(shape_->cells()) + 4 * cell_, ids,
                      static_cast<int64_t>(counts_.first_vertex), wide_.data());
  }
  if (count > 0 && highest >= static_cast<uint64_t>(seen_.vertices))
    for (size_t i = 0; i < ids; ++i)
      if (static_cast<uint64_t>(batch.cells[i]) >= static_cast<uint64_t>(seen_.vertices))
        failAtCell(cell_ + i / 4, batch.cells[i]);
  if (flags_ & kChunkLastUses) batch.last_uses = column<uint8_t>(shape_->lastUses()) + cell_;
  for (size_t i = 0; i < cell_rows_.size(); ++i) cell_rows_[i] = row(shape_->cellArray(i), cell_);
  batch.cell_data = cell_rows_.data();
  cell_ = end;
  return count > 0 ? highest + 1 : 0;
}

// Hands out the finalizations and faces that stand before cell `end`; raises *vertices to what
// they name.
void Reader::takeMarks(size_t end, uint64_t* vertices, BatchView& batch) {
  const auto raise = [vertices](const int64_t* ids, size_t count) {
    for (size_t i = 0; i < count; ++i)
      *vertices = std::max(*vertices, static_cast<uint64_t>(ids[i]) + 1);
  };
  const uint32_t* after = column<uint32_t>(shape_->finalizedAfter());
  batch.finalized = column<int64_t>(shape_->finalized()) + finalized_;
  while (finalized_ < counts_.finalized && after[finalized_] <= end) {
    ++finalized_;
    ++batch.finalized_count;
  }
  raise(batch.finalized, batch.finalized_count);
  after = column<uint32_t>(shape_->facesAfter());
  batch.faces = column<int64_t>(shape_->faces()) + 3 * face_;
  batch.face_labels = column<int64_t>(shape_->faceLabels()) + face_;
  while (face_ < counts_.faces && after[face_] <= end) {
    ++face_;
    ++batch.face_count;
  }
  raise(batch.faces, 3 * batch.face_count);
}

void Reader::takeVertices(uint64_t end, BatchView& batch) {
  const uint64_t rank = counts_.first_vertex + vertex_;
  const size_t count = end > rank ? static_cast<size_t>(end - rank) : 0;
  batch.first_vertex = rank;
  batch.vertex_count = count;
  batch.positions = row(shape_->positions(), vertex_);
  for (size_t i = 0; i < field_rows_.size(); ++i) field_rows_[i] = row(shape_->field(i), vertex_);
  batch.fields = field_rows_.data();
  if (flags_ & kChunkLocked) batch.locked = column<uint8_t>(shape_->locked()) + vertex_;
  vertex_ += count;
}

bool Reader::next(BatchView& batch) {
  batch = BatchView{};
  if (!in_chunk_ && !nextWholeChunk()) return false;
  const size_t end = endOfBatch();
  uint64_t vertices = takeCells(end, batch);
  takeMarks(end, &vertices, batch);
  // The last batch takes what is left: vertices that come before they are used.
  if (cell_ == counts_.cells && finalized_ == counts_.finalized && face_ == counts_.faces) {
    vertices = static_cast<uint64_t>(seen_.vertices);
    in_chunk_ = false;
    in_.countChunk();
  }
  takeVertices(vertices, batch);
  return true;
}

}  // namespace

std::unique_ptr<Source> openTolerant(std::unique_ptr<ByteSource> bytes, Losses& losses) {
  return std::make_unique<Reader>(std::move(bytes), &losses);
}

}  // namespace tets

Input openTets(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  if (!tets::kHostFits)
    fail(Status::kUnsupported, "%s: .tets is not supported on big-endian machines",
         bytes->name().c_str());
  Input input;
  if (options.recover)
    input.stream = tets::recover(std::move(bytes), options.temp_dir, options.note);
  else
    input.stream = std::make_unique<tets::Reader>(std::move(bytes));
  return input;
}

}  // namespace tetstream
