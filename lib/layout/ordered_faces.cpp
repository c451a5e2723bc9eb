#include "ordered_faces.h"

#include <cstring>

#include "status.h"

namespace tetstream {

// So many sorts hold records at a time.
constexpr size_t kSortsAtOnce = 4;

OrderedFaces::OrderedFaces(IndexedSource& source, const RankedVertices::Budget& budget)
    : source_(source),
      budget_(budget),
      count_(static_cast<uint64_t>(std::max<int64_t>(source.schema().face_count, 0))),
      rows_(sizeof(OrderedFace), budget.temp_dir) {
  budget_.memory_bytes /= kSortsAtOnce;
}

ExternalSort& OrderedFaces::sorted(std::unique_ptr<ExternalSort>& sort, size_t payload_bytes) {
  if (!sort)
    sort = std::make_unique<ExternalSort>(payload_bytes, budget_.memory_bytes, budget_.account,
                                          budget_.temp_dir);
  return *sort;
}

template <class Payload>
static void add(ExternalSort& sort, uint64_t key, const Payload& payload) {
  std::memcpy(sort.add(key), &payload, sizeof payload);
}

template <class Payload>
static bool takeNext(ExternalSort& sort, uint64_t* key, Payload* payload) {
  const unsigned char* record = sort.next(key);
  if (record) std::memcpy(payload, record, sizeof *payload);
  return record != nullptr;
}

void OrderedFaces::number(uint64_t point, int64_t vertex) {
  add(sorted(points_, sizeof vertex), point, vertex);
}

void OrderedFaces::finish(const Tell& tell) {
  if (empty()) return;
  sortCorners();
  tell(0.4);
  joinNumbers();
  tell(0.6);
  sortFaces([&tell](double share) { tell(0.6 + 0.4 * share); });
}

void OrderedFaces::sortCorners() {
  const int64_t points = source_.schema().vertex_count;
  const uint64_t number = source_.firstNumber();
  std::vector<int64_t> corners(3 * kRowsOfPiece), labels(kRowsOfPiece);
  ExternalSort& sort = sorted(corners_, sizeof(uint64_t));
  readInPieces(
      count_, [](double) {},
      [&](uint64_t first, size_t count) {
        source_.readFaces(first, count, corners.data(), labels.data());
        for (size_t i = 0; i < 3 * count; ++i) {
          if (corners[i] < 0 || corners[i] >= points)
            fail(Status::kBadData, "labelled face %llu: point %lld is not one of the mesh's %lld",
                 static_cast<unsigned long long>(source_.faceNumber(first + i / 3)),
                 static_cast<long long>(corners[i]) + static_cast<long long>(number),
                 static_cast<long long>(points));
          add(sort, static_cast<uint64_t>(corners[i]), uint64_t{3 * first + i});
        }
      });
  sort.finish();
}

// Both are in the order of their points.
void OrderedFaces::joinNumbers() {
  ExternalSort &points = sorted(points_, sizeof(int64_t)),
               &numbers = sorted(numbers_, sizeof(int64_t));
  points.finish();
  uint64_t known = 0, point, corner;
  int64_t vertex = 0;
  bool has_point = takeNext(points, &known, &vertex);
  while (takeNext(*corners_, &point, &corner)) {
    while (has_point && known < point) has_point = takeNext(points, &known, &vertex);
    if (!has_point || known != point)
      fail(Status::kBadData, "labelled face %llu: no cell has its point %llu",
           static_cast<unsigned long long>(source_.faceNumber(corner / 3)),
           static_cast<unsigned long long>(source_.firstNumber() + point));
    add(numbers, corner, vertex);
  }
  numbers.finish();
  disk_ = points.diskBytes() + corners_->diskBytes() + numbers.diskBytes();
  points_.reset();
  corners_.reset();
}

void OrderedFaces::sortFaces(const Tell& tell) {
  std::vector<int64_t> corners(3 * kRowsOfPiece), labels(kRowsOfPiece);
  ExternalSort sort(sizeof(OrderedFace), budget_.memory_bytes, budget_.account, budget_.temp_dir);
  uint64_t key;
  readInPieces(count_, tell, [&](uint64_t first, size_t count) {
    source_.readFaces(first, count, corners.data(), labels.data());
    for (size_t i = 0; i < count; ++i) {
      OrderedFace face{{0, 0, 0}, labels[i], source_.faceNumber(first + i)};
      for (int64_t& vertex : face.vertices) takeNext(*numbers_, &key, &vertex);
      add(sort, static_cast<uint64_t>(face.last()), face);
    }
  });
  disk_ = std::max(disk_, numbers_->diskBytes() + sort.diskBytes());
  numbers_.reset();
  sort.finish();
  while (const unsigned char* row = sort.next(&key)) rows_.append(row, 1);
  rows_.finish();
  disk_ = std::max(disk_, sort.diskBytes() + rows_.diskBytes());
}

OrderedFace OrderedFaces::face(uint64_t place) {
  OrderedFace face;
  std::memcpy(&face, rows_.row(place), sizeof face);
  return face;
}

}  // namespace tetstream
