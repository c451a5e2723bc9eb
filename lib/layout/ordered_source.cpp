#include "ordered_source.h"

#include <algorithm>
#include <limits>

#include "front_meter.h"
#include "graph_order.h"
#include "id_hash.h"
#include "status.h"
#include "swept_mesh.h"
#include "vertex_keys.h"

namespace tetstream {

constexpr double kVerticesPerBrick = 500;

// Before anything is read.
static void check(const Schema& schema, const OrderOptions& options) {
  bool is_axis = false;
  for (const char* axis : {"auto", "x", "y", "z"}) is_axis = is_axis || options.axis == axis;
  if (!is_axis)
    fail(Status::kBadArgument, "axis \"%s\": auto, x, y and z are possible", options.axis.c_str());
  constexpr int64_t kMostPoints = std::numeric_limits<uint32_t>::max() - 1;
  if (schema.vertex_count > kMostPoints)
    fail(Status::kUnsupported,
         "an indexed mesh of %lld points: %lld can be ordered; more are read as a stream, from "
         ".tets "
         "for example",
         static_cast<long long>(schema.vertex_count), static_cast<long long>(kMostPoints));
}

static uint64_t bytesFor(Order order, const Schema& schema) {
  return graphOrderBytes(order, static_cast<uint64_t>(std::max<int64_t>(schema.vertex_count, 0)),
                         static_cast<uint64_t>(std::max<int64_t>(schema.cell_count, 0)));
}

// What sorting the labelled faces takes beside sorted cells: each corner twice, all vertices'
// numbers.
static uint64_t facesDisk(const Schema& schema, uint64_t memory) {
  if (schema.face_count <= 0) return 0;
  const auto faces = static_cast<uint64_t>(schema.face_count);
  const uint64_t runs =
      16 * static_cast<uint64_t>(std::max<int64_t>(schema.vertex_count, 0)) + 96 * faces;
  return (runs * 3 > memory ? runs : 0) + sizeof(OrderedFace) * faces;
}

// Sorted runs and sorted rows are there together; what fits the memory takes no disk.
uint64_t plannedDisk(const Schema& schema, const OrderOptions& options) {
  const uint64_t memory = options.memory_bytes ? options.memory_bytes : kDefaultLayoutMemory;
  const auto points = static_cast<uint64_t>(std::max<int64_t>(schema.vertex_count, 0));
  const auto cells = static_cast<uint64_t>(std::max<int64_t>(schema.cell_count, 0));
  uint64_t values = 3 * sizeOf(schema.position_type), data = 0;
  for (const Column& c : schema.fields) values += c.bytesPerRow();
  for (const Column& c : schema.cell_data) data += c.bytesPerRow();
  const uint64_t point_rows = points * (8 + values), cell_rows = cells * (17 + data);
  const uint64_t point_runs = points * (16 + values), cell_runs = cells * (24 + data);
  const auto onDisk = [memory](uint64_t runs) { return runs * 3 > memory ? runs : 0; };
  const uint64_t once =
      std::max(onDisk(point_runs) + point_rows, point_rows + onDisk(cell_runs) + cell_rows) +
      facesDisk(schema, memory);
  const Order order = orderOf(options.order);
  const bool by_graph = order == Order::kBreadthFirst || order == Order::kSpectral;
  const bool by_pieces = by_graph && bytesFor(order, schema) > memory;
  const uint64_t origin = options.origins ? 8 : 0;
  return by_pieces ? 2 * once + points * (values + 32 + 2 * origin) + cells * (32 + data) : once;
}

// One reading of the stream.
class OrderedSource::Reading final : public Source {
 public:
  // Without values only the connectivity is there, and the faces are told the vertices' numbers.
  Reading(OrderedSource& ordered, bool with_values)
      : ordered_(ordered),
        with_values_(with_values),
        numbers_(ordered.front_ ? &*ordered.front_ : nullptr),
        ids_(account_),
        batch_(ordered.schema_) {}
  const Schema& schema() const override { return ordered_.schema_; }

