#include "xdmf_cells.h"

#include <algorithm>

#include "column_spool.h"
#include "made_values.h"
#include "rows_at_once.h"
#include "status.h"
#include "vtk_cells.h"

namespace tetstream {

namespace {

// By name, and by the number in a list of several types. Without nodes: the list tells how many.
struct Type {
  const char* name;
  int64_t number;
  int vtk;
  uint64_t nodes;
};

constexpr Type kTypes[] = {{"Polyvertex", 1, 2, 0},        {"Polyline", 2, 4, 0},
                           {"Polygon", 3, 7, 0},           {"Triangle", 4, 5, 3},
                           {"Quadrilateral", 5, 9, 4},     {"Tetrahedron", 6, 10, 4},
                           {"Pyramid", 7, 14, 5},          {"Wedge", 8, 13, 6},
                           {"Hexahedron", 9, 12, 8},       {"Edge_3", 34, 21, 3},
                           {"Quadrilateral_9", 35, 28, 9}, {"Triangle_6", 36, 22, 6},
                           {"Quadrilateral_8", 37, 23, 8}, {"Tetrahedron_10", 38, 24, 10},
                           {"Pyramid_13", 39, 27, 13},     {"Wedge_15", 40, 26, 15},
                           {"Wedge_18", 41, 32, 18},       {"Hexahedron_20", 48, 25, 20},
                           {"Hexahedron_24", 49, 33, 24},  {"Hexahedron_27", 50, 29, 27},
                           {"Tri_6", 36, 22, 6},           {"Quad_8", 37, 23, 8},
                           {"Quad_9", 35, 28, 9},          {"Tet_10", 38, 24, 10},
                           {"Hex_20", 48, 25, 20},         {"Hex_24", 49, 33, 24},
                           {"Hex_27", 50, 29, 27}};

const Type* typeOf(const std::string& name) {
  for (const Type& type : kTypes)
    if (sameWord(name, type.name)) return &type;
  return nullptr;
}

const Type* typeOf(int64_t number) {
  for (const Type& type : kTypes)
    if (type.number == number) return &type;
  return nullptr;
}

class SpooledBytes final : public ValueBytes {
 public:
  explicit SpooledBytes(std::shared_ptr<ColumnSpool> spool) : spool_(std::move(spool)) {}
  void readAt(uint64_t offset, void* out, size_t size) override {
    spool_->readAt(offset, out, size);
  }

 private:
  std::shared_ptr<ColumnSpool> spool_;
};

MeshArray spooledArray(const char* name, ValueType type,
                       const std::shared_ptr<ColumnSpool>& spool) {
  spool->close();
  MeshArray array{name, type, 1, {}};
  array.open = [spool, type](uint64_t) {
    return openBinaryValues(std::make_unique<SpooledBytes>(spool), "cells", type, false);
  };
  return array;
}

// A list of cells of several types: the number of the type, that of the nodes where the type does
// not tell it, the nodes.
class MixedList {
 public:
  MixedList(const MeshArray& list, uint64_t count, const std::string& temp_dir)
      : values_(list.open(count)),
        count_(count),
        types_(std::make_shared<ColumnSpool>(temp_dir)),
        offsets_(std::make_shared<ColumnSpool>(temp_dir)),
        nodes_(std::make_shared<ColumnSpool>(temp_dir)) {}

  void take(MeshPiece& piece, const std::string& place) {
    int64_t end = 0;
    while (at_ < count_) {
      const int64_t number = next(place);
      const Type* type = typeOf(number);
      if (!type) failCell(Status::kUnsupported, place, "has XDMF's type " + std::to_string(number));
      uint64_t nodes = type->nodes;
      if (nodes == 0) nodes = static_cast<uint64_t>(next(place));
      if (nodes > count_ - at_) failCell(Status::kBadData, place, "is not there in full");
      for (uint64_t i = 0; i < nodes; ++i) {
        const int64_t node = next(place);
        nodes_->append(&node, sizeof node);
      }
      end += static_cast<int64_t>(nodes);
      const auto vtk = static_cast<uint8_t>(type->vtk);
      types_->append(&vtk, sizeof vtk);
      offsets_->append(&end, sizeof end);
      ++cells_;
    }
    piece.cell_count = cells_;
    piece.types = spooledArray("types", ValueType::kUInt8, types_);
    piece.offsets = spooledArray("offsets", ValueType::kInt64, offsets_);
    piece.connectivity = spooledArray("connectivity", ValueType::kInt64, nodes_);
  }

 private:
  [[noreturn]] void failCell(Status status, const std::string& place,
                             const std::string& text) const {
    fail(status, "%s: cell %llu %s", place.c_str(), static_cast<unsigned long long>(cells_),
         text.c_str());
  }

  int64_t next(const std::string& place) {
    if (at_ == count_) failCell(Status::kBadData, place, "is not there in full");
    if (at_ == filled_) {
      first_ = at_;
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count_ - at_));
      values_->read(at_, n, held_, ScalarType::kInt64);
      filled_ = at_ + n;
    }
    return held_[at_++ - first_];
  }

  std::unique_ptr<Values> values_;
  uint64_t count_, at_ = 0, first_ = 0, filled_ = 0, cells_ = 0;
  int64_t held_[kRowsAtOnce];
  std::shared_ptr<ColumnSpool> types_, offsets_, nodes_;
};

OpenArray always(OpenValues open) {
  return [open = std::move(open)](uint64_t) { return open(); };
}

}  // namespace

int vtkTypeOfXdmf(const std::string& topology) {
  if (sameWord(topology, "Mixed")) return 0;
  const Type* type = typeOf(topology);
  return type ? type->vtk : -1;
}

void addXdmfCells(const XdmfTopology& topology, XdmfArrays& arrays, const std::string& temp_dir,
                  MeshPiece& piece) {
  XdmfItem item = topology.items.front();
  if (item.isUntyped()) {
    item.kind = "Int";
    item.precision = sizeof(int64_t);
  }
  piece.connectivity = arrays.arrayOf(item, "topology", 1);
  if (isFloat(piece.connectivity->type))
    fail(Status::kBadData, "%s are no integers", arrays.describe(item).c_str());
  const Type* type = typeOf(topology.type);
  if (!type) {
    if (item.count() == 0) return;
    MixedList list(*piece.connectivity, item.count(), temp_dir);
    return list.take(piece, arrays.describe(item));
  }
  const uint64_t nodes = type->nodes > 0 ? type->nodes : std::max<uint64_t>(item.sizes.back(), 1);
  if (item.count() % nodes != 0)
    fail(Status::kBadData, "%s are not %llu nodes to a cell", arrays.describe(item).c_str(),
         static_cast<unsigned long long>(nodes));
  piece.cell_count = item.count() / nodes;
  const auto each = static_cast<int64_t>(nodes);
  piece.types = MeshArray{"types", ValueType::kInt32, 1,
                          always([vtk = type->vtk] { return openSequence(vtk, 0); })};
  piece.offsets = MeshArray{"offsets", ValueType::kInt64, 1,
                            always([each] { return openSequence(each, each); })};
}

bool areTetrahedra(const MeshPiece& piece) {
  if (!piece.types || piece.types->type != ValueType::kInt32) return false;
  int64_t type = 0;
  piece.types->open(piece.cell_count)->read(0, 1, &type, ScalarType::kInt64);
  return type == kVtkTetra;
}

}  // namespace tetstream
