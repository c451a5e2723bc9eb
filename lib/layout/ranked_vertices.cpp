#include "ranked_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "status.h"

namespace tetstream {

size_t RankedVertices::valueBytes(const IndexedSource& source) {
  const Schema& schema = source.schema();
  size_t bytes = 3 * sizeOf(schema.position_type);
  for (const Column& c : schema.fields) bytes += c.bytesPerRow();
  return source.randomAccess() ? 0 : bytes;
}

RankedVertices::RankedVertices(IndexedSource& source, const Survey& survey, const VertexKey& key,
                               Budget budget, const std::vector<bool>& measured, Schema& schema,
                               const Tell& tell)
    : source_(source),
      holds_values_(!source.randomAccess()),
      rows_(rowBytes(source), budget.temp_dir) {
  ExternalSort sort(rowBytes(source), budget.memory_bytes, budget.account, budget.temp_dir);
  sortPoints(survey, key, sort, measured, schema, [&](double share) { tell(0.7 * share); });
  sort.finish();
  const auto all = static_cast<double>(std::max<uint64_t>(survey.usedCount(), 1));
  uint64_t sorted_key;
  while (const unsigned char* row = sort.next(&sorted_key)) {
    rows_.append(row, 1);
    if (rows_.rows() % kRowsOfPiece == 0) tell(0.7 + 0.3 * static_cast<double>(rows_.rows()) / all);
  }
  rows_.finish();
  disk_ = sort.diskBytes() + rows_.diskBytes();
}

namespace {

// A column of a piece of the points: its values, and where they go in a row and in the box.
struct PieceColumn {
  std::vector<double> values;  // of any type
  size_t bytes, components, place, in_box;
  ScalarType type;
  const Column* measured;  // its field, where that is
};

void growBox(const PieceColumn& column, size_t row, uint64_t point, Schema& schema) {
  for (size_t k = 0; k < column.components; ++k) {
    const double value = valueAt(column.values.data(), column.type, row * column.components + k);
    if (!std::isfinite(value)) {
      if (column.measured) failNotFinite("point " + std::to_string(point), *column.measured);
      continue;
    }
    double& low = schema.box_min[column.in_box + k];
    double& high = schema.box_max[column.in_box + k];
    low = std::min(low, value);
    high = std::max(high, value);
  }
}

// `measured` is of the fields: positions are checked by checkPlace.
std::vector<PieceColumn> columnsOf(const Schema& schema, const std::vector<bool>& measured) {
  std::vector<PieceColumn> columns;
  size_t place = 0, in_box = 0;
  const auto add = [&](size_t components, ScalarType type, const Column* field) {
    PieceColumn column{{}, components * sizeOf(type), components, place, in_box, type, field};
    column.values.resize(components * kRowsOfPiece);
    place += column.bytes;
    in_box += components;
    columns.push_back(std::move(column));
  };
  add(3, schema.position_type, nullptr);
  for (size_t f = 0; f < schema.fields.size(); ++f) {
    const Column& c = schema.fields[f];
    const bool is_measured = !measured.empty() && measured[f];
    add(static_cast<size_t>(c.components), c.type, is_measured ? &c : nullptr);
  }
  return columns;
}

}  // namespace

void RankedVertices::sortPoints(const Survey& survey, const VertexKey& key, ExternalSort& sort,
                                const std::vector<bool>& measured, Schema& schema,
                                const Tell& tell) {
  if (!schema.hasBox()) {  // else that of a mesh of which this is a part
    schema.box_min.assign(schema.boxSize(), std::numeric_limits<double>::infinity());
    schema.box_max.assign(schema.boxSize(), -std::numeric_limits<double>::infinity());
  }
  std::vector<PieceColumn> columns = columnsOf(schema, measured);
  const uint64_t number = source_.firstNumber();
  std::vector<int64_t> origins(source_.hasOrigins() ? kRowsOfPiece : 0);
  readInPieces(static_cast<uint64_t>(schema.vertex_count), tell, [&](uint64_t first, size_t count) {
    source_.readPositions(first, count, columns[0].values.data());
    for (size_t f = 0; f < schema.fields.size(); ++f)
      source_.readField(f, first, count, columns[f + 1].values.data());
    if (!origins.empty()) source_.readOrigins(first, count, origins.data());
    for (size_t i = 0; i < count; ++i) {
      const uint64_t point = first + i;
      if (!survey.isUsed(point)) continue;
      for (const PieceColumn& column : columns) growBox(column, i, number + point, schema);
      double place[3];
      placeAt(columns[0].values.data(), columns[0].type, i, place);
      checkPlace(number + point, place);
      unsigned char* row = sort.add(key(point, place));
      const bool locked = source_.locked() && source_.locked()[point];
      const uint64_t head = point | (locked ? kLockedBit : 0);
      std::memcpy(row, &head, kHead);
      for (const PieceColumn& column : columns)
        if (holds_values_)
          std::memcpy(
              row + kHead + column.place,
              reinterpret_cast<const unsigned char*>(column.values.data()) + i * column.bytes,
              column.bytes);
      if (!origins.empty())
        std::memcpy(row + rowBytes(source_) - sizeof origins[i], &origins[i], sizeof origins[i]);
    }
  });
  if (sort.empty()) {
    schema.box_min.clear();
    schema.box_max.clear();
  }
}

void RankedVertices::tellRanks(uint64_t first, Array<uint32_t>& ranks) {
  std::fill_n(ranks.data(), ranks.size(), kNoRank);
  for (uint64_t rank = 0; rank < rows_.rows(); ++rank) {
    uint64_t head;
    std::memcpy(&head, rows_.row(rank), kHead);
    const uint64_t place = (head & ~kLockedBit) - first;
    if (place < ranks.size()) ranks[static_cast<size_t>(place)] = static_cast<uint32_t>(rank);
  }
}

uint64_t RankedVertices::pointAt(uint64_t rank) {
  uint64_t head;
  std::memcpy(&head, rows_.row(rank), kHead);
  return head & ~kLockedBit;
}

int64_t RankedVertices::copyTo(uint64_t rank, Batch& batch, size_t row) {
  const auto* from = static_cast<const unsigned char*>(rows_.row(rank));
  uint64_t head;
  std::memcpy(&head, from, kHead);
  const uint64_t point = head & ~kLockedBit;
  const Schema& schema = source_.schema();
  auto origin = static_cast<int64_t>(point);
  if (source_.hasOrigins())
    std::memcpy(&origin, from + rowBytes(source_) - sizeof origin, sizeof origin);
  if (head & kLockedBit) batch.lock(row);
  if (!holds_values_) {
    source_.readPositions(point, 1, batch.position(row));
    for (size_t f = 0; f < schema.fields.size(); ++f)
      source_.readField(f, point, 1, batch.field(f, row));
    return origin;
  }
  from += kHead;
  std::memcpy(batch.position(row), from, 3 * sizeOf(schema.position_type));
  from += 3 * sizeOf(schema.position_type);
  for (size_t f = 0; f < schema.fields.size(); ++f) {
    std::memcpy(batch.field(f, row), from, schema.fields[f].bytesPerRow());
    from += schema.fields[f].bytesPerRow();
  }
  return origin;
}

}  // namespace tetstream
