#include "xdmf_functions.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "ordered_rows.h"
#include "point_set.h"
#include "rows_at_once.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kLastPoints = 1 << 12;  // of which the number is known
constexpr size_t kCorners = 4;
// Of the components of a symmetric matrix, xx, yy, zz, xy, yz and xz, each one's place in a
// function.
constexpr size_t kSymmetric[] = {0, 3, 5, 1, 4, 2};

unsigned long long shown(uint64_t number) {
  return number;
}

// The values of a function by point or by cell.
class FunctionRows {
 public:
  FunctionRows(const XdmfFunction& function, const XdmfCellList& cells, const std::string& temp_dir)
      : function_(function),
        cells_(cells),
        width_(static_cast<size_t>(function.components)),
        values_(sizeof(double), temp_dir),
        points_(account_, function.is_of_points ? cells.points : 0),
        last_(kLastPoints),
        row_(width_),
        rows_(function.is_of_points ? cells.points : cells.cells, width_ * sizeof(double),
              temp_dir) {}

  void make() {
    checkBegins();
    takeValues();
    takeCells();
    std::fill(row_.begin(), row_.end(), 0.0);
    for (uint64_t point = 0; function_.is_of_points && point < cells_.points; ++point)
      if (!points_.has(point)) rows_.put(point, row_.data());
    rows_.finish();
  }

  const unsigned char* row(uint64_t place) { return rows_.row(place); }

 private:
  void checkBegins() const {
    const std::unique_ptr<Values> begins = function_.begins.open(cells_.cells + 1);
    std::vector<int64_t> held(kRowsAtOnce);
    for (uint64_t at = 0; at <= cells_.cells; at += kRowsAtOnce) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, cells_.cells + 1 - at));
      begins->read(at, n, held.data(), ScalarType::kInt64);
      for (size_t i = 0; i < n; ++i)
        if (static_cast<uint64_t>(held[i]) != (at + i) * function_.numbers_each)
          fail(Status::kBadData, "%s: those of cell %llu begin at %lld, not at %llu",
               function_.place.c_str(), shown(at + i), static_cast<long long>(held[i]),
               shown((at + i) * function_.numbers_each));
    }
  }

  void takeValues() {
    const uint64_t count = function_.value_count;
    const std::unique_ptr<Values> values = function_.values.open(count);
    std::vector<double> held(kRowsAtOnce);
    for (uint64_t at = 0; at < count; at += kRowsAtOnce) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count - at));
      values->read(at, n, held.data(), ScalarType::kFloat64);
      values_.append(held.data(), n);
    }
    values_.finish();
  }

  void takeCells() {
    const auto each = static_cast<size_t>(function_.numbers_each);
    const std::unique_ptr<Values> numbers = function_.numbers.open(cells_.cells * each),
                                  corners = cells_.nodes->open(cells_.cells * kCorners);
    std::vector<int64_t> held(kCellsAtOnce * each), nodes(kCellsAtOnce * kCorners);
    for (uint64_t at = 0; at < cells_.cells; at += kCellsAtOnce) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kCellsAtOnce, cells_.cells - at));
      numbers->read(at * each, n * each, held.data(), ScalarType::kInt64);
      corners->read(at * kCorners, n * kCorners, nodes.data(), ScalarType::kInt64);
      for (size_t i = 0; i < n; ++i)
        takeCell(at + i, held.data() + i * each, nodes.data() + i * kCorners);
    }
  }

  void takeCell(uint64_t cell, const int64_t* numbers, const int64_t* nodes) {
    if (!function_.is_of_points) return putRow(cell, cell, numbers);
    checkCorners(cells_, cell, nodes);
    for (size_t k = 0; k < kCorners; ++k) {
      const auto point = static_cast<uint64_t>(nodes[k]);
      checkPoint(cell, point, numbers[k]);
      if (points_.add(point)) putRow(point, cell, numbers + k);
    }
  }

  // Cells that come soon after each other share points, so that rows of other cells show here.
  void checkPoint(uint64_t cell, uint64_t point, int64_t number) {
    auto& [seen, its_number] = last_[static_cast<size_t>(point % kLastPoints)];
    if (seen == point + 1 && its_number != number)
      fail(Status::kBadData, "%s: cell %llu has number %lld at point %llu, another cell %lld",
           function_.place.c_str(), shown(cell), static_cast<long long>(number), shown(point),
           static_cast<long long>(its_number));
    seen = point + 1;
    its_number = number;
  }

  void putRow(uint64_t place, uint64_t cell, const int64_t* numbers) {
    const size_t step = static_cast<size_t>(function_.numbers_each) / width_;
    for (size_t c = 0; c < width_; ++c) {
      const int64_t number = numbers[(function_.is_symmetric ? kSymmetric[c] : c) * step];
      if (static_cast<uint64_t>(number) >= function_.value_count)
        fail(Status::kBadData, "%s: cell %llu has number %lld, there are %llu values",
             function_.place.c_str(), shown(cell), static_cast<long long>(number),
             shown(function_.value_count));
      std::memcpy(&row_[c], values_.row(static_cast<uint64_t>(number)), sizeof(double));
    }
    rows_.put(place, row_.data());
  }

  const XdmfFunction& function_;
  const XdmfCellList& cells_;
  const size_t width_;
  RowSpool values_;
  Account account_;
  PointSet points_;                                 // that have a row
  std::vector<std::pair<uint64_t, int64_t>> last_;  // points, plus one, and their first numbers
  std::vector<double> row_;
  OrderedRows rows_;
};

class FunctionValues final : public Values {
 public:
  FunctionValues(std::shared_ptr<FunctionRows> rows, int components)
      : rows_(std::move(rows)), width_(static_cast<uint64_t>(components)) {}

  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    auto* to = static_cast<unsigned char*>(out);
    for (size_t n; count > 0; first += n, count -= n, to += n * sizeOf(type)) {
      const uint64_t component = first % width_;
      n = std::min(count, static_cast<size_t>(width_ - component));
      convertScalars(rows_->row(first / width_) + component * sizeof(double), ScalarType::kFloat64,
                     to, type, n);
    }
  }

 private:
  std::shared_ptr<FunctionRows> rows_;
  uint64_t width_;
};

// A function and its rows, once they are wanted.
struct Held {
  XdmfFunction function;
  MeshArray corners;
  XdmfCellList cells;
  std::string temp_dir;
  std::shared_ptr<FunctionRows> rows;
};

}  // namespace

MeshArray valuesOfFunction(XdmfFunction function, MeshArray corners, XdmfCellList cells,
                           const std::string& temp_dir) {
  MeshArray array = function.values;
  array.components = function.components;
  if (!isFloat(array.type)) array.type = ValueType::kFloat64;
  const auto held = std::make_shared<Held>(
      Held{std::move(function), std::move(corners), std::move(cells), temp_dir, nullptr});
  held->cells.nodes = &held->corners;
  array.open = [held](uint64_t) {
    if (!held->rows) {
      auto rows = std::make_shared<FunctionRows>(held->function, held->cells, held->temp_dir);
      rows->make();
      held->rows = std::move(rows);
    }
    return std::make_unique<FunctionValues>(held->rows, held->function.components);
  };
  return array;
}

}  // namespace tetstream
