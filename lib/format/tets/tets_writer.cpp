// format/tets: writes `.tets`. Depends on tets_chunk.h, front_meter.h.
//
// Where chunks end depends on the events alone, not on the batches in which they come, as long as
// every vertex comes in the batch of the first cell that uses it: a vertex is written just before
// that cell, whatever the batch. Only labelled faces keep the batch they came in.
#include <algorithm>

#include "front_meter.h"
#include "status.h"
#include "tets_chunk.h"
#include "tets_format.h"

namespace tetstream {
namespace tets {
namespace {

// A chunk is the unit of checking, of compressing and of what a reader holds. Smaller ones cost
// compression (4096 cells: a tenth), larger ones memory: three copies of a chunk live in the
// writer.
constexpr uint32_t kChunkRows = 16384;
constexpr size_t kChunkBytes = size_t{1} << 20;  // of one kind of row
static_assert(kChunkRows <= kMaxRows && 4 * kChunkBytes <= kMaxPayload);

uint32_t rowsPerChunk(size_t bytes_per_row) {
  return static_cast<uint32_t>(std::clamp<size_t>(kChunkBytes / bytes_per_row, 1, kChunkRows));
}

struct Limits {
  uint32_t vertices, cells;
};

struct Stream {  // what has come so far
  Totals totals = {};
  Box box;
  explicit Stream(size_t box_size) : box(box_size) {}
};

class Writer final : public Sink {
 public:
  Writer(std::unique_ptr<ByteSink> bytes, const WriteOptions& options)
      : sink_(std::move(bytes)),
        // A pipe's reader waits for every byte, and nothing of it stays on a disk.
        compress_(options.compress && sink_->seekable() && Codec::builtIn()),
        note_(options.note) {}

  void begin(const Schema& schema) override;
  void put(const BatchView& batch) override;
  void finish() override;

 private:
  void trimLabelNames();
  uint64_t vertexCount() const { return chunk_first_vertex_ + chunk_->vertexCount(); }
  void checkBatch(const BatchView& batch) const;
  size_t cellsThatFit(const BatchView& batch, size_t first, const Limits& limits,
                      uint64_t* highest) const;
  void putVerticesBelow(const BatchView& batch, uint64_t end, const Limits& limits);
  void putCells(const BatchView& batch, const Limits& limits);
  void putFinalized(const BatchView& batch);
  void sortFaces(const BatchView& batch);
  void putFaces(const BatchView& batch, uint64_t end);
  bool fitsWhole(const BatchView& batch) const;
  bool fitsOpenChunk(const BatchView& batch) const;
  void endChunk();
  void writeIndex();
  void writeTotals();
  void writeEnd();
  void write(const std::vector<unsigned char>& section);
  void checkCounts() const;
  void patchHeader();