  bool next(BatchView& batch) override {
    OrderedCells& cells = *ordered_.cells_;
    if (place_ == cells.count()) return false;
    batch_.clear(introduced_);
    const size_t count = std::min<uint64_t>(kBatchCells, cells.count() - place_);
    batch_.addCells(count);
    for (size_t row = 0; row < count; ++row) fillCell(row, cells.cell(place_++));
    if (with_values_) addFaces();
    batch = batch_.view();
    return true;
  }

 private:
  void fillCell(size_t row, const OrderedCell& cell) {
    for (int j = 0; j < 4; ++j) batch_.cell(row)[j] = idOf(cell.corners[j]);
    for (unsigned j = 0; !numbers_ && j < 4; ++j)
      if (cell.last_uses >> j & 1) ids_.remove(cell.corners[j]);
    batch_.lastUses(row) = static_cast<uint8_t>(cell.last_uses);
    if (with_values_) ordered_.cells_->copyData(cell, batch_, row);
  }
  void addFaces() {
    OrderedFaces& faces = *ordered_.faces_;
    for (; face_ < faces.count(); ++face_) {
      const OrderedFace face = faces.face(face_);
      if (static_cast<uint64_t>(face.last()) >= introduced_) break;
      batch_.addFace(face.vertices, face.label);
      batch_.addFaceOrigin(face.number);
    }
  }
  // kNoSlot: it is new, the next one.
  uint32_t numberOf(uint32_t rank) const {
    const uint32_t number = numbers_->number(rank);
    return number < introduced_ ? number : kNoSlot;
  }
  // Ranks get ids in the order of their first use.
  int64_t idOf(uint32_t rank) {
    const uint32_t known = numbers_ ? numberOf(rank) : ids_.find(rank);
    if (known != kNoSlot) return known;
    const size_t row = batch_.addVertices(1);
    if (with_values_) {
      const int64_t origin = ordered_.vertices_->copyTo(rank, batch_, row);
      if (ordered_.tells_origins_) batch_.addOrigin(origin);
    } else if (!ordered_.faces_->empty()) {
      ordered_.faces_->number(ordered_.vertices_->pointAt(rank), static_cast<int64_t>(introduced_));
    }
    if (!numbers_) ids_.add(rank, static_cast<uint32_t>(introduced_));
    return static_cast<int64_t>(introduced_++);
  }

  OrderedSource& ordered_;
  bool with_values_;
  const CellFront* numbers_;  // or, where there are none:
  Account account_;
  IdHash ids_;  // of the active vertices
  Batch batch_;
  uint64_t place_ = 0, introduced_ = 0, face_ = 0;
};

// The vertices in the order of their ranks, which is that of what holds them.
class OrderedSource::Places final : public Source {
 public:
  explicit Places(OrderedSource& ordered) : ordered_(ordered), batch_(ordered.schema_) {}
  const Schema& schema() const override { return ordered_.schema_; }

  bool next(BatchView& batch) override {
    RankedVertices& vertices = *ordered_.vertices_;
    if (rank_ == vertices.count()) return false;
    batch_.clear(rank_);
    for (; rank_ < vertices.count() && batch_.vertexCount() < kBatchCells; ++rank_)
      vertices.copyTo(rank_, batch_, batch_.addVertices(1));
    batch = batch_.view();
    return true;
  }

