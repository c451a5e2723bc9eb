#include "mesh_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "float_labels.h"
#include "orient.h"
#include "status.h"
#include "triangle.h"

namespace tetstream {

constexpr uint32_t kInUse = 0xfffffffeu;

static size_t valuesOf(const Schema& schema, const ScanPlan& plan) {
  size_t values = 0;
  for (size_t column : plan.fields) values += static_cast<size_t>(schema.fields[column].components);
  return values;
}

MeshScan::MeshScan(const Schema& schema, const ScanPlan& plan, const Budgets& budgets,
                   Account& account)
    : schema_(schema),
      plan_(plan),
      values_(valuesOf(schema, plan)),
      stride_(3 + values_),
      front_(account),
      faces_(account, events()),
      data_(account),
      vertex_link_(account),
      cell_link_(account),
      cells_({4, values_}, budgets.cells),
      boundary_({3, values_}, budgets.boundary),
      is_finite_(plan.fields.size(), true),
      low_(values_, std::numeric_limits<double>::infinity()),
      high_(values_, -std::numeric_limits<double>::infinity()),
      row_(4 * stride_),
      columns_(plan.fields.size()),
      labels_(plan.cell_arrays.size()) {
  for (size_t i = 0; i < plan.cell_arrays.size(); ++i)
    regions_.push_back(std::make_unique<RegionParts>(account, plan.drops_ids));
}

FaceFront::Events MeshScan::events() {
  return {[this](const uint32_t vertices[3]) { addBoundary(vertices); },
          [this](uint32_t first, uint32_t second) {
            for (auto& regions : regions_) regions->join(first, second);
          },
          [this](uint32_t cell) {
            for (auto& regions : regions_) regions->remove(cell);
            cell_link_[cell] = cell_free_;
            cell_free_ = cell;
          },
          [this](uint32_t vertex) {
            vertex_link_[vertex] = vertex_free_;
            vertex_free_ = vertex;
          }};
}

uint32_t MeshScan::takeNumber(Array<uint32_t>& links, uint32_t& first_free, uint32_t& used) {
  uint32_t number = first_free;
  if (number != kNone) {
    first_free = links[number];
  } else {
    if (used == kInUse) fail(Status::kNoMemory, "%s: its front is too wide", plan_.mesh.c_str());
    if (used == links.size()) links.resize(std::max<size_t>(1024, links.size() * 3 / 2));
    number = used++;
  }
  links[number] = kInUse;
  return number;
}

// ---------------------------------------------------------------------------------- vertices

static bool allFinite(const double* values, size_t count) {
  return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
}

std::string MeshScan::rowText(uint64_t vertex) const {
  return plan_.mesh + ": vertex " + std::to_string(vertex);
}

void MeshScan::takeVertices(const BatchView& batch) {
  if (batch.vertex_count == 0) return;
  positions_.resize(3 * batch.vertex_count);
  convertScalars(batch.positions, schema_.position_type, positions_.data(), ScalarType::kFloat64,
                 positions_.size());
  for (size_t f = 0; f < plan_.fields.size(); ++f) {
    const Column& column = schema_.fields[plan_.fields[f]];
    columns_[f].resize(batch.vertex_count * static_cast<size_t>(column.components));
    convertScalars(batch.fields[plan_.fields[f]], column.type, columns_[f].data(),
                   ScalarType::kFloat64, columns_[f].size());
  }
  for (size_t v = 0; v < batch.vertex_count; ++v) {
    const uint64_t id = front_.introduced();
    const uint32_t number = takeNumber(vertex_link_, vertex_free_, vertices_used_);
    if (data_.size() < vertex_link_.size() * stride_) data_.resize(vertex_link_.size() * stride_);
    front_.introduce(number);
    double* to = data_.data() + number * stride_;
    const double* const position = positions_.data() + 3 * v;
    if (!allFinite(position, 3))
      fail(Status::kBadData, "%s: its position is not finite", rowText(id).c_str());
    to = std::copy_n(position, 3, to);
    for (size_t f = 0; f < columns_.size(); ++f) {
      const size_t components = columns_[f].size() / batch.vertex_count;
      const double* const values = columns_[f].data() + v * components;
      const bool is_finite = allFinite(values, components);
      if (!is_finite && plan_.are_finite)
        failNotFinite(rowText(id), schema_.fields[plan_.fields[f]]);
      is_finite_[f] = is_finite_[f] && is_finite;
      to = std::copy_n(values, components, to);
    }
  }
}

void MeshScan::use(uint32_t vertex) {
  const double* values = dataOf(vertex) + 3;
  for (size_t k = 0; k < values_; ++k) {
    low_[k] = std::min(low_[k], values[k]);
    high_[k] = std::max(high_[k], values[k]);
  }
}

// Of an active vertex, or kNoSlot.
uint32_t MeshScan::numberOf(int64_t vertex) const {
  const auto rank = static_cast<uint64_t>(vertex);
  return rank < front_.introduced() ? front_.find(rank) : kNoSlot;
}

void MeshScan::finalize(int64_t vertex) {
  const uint32_t number = numberOf(vertex);
  if (number == kNoSlot)
    fail(Status::kBadData, "%s: vertex %lld is finalized, but is not known or final before",
         plan_.mesh.c_str(), static_cast<long long>(vertex));
  front_.finalize(static_cast<uint64_t>(vertex));
  faces_.finalize(number);
}

// ------------------------------------------------------------------------------------- cells

// The cell in row_.
void MeshScan::keepCell() {
  const Box box = cells_.shape().boxOf(row_.data());
  box_.add(box);
  double centre[3];
  cells_.shape().centreOf(row_.data(), centre);
  if (met_ ? !met_->meets(box) : !isWithin(plan_.part, centre)) return;
  volume_kept_ += shapes_.lastVolume();
  cells_.add(row_.data());
}

void MeshScan::addCell(const int64_t corners[4], size_t row) {
  uint32_t numbers[4];
  for (int j = 0; j < 4; ++j) {
    numbers[j] = numberOf(corners[j]);
    if (numbers[j] == kNoSlot)
      fail(Status::kBadData, "%s: cell %llu: vertex %lld is not known or final before",
           plan_.mesh.c_str(), static_cast<unsigned long long>(cells_seen_),
           static_cast<long long>(corners[j]));
    for (int i = 0; i < j; ++i)
      if (numbers[i] == numbers[j])
        fail(Status::kBadData, "%s: cell %llu has vertex %lld twice", plan_.mesh.c_str(),
             static_cast<unsigned long long>(cells_seen_), static_cast<long long>(corners[j]));
  }
  for (size_t j = 0; j < 4; ++j) {
    const double* data = dataOf(numbers[j]);
    if (!faces_.isUsed(numbers[j])) use(numbers[j]);
    std::copy_n(data, 3, row_.data() + 3 * j);
    std::copy_n(data + 3, values_, row_.data() + 12 + values_ * j);
  }
  const double* p = row_.data();
  const int side = orientation(p, p + 3, p + 6, p + 9);
  shapes_.add(p, side);
  keepCell();
  const uint32_t cell = takeNumber(cell_link_, cell_free_, cells_used_);
  for (size_t i = 0; i < regions_.size(); ++i)
    regions_[i]->add(cell, labels_[i][row], shapes_.lastVolume());
  faces_.addCell(cell, numbers, side);
  ++cells_seen_;
}

// Their vertices are here: none of them is final before its batch's cells.
void MeshScan::takeFaces(const BatchView& batch) {
  for (size_t i = 0; i < batch.face_count; ++i) {
    double corners[9];
    for (size_t j = 0; j < 3; ++j) {
      const int64_t vertex = batch.faces[3 * i + j];
      const uint32_t number = numberOf(vertex);
      if (number == kNoSlot)
        fail(Status::kBadData, "%s: labelled face %lld: vertex %lld is not known or final before",
             plan_.mesh.c_str(), static_cast<long long>(face_labels_.faces()),
             static_cast<long long>(vertex));
      std::copy_n(dataOf(number), 3, corners + 3 * j);
    }
    face_labels_.add(batch.face_labels[i], triangleArea(corners));
  }
}

void MeshScan::takeCells(const BatchView& batch) {
  for (size_t i = 0; i < labels_.size(); ++i) {
    const size_t column = plan_.cell_arrays[i];
    labels_[i].resize(batch.cell_count);
    const Column& array = schema_.cell_data[column];
    if (batch.cell_count == 0) continue;
    if (isFloat(array.type))
      readFloatLabels(array, batch.cell_data[column], 0, batch.cell_count, cells_seen_,
                      labels_[i].data());
    else
      convertScalars(batch.cell_data[column], array.type, labels_[i].data(), ScalarType::kInt64,
                     batch.cell_count);
  }
  for (size_t c = 0; c < batch.cell_count; ++c) {
    const int64_t* corners = batch.cells + 4 * c;
    addCell(corners, c);
    const unsigned last_uses = batch.last_uses ? batch.last_uses[c] : 0;
    for (unsigned j = 0; j < 4; ++j)
      if (last_uses >> j & 1) finalize(corners[j]);
  }
}

void MeshScan::addBoundary(const uint32_t vertices[3]) {
  const double* p[3];
  double* values = row_.data() + 9;
  for (size_t j = 0; j < 3; ++j) {
    p[j] = dataOf(vertices[j]);
    std::copy_n(p[j], 3, row_.data() + 3 * j);
    std::copy_n(p[j] + 3, values_, values + values_ * j);
  }
  boundary_.add(row_.data());
  const double area = triangleArea(row_.data());
  boundary_area_ += area;
  double centre[3];
  boundary_.shape().centreOf(row_.data(), centre);
  if (isFaceWithin(plan_.part, centre, boundary_.shape().boxOf(row_.data()))) area_in_part_ += area;
}

void MeshScan::read(Source& source, const Done& done) {
  const auto all = static_cast<double>(std::max<int64_t>(schema_.cell_count, 1));
  for (BatchView batch; source.next(batch);) {
    takeVertices(batch);
    takeFaces(batch);
    takeCells(batch);
    for (size_t i = 0; i < batch.finalized_count; ++i) finalize(batch.finalized[i]);
    done(std::min(static_cast<double>(cells_seen_) / all, 1.0));
  }
  while (front_.active() > 0) finalize(static_cast<int64_t>(front_.lowest()));
  cells_.finish();
  boundary_.finish();
}

}  // namespace tetstream
