#include "rounding_source.h"

#include <algorithm>
#include <cmath>

#include "status.h"

namespace tetstream {

static bool isDouble(ScalarType type) {
  return type == ScalarType::kFloat64;
}

bool Rounding::needed(const Schema& schema) {
  return isDouble(schema.position_type) ||
         std::any_of(schema.fields.begin(), schema.fields.end(),
                     [](const Column& c) { return isDouble(c.type); });
}

// Rounding is monotone: the box of rounded values is the rounded box.
static void roundBox(std::vector<double>& box, const Schema& exact) {
  size_t at = 0;
  const auto roundNext = [&](size_t count, bool rounded) {
    for (; count > 0; --count, ++at)
      if (rounded) box[at] = static_cast<double>(static_cast<float>(box[at]));
  };
  roundNext(3, isDouble(exact.position_type));
  for (const Column& c : exact.fields)
    roundNext(static_cast<size_t>(c.components), isDouble(c.type));
}

Rounding::Rounding(const Schema& schema)
    : exact_(schema),
      rounded_(schema),
      fields_(schema.fields.size()),
      pointers_(schema.fields.size()) {
  if (schema.hasBox()) {
    roundBox(rounded_.box_min, exact_);
    roundBox(rounded_.box_max, exact_);
  }
  rounded_.position_type = ScalarType::kFloat32;
  for (Column& c : rounded_.fields)
    if (isDouble(c.type)) c.type = ScalarType::kFloat32;
}

bool Rounding::rounds(int column) const {
  return isDouble(column < 0 ? exact_.position_type : exact_.fields[column].type);
}

size_t Rounding::components(int column) const {
  return column < 0 ? 3 : static_cast<size_t>(exact_.fields[column].components);
}

void Rounding::roundRows(int column, uint64_t first, const double* in, size_t count,
                         float* out) const {
  const size_t width = components(column), values = count * width;
  for (size_t i = 0; i < values; ++i) {
    out[i] = static_cast<float>(in[i]);
    if (std::isinf(out[i]) && std::isfinite(in[i]))
      fail(
          Status::kUnsupported,
          "vertex %llu: a value of %s is too large for float32, which is all that the output holds",
          static_cast<unsigned long long>(first + i / width),
          column < 0 ? "its position" : exact_.fields[column].name.c_str());
  }
}

BatchView Rounding::round(const BatchView& batch) {
  BatchView out = batch;
  if (batch.vertex_count == 0) return out;
  const auto rounded = [&](int column, const void* in, std::vector<float>& rows) -> const void* {
    if (!rounds(column)) return in;
    rows.resize(batch.vertex_count * components(column));
    roundRows(column, batch.first_vertex, static_cast<const double*>(in), batch.vertex_count,
              rows.data());
    return rows.data();
  };
  out.positions = rounded(-1, batch.positions, positions_);
  for (size_t i = 0; i < fields_.size(); ++i)
    pointers_[i] = rounded(static_cast<int>(i), batch.fields[i], fields_[i]);
  out.fields = pointers_.data();
  return out;
}

bool RoundingSource::next(BatchView& batch) {
  if (!in_.next(batch)) return false;
  batch = rounding_.round(batch);
  return true;
}

// Reads and rounds block by block, so that a long range takes no more memory than a short one.
void RoundingIndexedSource::readRounded(int column, uint64_t first, size_t count, void* out) {
  const size_t width = rounding_.components(column);
  exact_.resize(width * std::min(count, kBatchCells));
  for (size_t done = 0; done < count;) {
    const size_t rows = std::min(count - done, kBatchCells);
    if (column < 0)
      in_.readPositions(first + done, rows, exact_.data());
    else
      in_.readField(static_cast<size_t>(column), first + done, rows, exact_.data());
    rounding_.roundRows(column, first + done, exact_.data(), rows,
                        static_cast<float*>(out) + done * width);
    done += rows;
  }
}

void RoundingIndexedSource::readPositions(uint64_t first, size_t count, void* out) {
  if (rounding_.rounds(-1)) return readRounded(-1, first, count, out);
  in_.readPositions(first, count, out);
}

void RoundingIndexedSource::readField(size_t column, uint64_t first, size_t count, void* out) {
  const int index = static_cast<int>(column);
  if (rounding_.rounds(index)) return readRounded(index, first, count, out);
  in_.readField(column, first, count, out);
}

std::unique_ptr<Source> RoundingSource::again(Part part) {
  std::unique_ptr<Source> in = in_.again(part);
  return in ? std::unique_ptr<Source>(new RoundingSource(std::move(in))) : nullptr;
}

}  // namespace tetstream
