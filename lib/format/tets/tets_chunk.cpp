#include "tets_chunk.h"

#include <limits>

namespace tetstream::tets {

ChunkBuilder::ChunkBuilder(const Schema& schema)
    : schema_(schema), shape_(schema), columns_(shape_.columns().size()), box_(schema.boxSize()) {}

void ChunkBuilder::start(uint64_t first_vertex, uint64_t first_cell) {
  counts_ = {};
  counts_.first_vertex = first_vertex;
  first_cell_ = first_cell;
  any_locked_ = any_last_use_ = false;
  for (Bytes& c : columns_) c.clear();
  cells_.clear();
  box_.clear();
}

static const unsigned char* rowOf(const void* column, size_t row, size_t bytes_per_row) {
  return static_cast<const unsigned char*>(column) + row * bytes_per_row;
}

// Appends count flags, null standing for zeros, and says whether one of them is set.
static bool appendFlags(std::vector<unsigned char>& out, const uint8_t* flags, size_t first,
                        size_t count) {
  if (!flags) {
    out.resize(out.size() + count, 0);
    return false;
  }
  uint8_t any = 0;
  for (size_t i = first; i < first + count; ++i) any |= flags[i];
  append(out, flags + first, count);
  return any != 0;
}

// A comparison with NaN is false, so NaN never gets into a box; nor does what is infinite.
template <class T>
static void growTo(const void* rows, size_t components, size_t count, double* min, double* max) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const T* row = static_cast<const T*>(rows);
  for (size_t i = 0; i < count; ++i, row += components)
    for (size_t j = 0; j < components; ++j) {
      const double x = static_cast<double>(row[j]);
      if (x < min[j] && x > -kInfinity) min[j] = x;
      if (x > max[j] && x < kInfinity) max[j] = x;
    }
}

void ChunkBuilder::growBox(size_t box_column, const void* rows, ScalarType type, size_t components,
                           size_t count) {
  double* min = box_.min.data() + box_column;
  double* max = box_.max.data() + box_column;
  switch (type) {
    case ScalarType::kFloat32:
      return growTo<float>(rows, components, count, min, max);
    case ScalarType::kFloat64:
      return growTo<double>(rows, components, count, min, max);
    case ScalarType::kInt32:
      return growTo<int32_t>(rows, components, count, min, max);
    case ScalarType::kInt64:
      return growTo<int64_t>(rows, components, count, min, max);
  }
}

void ChunkBuilder::addVertices(const BatchView& batch, size_t first, size_t count) {
  const size_t stride = 3 * sizeOf(schema_.position_type);
  const unsigned char* positions = rowOf(batch.positions, first, stride);
  append(columns_[shape_.positions()], positions, count * stride);
  growBox(0, positions, schema_.position_type, 3, count);
  size_t box_column = 3;
  for (size_t i = 0; i < schema_.fields.size(); ++i) {
    const Column& c = schema_.fields[i];
    const unsigned char* rows = rowOf(batch.fields[i], first, c.bytesPerRow());
    append(columns_[shape_.field(i)], rows, count * c.bytesPerRow());
    growBox(box_column, rows, c.type, static_cast<size_t>(c.components), count);
    box_column += static_cast<size_t>(c.components);
  }
  any_locked_ |= appendFlags(columns_[shape_.locked()], batch.locked, first, count);
  counts_.vertices += static_cast<uint32_t>(count);
}

void ChunkBuilder::addCells(const BatchView& batch, size_t first, size_t count) {
  cells_.insert(cells_.end(), batch.cells + 4 * first, batch.cells + 4 * (first + count));
  Bytes& uses = columns_[shape_.lastUses()];
  any_last_use_ |= appendFlags(uses, batch.last_uses, first, count);
  for (size_t i = uses.size() - count; i < uses.size(); ++i) uses[i] &= 15;
  for (size_t i = 0; i < schema_.cell_data.size(); ++i) {
    const size_t stride = schema_.cell_data[i].bytesPerRow();
    append(columns_[shape_.cellArray(i)], rowOf(batch.cell_data[i], first, stride), count * stride);
  }
  counts_.cells += static_cast<uint32_t>(count);
}