 private:
  OrderedSource& ordered_;
  Batch batch_;
  uint64_t rank_ = 0;
};

OrderedSource::OrderedSource(IndexedSource& source, const OrderOptions& options)
    : source_(&source),
      schema_(source.schema()),
      graph_rank_(account_),
      tells_origins_(options.origins) {
  check(schema_, options);
  Order order = orderOf(options.order);
  const bool seeks = order == Order::kAuto && options.narrowest;
  if (order == Order::kAuto) order = Order::kSpatial;
  const size_t memory = options.memory_bytes ? options.memory_bytes : kDefaultLayoutMemory;
  const auto part = [&options](double begin, double end) -> Tell {
    return [&options, begin, end](double share) {
      if (options.tell) options.tell(begin + share * (end - begin));
    };
  };
  const bool by_graph = order == Order::kBreadthFirst || order == Order::kSpectral;
  VertexKey key = by_graph ? graphKey(order, options, memory, part(0, 0.5)) : nullptr;
  // What ranks by pieces hold is not there for the vertices.
  const RankedVertices::Budget budget = {swept_ ? memory - memory / 4 : memory, account_,
                                         options.temp_dir};
  const double begin = by_graph ? 0.5 : 0, keyed = by_graph || seeks ? 0.6 : 0.2;
  {
    const Survey survey(*source_, account_, part(begin, begin + 0.1));
    if (!key) key = placeKey(order, survey, options.axis);
    if (seeks && bytesFor(Order::kSpectral, schema_) <= memory)
      key = narrowestKey(key, part(begin + 0.1, keyed));
    vertices_ = std::make_unique<RankedVertices>(*source_, survey, key, budget, options.measured,
                                                 schema_, part(keyed, keyed + 0.1));
    graph_rank_.resize(0);
  }
  unused_ += schema_.vertex_count - static_cast<int64_t>(vertices_->count());
  schema_.vertex_count = static_cast<int64_t>(vertices_->count());
  RankedVertices::Budget for_cells = budget;
  if (hasRoomForFront(budget.memory_bytes)) {
    front_.emplace(vertices_->count(), account_);
    for_cells.memory_bytes -= CellFront::bytesFor(vertices_->count());
  }
  cells_ = std::make_unique<OrderedCells>(*source_, *vertices_, order != Order::kNone, for_cells,
                                          front_ ? &*front_ : nullptr, part(keyed + 0.1, 0.9));
  disk_ += std::max(vertices_->mostDiskBytes(), vertices_->diskBytes() + cells_->mostDiskBytes());
  faces_ = std::make_unique<OrderedFaces>(*source_, budget);
  measureFront(part(0.9, faces_->empty() ? 1 : 0.95));
  faces_->finish(part(0.95, 1));
  disk_ += faces_->mostDiskBytes();
  if (options.memory_bytes > 0) front_.reset();  // the rest of the budget is for what reads this
  reading_ = std::make_unique<Reading>(*this, true);
}

OrderedSource::~OrderedSource() = default;

VertexKey OrderedSource::rankKey() {
  return [this](uint64_t point, const double[3]) {
    return uint64_t{graph_rank_[static_cast<size_t>(point)]};
  };
}

VertexKey OrderedSource::narrowestKey(const VertexKey& sweep, const Tell& tell) {
  const OrderWidths widths = rankNarrowest(*source_, sweep, account_, tell, graph_rank_);
  const std::string swept = chosen_, spectral = nameOf(Order::kSpectral);
  const bool is_tried = widths.spectral != OrderWidths::kUntried;
  const bool is_sweep = !is_tried || widths.by_place <= widths.spectral;
  chosen_ = textOf("%s, with a front of %lld vertices", (is_sweep ? swept : spectral).c_str(),
                   static_cast<long long>(is_sweep ? widths.by_place : widths.spectral));
  if (is_tried)
    chosen_ += textOf(": %s has %lld", (is_sweep ? spectral : swept).c_str(),
                      static_cast<long long>(is_sweep ? widths.spectral : widths.by_place));
  return rankKey();
}

// A mesh that is too large is ranked by pieces.
VertexKey OrderedSource::graphKey(Order order, const OrderOptions& options, size_t memory_bytes,
                                  const Tell& tell) {
  const uint64_t needed = bytesFor(order, schema_);
  chosen_ = nameOf(order);
  if (needed <= memory_bytes) {
    rankByGraph(*source_, order, account_, tell, graph_rank_);
    return rankKey();
  }
  chosen_ += order == Order::kSpectral ? ", by clusters" : ", piece by piece";
  swept_ = std::make_unique<SweptMesh>(*source_, order, options, memory_bytes, account_, tell);
  source_ = &swept_->mesh();
  unused_ = swept_->unusedVertices();
  disk_ = swept_->diskBytes();
  schema_ = source_->schema();
  return swept_->key();
}

VertexKey OrderedSource::placeKey(Order order, const Survey& survey, const std::string& axis) {
  chosen_ = nameOf(order);
  BoxGrid grid(survey.low(), survey.high());
  switch (order) {
    case Order::kSpatial: {
      const Survey::Direction d = survey.direction(axis);
      chosen_ += ", along " + d.name;
      return [d](uint64_t, const double p[3]) {
        return keyOfNumber(d.along[0] * p[0] + d.along[1] * p[1] + d.along[2] * p[2]);
      };
    }
    case Order::kBrick:
      grid.setBricks(static_cast<double>(survey.usedCount()), kVerticesPerBrick);
      return [grid](uint64_t, const double p[3]) { return grid.brickKey(p); };
    case Order::kZOrder:
    case Order::kHilbert: {
      const auto curve = order == Order::kHilbert ? hilbertKey : mortonKey;
      return [grid, curve](uint64_t, const double p[3]) {
        uint32_t cell[3];
        grid.cellOf(p, cell);
        return curve(cell);
      };
    }
    default:
      return [](uint64_t point, const double[3]) { return point; };
  }
}

bool OrderedSource::hasRoomForFront(size_t memory_bytes) const {
  const auto cells = static_cast<uint64_t>(schema_.cell_count);
  return cells < std::numeric_limits<uint32_t>::max() &&
         CellFront::bytesFor(vertices_->count()) <= memory_bytes / 4;
}

void OrderedSource::measureFront(const Tell& tell) {
  const FrontStatistics found = front_ ? takeFront(tell) : meterFront(tell);
  schema_.front_cells = found.cells;
  schema_.front_width = found.width;
  schema_.front_span = found.span;
}

FrontStatistics OrderedSource::meterFront(const Tell& tell) {
  Reading reading(*this, false);
  FrontMeter meter(account_);
  BatchView batch;
  while (reading.next(batch)) {
    meter.put(batch);
    tell(static_cast<double>(meter.cellsSeen()) / static_cast<double>(cells_->count()));
  }
  return meter.statistics();
}

FrontStatistics OrderedSource::takeFront(const Tell& tell) {
  front_->turnRound();
  const double counted = faces_->empty() ? 1 : 0.8;
  const Tell counting = [&](double share) { tell(counted * share); };
  readInPieces(cells_->count(), counting, [&](uint64_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      const OrderedCell cell = cells_->cell(first + i);
      front_->takeFirst(cell.corners, cell.last_uses);
    }
  });
  front_->finish();
  if (!faces_->empty()) numberFaces([&](double share) { tell(counted + (1 - counted) * share); });
  return front_->statistics();
}

// Tells the labelled faces the numbers of their vertices, where the front has them.
void OrderedSource::numberFaces(const Tell& tell) {
  readInPieces(vertices_->count(), tell, [&](uint64_t first, size_t count) {
    for (uint64_t rank = first; rank < first + count; ++rank)
      faces_->number(vertices_->pointAt(rank), front_->number(static_cast<uint32_t>(rank)));
  });
}

bool OrderedSource::next(BatchView& batch) {
  return reading_->next(batch);
}

std::unique_ptr<Source> OrderedSource::again(Part part) {
  if (part == Part::kPositions) return std::make_unique<Places>(*this);
  return std::make_unique<Reading>(*this, true);
}

}  // namespace tetstream