  std::unique_ptr<ByteSink> sink_;
  bool compress_;
  std::function<void(const std::string&)> note_;
  Schema schema_;
  Limits limits_ = {};
  size_t vertex_bytes_ = 0, cell_bytes_ = 0;
  Account account_;
  std::unique_ptr<FrontMeter> meter_;
  std::unique_ptr<ChunkBuilder> chunk_;
  std::unique_ptr<Stream> stream_;
  uint64_t chunk_first_vertex_ = 0;
  uint64_t offset_ = 0, rank_ = 0, last_index_ = 0, totals_at_ = 0;
  std::vector<IndexEntry> index_;
  std::vector<size_t> faces_;  // of the batch, as they are to be put
  size_t faces_put_ = 0;
};

void Writer::begin(const Schema& schema) {
  checkSchema(schema);
  for (const size_t columns : {schema.fields.size(), schema.cell_data.size()})
    if (columns > kMaxColumns)
      fail(Status::kUnsupported, "%s: .tets holds up to %u fields and cell arrays, not %zu",
           sink_->name().c_str(), kMaxColumns, columns);
  for (const std::vector<Column>* columns : {&schema.fields, &schema.cell_data})
    for (const Column& c : *columns)
      if (c.name.find('\0') != std::string::npos)
        fail(Status::kUnsupported, "%s: the name \"%s\" goes on after a zero byte",
             sink_->name().c_str(), c.name.c_str());
  schema_ = schema;
  trimLabelNames();
  vertex_bytes_ = 3 * sizeOf(schema.position_type) + 1;
  for (const Column& c : schema.fields) vertex_bytes_ += c.bytesPerRow();
  cell_bytes_ = 4 * sizeof(int64_t) + 1;
  for (const Column& c : schema.cell_data) cell_bytes_ += c.bytesPerRow();
  limits_ = {rowsPerChunk(vertex_bytes_), rowsPerChunk(cell_bytes_)};
  meter_ = std::make_unique<FrontMeter>(account_);
  chunk_ = std::make_unique<ChunkBuilder>(schema_);
  stream_ = std::make_unique<Stream>(schema_.boxSize());
  chunk_->start(0, 0);
  write(encodeHeader(schema_));
}

void Writer::trimLabelNames() {
  std::vector<LabelName>& names = schema_.label_names;
  const size_t fit = labelNamesThatFit(schema_);
  if (fit == names.size()) return;
  if (note_)
    note_(textOf("%s: there is room for %zu of the %zu names of labels; the others are left out",
                 sink_->name().c_str(), fit, names.size()));
  names.resize(fit);
}

void Writer::checkBatch(const BatchView& batch) const {
  if (batch.first_vertex != vertexCount())
    fail(Status::kBadData, "%s: a batch begins with vertex %llu, but %llu vertices have come",
         sink_->name().c_str(), static_cast<unsigned long long>(batch.first_vertex),
         static_cast<unsigned long long>(vertexCount()));
  bool locks_face = false;
  for (size_t i = 0; batch.face_locks && i < batch.face_count; ++i)
    locks_face = locks_face || batch.face_locks[i];
  if (batch.edge_count > 0 || locks_face)
    fail(Status::kUnsupported,
         "%s: .tets locks a vertex where it comes, which may be before it is known that an edge or "
         "a face of it is locked: lock the vertices, or have the mesh ordered, which does so",
         sink_->name().c_str());
  // Cells and finalizations are checked by the meter.
  const uint64_t known = batch.first_vertex + batch.vertex_count;
  for (size_t i = 0; i < 3 * batch.face_count; ++i)
    if (static_cast<uint64_t>(batch.faces[i]) >= known)
      fail(Status::kBadData, "%s: a labelled face names vertex %lld, but %llu vertices have come",
           sink_->name().c_str(), static_cast<long long>(batch.faces[i]),
           static_cast<unsigned long long>(known));
}

void Writer::put(const BatchView& batch) {
  checkBatch(batch);
  meter_->put(batch);
  Limits limits = limits_;
  if (batch.face_count && fitsWhole(batch)) {
    // Faces stay with their batch, and a batch with faces in one chunk, if it can be.
    if (!fitsOpenChunk(batch)) endChunk();
    limits = {kMaxRows, kMaxRows};
  }
  sortFaces(batch);
  putCells(batch, limits);
  putVerticesBelow(batch, batch.first_vertex + batch.vertex_count, limits);
  putFinalized(batch);
  putFaces(batch, vertexCount());
}

bool Writer::fitsWhole(const BatchView& batch) const {
  return batch.vertex_count <= kMaxRows && batch.cell_count <= kMaxRows &&
         batch.finalized_count <= kMaxRows && batch.face_count <= kMaxRows &&
         batch.vertex_count * vertex_bytes_ + batch.cell_count * cell_bytes_ <= kMaxPayload / 2;
}

bool Writer::fitsOpenChunk(const BatchView& batch) const {
  return chunk_->vertexCount() + batch.vertex_count <= limits_.vertices &&
         chunk_->cellCount() + batch.cell_count <= limits_.cells &&
         chunk_->finalizedCount() + batch.finalized_count <= kMaxRows &&
         chunk_->faceCount() + batch.face_count <= kMaxRows;
}

// How many cells from `first` on go into the chunk with the vertices that they need; `highest` gets
// the end of those vertices.
size_t Writer::cellsThatFit(const BatchView& batch, size_t first, const Limits& limits,
                            uint64_t* highest) const {
  const size_t room = limits.cells - std::min(limits.cells, chunk_->cellCount());
  const size_t last = first + std::min(room, batch.cell_count - first);
  const uint64_t bound = chunk_first_vertex_ + limits.vertices;
  *highest = vertexCount();
  size_t cell = first;
  for (; cell < last; ++cell) {
    const int64_t* c = batch.cells + 4 * cell;
    const int64_t top = std::max(std::max(c[0], c[1]), std::max(c[2], c[3]));
    const uint64_t need = std::max(*highest, static_cast<uint64_t>(top) + 1);
    if (need > bound) break;
    *highest = need;
  }
  return cell - first;
}

void Writer::putVerticesBelow(const BatchView& batch, uint64_t end, const Limits& limits) {
  while (vertexCount() < end) {
    if (chunk_->vertexCount() >= limits.vertices) endChunk();
    const uint64_t count =
        std::min<uint64_t>(end - vertexCount(), limits.vertices - chunk_->vertexCount());
    chunk_->addVertices(batch, static_cast<size_t>(vertexCount() - batch.first_vertex),
                        static_cast<size_t>(count));
  }
}

void Writer::putCells(const BatchView& batch, const Limits& limits) {
  for (size_t cell = 0; cell < batch.cell_count;) {
    uint64_t end;
    const size_t count = cellsThatFit(batch, cell, limits, &end);
    if (count > 0) {
      putVerticesBelow(batch, end, limits);
      chunk_->addCells(batch, cell, count);
      cell += count;
      if (!fitsWhole(batch)) putFaces(batch, vertexCount());
    } else if (!chunk_->empty()) {
      endChunk();
    } else {
      // One cell brings more vertices than a chunk holds: they came long before they are used.
      putVerticesBelow(batch, vertexCount() + limits.vertices, limits);
    }
  }
}

void Writer::putFinalized(const BatchView& batch) {
  for (size_t i = 0; i < batch.finalized_count; ++i) {
    if (chunk_->finalizedCount() == kMaxRows) endChunk();
    chunk_->addFinalized(batch.finalized[i]);
  }
}

static uint64_t lastOf(const int64_t* face) {
  return static_cast<uint64_t>(std::max({face[0], face[1], face[2]}));
}

// A batch that is taken apart gives each face with its last vertex: no part that comes before has
// all of them, and its cell, which needs them, is not before that.
void Writer::sortFaces(const BatchView& batch) {
  faces_.resize(batch.face_count);
  faces_put_ = 0;
  for (size_t i = 0; i < faces_.size(); ++i) faces_[i] = i;
  if (!fitsWhole(batch))
    std::stable_sort(faces_.begin(), faces_.end(), [&batch](size_t a, size_t b) {
      return lastOf(batch.faces + 3 * a) < lastOf(batch.faces + 3 * b);
    });
}

// Those whose vertices are all below `end`, of the sorted ones.
void Writer::putFaces(const BatchView& batch, uint64_t end) {
  for (; faces_put_ < faces_.size(); ++faces_put_) {
    const size_t i = faces_[faces_put_];
    if (lastOf(batch.faces + 3 * i) >= end) return;
    if (chunk_->faceCount() == kMaxRows) endChunk();
    chunk_->addFace(batch.faces + 3 * i, batch.face_labels[i]);
  }
}

void Writer::endChunk() {
  if (chunk_->empty()) return;
  IndexEntry entry;
  const std::vector<unsigned char>& section = chunk_->encode(rank_, compress_, &entry);
  entry.offset = offset_;
  write(section);
  Totals& totals = stream_->totals;
  totals.vertices += entry.vertices;
  totals.cells += entry.cells;
  totals.finalized += entry.finalized;
  totals.faces += entry.faces;
  ++totals.chunks;
  stream_->box.add(chunk_->box());
  index_.push_back(entry);
  if (index_.size() == kIndexEntries) writeIndex();
  chunk_first_vertex_ = static_cast<uint64_t>(totals.vertices);
  chunk_->start(chunk_first_vertex_, static_cast<uint64_t>(totals.cells));
}

void Writer::write(const std::vector<unsigned char>& section) {
  sink_->write(section.data(), section.size());
  offset_ += section.size();
  ++rank_;
}

void Writer::writeIndex() {
  if (index_.empty()) return;
  const size_t bytes = index_.size() * sizeof(IndexEntry);
  std::vector<unsigned char> section(sizeof(SectionHead) + bytes);
  std::memcpy(section.data() + sizeof(SectionHead), index_.data(), bytes);
  SectionHead head = makeHead(kIndex, 0);
  head.value = static_cast<uint32_t>(index_.size());
  head.set(IndexOwn{last_index_, static_cast<uint64_t>(stream_->totals.chunks) - index_.size(),
                    sizeof(IndexEntry), 0});
  last_index_ = offset_;
  seal(head, rank_, section);
  write(section);
  index_.clear();
}

void Writer::writeTotals() {
  const FrontStatistics& front = meter_->statistics();
  stream_->totals.front_width = front.width;
  stream_->totals.front_span = front.span;
  stream_->totals.front_cells = front.cells;
  const size_t box_bytes = schema_.boxSize() * sizeof(double);
  std::vector<unsigned char> section(sizeof(SectionHead) + sizeof(Totals) + 2 * box_bytes);
  unsigned char* at = section.data() + sizeof(SectionHead);
  std::memcpy(at, &stream_->totals, sizeof(Totals));
  std::memcpy(at + sizeof(Totals), stream_->box.min.data(), box_bytes);
  std::memcpy(at + sizeof(Totals) + box_bytes, stream_->box.max.data(), box_bytes);
  SectionHead head = makeHead(kTotals, 0);
  seal(head, rank_, section);
  totals_at_ = offset_;
  write(section);
}

void Writer::writeEnd() {
  std::vector<unsigned char> section(sizeof(SectionHead));
  SectionHead head = makeHead(kEnd, kMustUnderstand);
  head.set(EndOwn{totals_at_, last_index_, offset_ + section.size()});
  seal(head, rank_, section);
  write(section);
}

void Writer::checkCounts() const {
  const Totals& t = stream_->totals;
  if (schema_.vertex_count >= 0 && schema_.vertex_count != t.vertices)
    fail(Status::kBadData, "%s: %lld vertices were announced and %lld came", sink_->name().c_str(),
         static_cast<long long>(schema_.vertex_count), static_cast<long long>(t.vertices));
  if (schema_.cell_count >= 0 && schema_.cell_count != t.cells)
    fail(Status::kBadData, "%s: %lld cells were announced and %lld came", sink_->name().c_str(),
         static_cast<long long>(schema_.cell_count), static_cast<long long>(t.cells));
  if (schema_.face_count >= 0 && schema_.face_count != t.faces)
    fail(Status::kBadData, "%s: %lld labelled faces were announced and %lld came",
         sink_->name().c_str(), static_cast<long long>(schema_.face_count),
         static_cast<long long>(t.faces));
}

void Writer::patchHeader() {
  const Totals& t = stream_->totals;
  schema_.vertex_count = t.vertices;
  schema_.cell_count = t.cells;
  schema_.face_count = t.faces;
  schema_.front_width = t.front_width;
  schema_.front_span = t.front_span;
  schema_.front_cells = t.front_cells;
  schema_.box_min.clear();
  schema_.box_max.clear();
  if (t.vertices > 0) {
    schema_.box_min = stream_->box.min;
    schema_.box_max = stream_->box.max;
  }
  const std::vector<unsigned char> header = encodeHeader(schema_);
  sink_->writeAt(0, header.data(), header.size());
}

void Writer::finish() {
  endChunk();
  checkCounts();
  writeIndex();
  writeTotals();
  writeEnd();
  if (sink_->seekable()) patchHeader();
  sink_->commit();
}

}  // namespace
}  // namespace tets

std::unique_ptr<Sink> createTets(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  if (!tets::kHostFits)
    fail(Status::kUnsupported, "%s: .tets is not supported on big-endian machines",
         bytes->name().c_str());
  return std::make_unique<tets::Writer>(std::move(bytes), options);
}

}  // namespace tetstream