void ChunkBuilder::addFinalized(int64_t vertex) {
  append(columns_[shape_.finalized()], &vertex, sizeof vertex);
  append(columns_[shape_.finalizedAfter()], &counts_.cells, sizeof counts_.cells);
  ++counts_.finalized;
}

void ChunkBuilder::addFace(const int64_t corners[3], int64_t label) {
  append(columns_[shape_.faces()], corners, 3 * sizeof *corners);
  append(columns_[shape_.faceLabels()], &label, sizeof label);
  append(columns_[shape_.facesAfter()], &counts_.cells, sizeof counts_.cells);
  ++counts_.faces;
}

bool ChunkBuilder::idsFitNarrow() const {
  const int64_t base = static_cast<int64_t>(counts_.first_vertex);
  int64_t lowest = 0, highest = 0;
  for (const int64_t id : cells_) {
    if (id - base < lowest) lowest = id - base;
    if (id - base > highest) highest = id - base;
  }
  return lowest >= std::numeric_limits<int32_t>::min() &&
         highest <= std::numeric_limits<int32_t>::max();
}

void ChunkBuilder::writeColumns(uint32_t flags, unsigned char* payload) {
  unsigned char* cells = payload + shape_[shape_.cells()].offset;
  if (flags & kChunkWideCells) {
    std::memcpy(cells, cells_.data(), cells_.size() * sizeof(int64_t));
  } else {
    const int64_t base = static_cast<int64_t>(counts_.first_vertex);
    for (size_t i = 0; i < cells_.size(); ++i) {
      const int32_t id = static_cast<int32_t>(cells_[i] - base);
      std::memcpy(cells + i * sizeof id, &id, sizeof id);
    }
  }
  for (size_t i = 0; i < columns_.size(); ++i)
    if (i != shape_.cells() && shape_[i].bytes)
      std::memcpy(payload + shape_[i].offset, columns_[i].data(), shape_[i].bytes);
}

const std::vector<unsigned char>& ChunkBuilder::encode(uint64_t rank, bool compress,
                                                       IndexEntry* entry) {
  uint32_t flags = kMustUnderstand;
  if (any_locked_) flags |= kChunkLocked;
  if (any_last_use_) flags |= kChunkLastUses;
  if (!idsFitNarrow()) flags |= kChunkWideCells;
  shape_.set(counts_, flags);

  const size_t start_bytes = chunkStartBytes(schema_), box_bytes = box_.min.size() * sizeof(double);
  const size_t payload_at = sizeof(SectionHead) + start_bytes;
  makeZeros(section_, payload_at + shape_.payloadBytes());
  const ChunkStart start = {first_cell_, 0};
  unsigned char* at = section_.data() + sizeof(SectionHead);
  std::memcpy(at, &start, sizeof start);
  std::memcpy(at + sizeof start, box_.min.data(), box_bytes);
  std::memcpy(at + sizeof start + box_bytes, box_.max.data(), box_bytes);
  writeColumns(flags, section_.data() + payload_at);

  size_t stored = shape_.payloadBytes();
  if (const size_t packed = compress ? codec_.compress(shape_, payload_at, section_) : 0) {
    flags |= kCodecZstd << kCodecShift;
    stored = packed;
  }
  SectionHead head = makeHead(kChunk, flags);
  head.value = static_cast<uint32_t>(stored);
  head.set(counts_);
  seal(head, rank, section_);
  *entry = {0,
            head.length,
            counts_.first_vertex,
            first_cell_,
            counts_.vertices,
            counts_.cells,
            counts_.finalized,
            counts_.faces,
            {},
            {}};
  std::memcpy(entry->box_min, box_.min.data(), sizeof entry->box_min);
  std::memcpy(entry->box_max, box_.max.data(), sizeof entry->box_max);
  return section_;
}

}  // namespace tetstream::tets
