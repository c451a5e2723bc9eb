#include "ordered_source.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "status.h"

namespace tetstream {

constexpr size_t kRowsAtOnce = 16384;

static int axisOf(const std::string& name) {
  if (name == "x" || name == "y" || name == "z") return name[0] - 'x';
  if (name != "auto")
    fail(Status::kBadArgument, "axis \"%s\": auto, x, y and z are possible", name.c_str());
  return -1;
}

static double valueAt(const void* rows, ScalarType type, size_t index) {
  switch (type) {
    case ScalarType::kFloat32:
      return static_cast<const float*>(rows)[index];
    case ScalarType::kFloat64:
      return static_cast<const double*>(rows)[index];
    case ScalarType::kInt32:
      return static_cast<const int32_t*>(rows)[index];
    case ScalarType::kInt64:
      return static_cast<double>(static_cast<const int64_t*>(rows)[index]);
  }
  return 0;
}

// Box of `components` values per row, starting at box component `first`, of points that are used.
static void growBox(Schema& schema, size_t first, const void* rows, ScalarType type,
                    size_t components, const uint8_t* used, size_t count, uint64_t row,
                    const char* what) {
  for (size_t i = 0; i < count * components; ++i) {
    if (!used[i / components]) continue;
    const double value = valueAt(rows, type, i);
    if (!std::isfinite(value))
      fail(Status::kBadData, "point %llu: its %s is not finite",
           static_cast<unsigned long long>(row + i / components), what);
    double& low = schema.box_min[first + i % components];
    double& high = schema.box_max[first + i % components];
    low = std::min(low, value);
    high = std::max(high, value);
  }
}

OrderedSource::OrderedSource(IndexedSource& source, const OrderOptions& options)
    : source_(source),
      options_(options),
      schema_(source.schema()),
      mesh_(account_),
      used_(account_),
      order_(account_),
      batch_(schema_) {
  const int axis = axisOf(options.axis);
  constexpr int64_t kMost = std::numeric_limits<uint32_t>::max() - 1;
  if (schema_.vertex_count > kMost || schema_.cell_count > kMost)
    fail(Status::kUnsupported,
         "an indexed mesh of %lld points and %lld cells: ordering holds up to %lld of each",
         static_cast<long long>(schema_.vertex_count), static_cast<long long>(schema_.cell_count),
         static_cast<long long>(kMost));
  const auto tell = [this](double fraction) {
    if (options_.tell) options_.tell(fraction);
  };
  mesh_.vertices = static_cast<uint32_t>(schema_.vertex_count);
  mesh_.cells = static_cast<uint32_t>(schema_.cell_count);
  schema_.box_min.assign(schema_.boxSize(), std::numeric_limits<double>::infinity());
  schema_.box_max.assign(schema_.boxSize(), -std::numeric_limits<double>::infinity());
  tell(0);
  readCells();
  tell(0.3);
  readPoints();
  tell(0.5);
  readValues();
  double fraction = 0.6;
  orderBySweep(
      mesh_, axis, account_, [&] { tell(fraction += 0.05); }, order_);
  mesh_.places.resize(0);
  used_.resize(0);
  unused_ = schema_.vertex_count - order_.used_vertices;
  schema_.vertex_count = order_.used_vertices;
  schema_.front_cells = order_.front_cells;
  schema_.front_width = order_.front_width;
  schema_.front_span = order_.front_span;
  if (order_.used_vertices == 0) schema_.box_min.clear();
}

void OrderedSource::readCells() {
  mesh_.corners.resize(4 * size_t{mesh_.cells});
  used_.resize(mesh_.vertices);
  std::fill_n(used_.data(), mesh_.vertices, uint8_t{0});
  std::vector<int64_t> rows(4 * std::min<size_t>(kRowsAtOnce, mesh_.cells));
  for (uint32_t at = 0; at < mesh_.cells;) {
    const size_t count = std::min<size_t>(kRowsAtOnce, mesh_.cells - at);
    source_.readCells(at, count, rows.data());
    for (size_t i = 0; i < 4 * count; ++i) {
      if (rows[i] < 0 || rows[i] >= schema_.vertex_count)
        fail(Status::kBadData, "cell %zu: point %lld is not one of the mesh's %lld", at + i / 4,
             static_cast<long long>(rows[i]), static_cast<long long>(schema_.vertex_count));
      mesh_.corners[4 * size_t{at} + i] = static_cast<uint32_t>(rows[i]);
      used_[static_cast<size_t>(rows[i])] = 1;
    }
    at += static_cast<uint32_t>(count);
  }
}

void OrderedSource::readPoints() {
  mesh_.places.resize(3 * size_t{mesh_.vertices});
  std::vector<double> rows(3 * std::min<size_t>(kRowsAtOnce, mesh_.vertices));
  // Twice: the box first, so that places in it fit float32 whatever the unit and the offset.
  for (int pass = 0; pass < 2; ++pass)
    for (uint32_t at = 0; at < mesh_.vertices;) {
      const size_t count = std::min<size_t>(kRowsAtOnce, mesh_.vertices - at);
      source_.readPositions(at, count, rows.data());
      if (pass == 0)
        growBox(schema_, 0, rows.data(), schema_.position_type, 3, &used_[at], count, at,
                "position");
      for (size_t i = 0; pass == 1 && i < 3 * count; ++i) {
        const size_t axis = i % 3;
        const double low = schema_.box_min[axis], size = schema_.box_max[axis] - low;
        mesh_.places[axis * mesh_.vertices + at + i / 3] =
            size > 0 && used_[at + i / 3]
                ? static_cast<float>((valueAt(rows.data(), schema_.position_type, i) - low) / size)
                : 0.0f;
      }
      at += static_cast<uint32_t>(count);
    }
}

// The values of a vertex in one row: position, then each field.
void OrderedSource::readValues() {
  size_t width = 3 * sizeOf(schema_.position_type);
  for (const Column& c : schema_.fields) width += c.bytesPerRow();
  if (!source_.randomAccess()) vertex_rows_ = std::make_unique<RowSpool>(width, options_.temp_dir);
  std::vector<unsigned char> rows(width * kRowsAtOnce);
  std::vector<double> column(static_cast<size_t>(kMaxComponents) * kRowsAtOnce);
  for (uint32_t at = 0; at < mesh_.vertices;) {
    const size_t count = std::min<size_t>(kRowsAtOnce, mesh_.vertices - at);
    size_t place = 0, in_box = 3;
    const auto scatter = [&](size_t bytes) {
      const auto* from = reinterpret_cast<const unsigned char*>(column.data());
      for (size_t i = 0; i < count; ++i)
        std::memcpy(rows.data() + i * width + place, from + i * bytes, bytes);
      place += bytes;
    };
    if (vertex_rows_) source_.readPositions(at, count, column.data());
    scatter(3 * sizeOf(schema_.position_type));
    for (size_t f = 0; f < schema_.fields.size(); ++f) {
      const Column& c = schema_.fields[f];
      source_.readField(f, at, count, column.data());
      growBox(schema_, in_box, column.data(), c.type, static_cast<size_t>(c.components), &used_[at],
              count, at, c.name.c_str());
      in_box += static_cast<size_t>(c.components);
      scatter(c.bytesPerRow());
    }
    if (vertex_rows_) vertex_rows_->append(rows.data(), count);
    at += static_cast<uint32_t>(count);
  }
  if (vertex_rows_) vertex_rows_->finish();
  spoolCellData();
}

void OrderedSource::spoolCellData() {
  size_t width = 0;
  for (const Column& c : schema_.cell_data) width += c.bytesPerRow();
  if (source_.randomAccess() || width == 0) return;
  cell_rows_ = std::make_unique<RowSpool>(width, options_.temp_dir);
  std::vector<unsigned char> rows(width * kRowsAtOnce);
  std::vector<double> column(static_cast<size_t>(kMaxComponents) * kRowsAtOnce);
  for (uint32_t at = 0; at < mesh_.cells;) {
    const size_t count = std::min<size_t>(kRowsAtOnce, mesh_.cells - at);
    size_t place = 0;
    for (size_t k = 0; k < schema_.cell_data.size(); ++k) {
      const size_t bytes = schema_.cell_data[k].bytesPerRow();
      source_.readCellData(k, at, count, column.data());
      const auto* from = reinterpret_cast<const unsigned char*>(column.data());
      for (size_t i = 0; i < count; ++i)
        std::memcpy(rows.data() + i * width + place, from + i * bytes, bytes);
      place += bytes;
    }
    cell_rows_->append(rows.data(), count);
    at += static_cast<uint32_t>(count);
  }
  cell_rows_->finish();
}

void OrderedSource::addVertex(uint32_t vertex) {
  const size_t row = batch_.addVertices(1);
  if (source_.locked() && source_.locked()[vertex]) batch_.lock(row);
  if (!vertex_rows_) {
    source_.readPositions(vertex, 1, batch_.position(row));
    for (size_t f = 0; f < schema_.fields.size(); ++f)
      source_.readField(f, vertex, 1, batch_.field(f, row));
    return;
  }
  const auto* from = static_cast<const unsigned char*>(vertex_rows_->row(vertex));
  std::memcpy(batch_.position(row), from, 3 * sizeOf(schema_.position_type));
  from += 3 * sizeOf(schema_.position_type);
  for (size_t f = 0; f < schema_.fields.size(); ++f) {
    std::memcpy(batch_.field(f, row), from, schema_.fields[f].bytesPerRow());
    from += schema_.fields[f].bytesPerRow();
  }
}

void OrderedSource::addCellData(uint32_t cell, size_t row) {
  const auto* from =
      cell_rows_ ? static_cast<const unsigned char*>(cell_rows_->row(cell)) : nullptr;
  for (size_t k = 0; k < schema_.cell_data.size(); ++k) {
    if (!from) {
      source_.readCellData(k, cell, 1, batch_.cellData(k, row));
      continue;
    }
    std::memcpy(batch_.cellData(k, row), from, schema_.cell_data[k].bytesPerRow());
    from += schema_.cell_data[k].bytesPerRow();
  }
}

bool OrderedSource::next(BatchView& batch) {
  if (place_ == mesh_.cells) return false;
  batch_.clear(introduced_);
  while (place_ < mesh_.cells && batch_.cellCount() < kBatchCells) {
    const uint32_t cell = order_.cell_at[place_];
    const uint32_t* corners = mesh_.corners.data() + 4 * size_t{cell};
    const size_t row = batch_.addCells(1);
    for (int j = 0; j < 4; ++j) {
      if (order_.rank[corners[j]] == introduced_) {
        addVertex(corners[j]);
        ++introduced_;
      }
      batch_.cell(row)[j] = order_.rank[corners[j]];
      if (order_.last_use[corners[j]] == place_)
        batch_.lastUses(row) |= static_cast<uint8_t>(1 << j);
    }
    addCellData(cell, row);
    ++place_;
  }
  batch = batch_.view();
  return true;
}

// The order is known and rows can be had as often as wanted: the places are put back at the end.
class OrderedSource::SecondReading final : public Source {
 public:
  explicit SecondReading(OrderedSource& source) : source_(source) {}
  ~SecondReading() override { source_.place_ = source_.introduced_ = 0; }
  const Schema& schema() const override { return source_.schema(); }
  bool next(BatchView& batch) override { return source_.next(batch); }

 private:
  OrderedSource& source_;
};

std::unique_ptr<Source> OrderedSource::again() {
  return std::make_unique<SecondReading>(*this);
}

}  // namespace tetstream
