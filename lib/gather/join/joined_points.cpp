// Points with the same key come together by hashing them into buckets that fit into memory, each of
// which is sorted.
#include "joined_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "buckets.h"
#include "memory.h"
#include "mix.h"
#include "point_set.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kAtOnce = 2048;  // points

// Points everywhere are looked for by their exact coordinates, and in float64, where each cell's
// may have been computed by itself, in a grid of this part of the largest one. Two that differ by
// rounding may lie on both sides of a line: so in several grids, of which each is moved.
constexpr double kGrain = 0x1p-40;
constexpr int kGrids = 4;
// Cells name points in any order: those of some million points stay in memory.
constexpr SpoolShape kInAnyOrder = {1024, 32 << 10};

struct Keyed {
  std::array<uint64_t, 3> key;  // bits of the coordinates, or of places in a grid, or the global id
  uint64_t point;
  bool operator<(const Keyed& other) const {
    return key != other.key ? key < other.key : point < other.point;
  }
};

struct Same {
  uint64_t point, first;  // `point` is `first`, which is lower
  bool operator<(const Same& other) const { return point < other.point; }
};

// Finds the points that are one, and numbers those that are left.
class JoinFinder {
 public:
  JoinFinder(IndexedSource& mesh, const JoinPlan& plan, RowSpool& new_of, RowSpool& old_of)
      : mesh_(mesh), schema_(mesh.schema()), plan_(plan), new_of_(new_of), old_of_(old_of) {}

  uint64_t keptApart() const { return kept_apart_; }

  void find() {
    const uint64_t points = static_cast<uint64_t>(schema_.vertex_count);
    const size_t buckets = bucketsFor(points, sizeof(Keyed));
    Buckets<Same> same(buckets, plan_.temp_dir);
    findSame(same, points);
    if (plan_.everywhere && plan_.near && schema_.position_type == ScalarType::kFloat64)
      findNear(same, points);
    number(same, points);
  }

 private:
  // Of those that are not found yet, by grids.
  void findNear(Buckets<Same>& same, uint64_t points) {
    grain_ = kGrain * largestCoordinate(points);
    for (int grid = 1; grid <= kGrids && grain_ > 0; ++grid) {
      shift_ = 0.618033988749895 * grid;  // of the golden ratio: nowhere near where it was
      findSame(same, points);
    }
  }

  double largestCoordinate(uint64_t points) {
    std::vector<double> places(3 * kAtOnce);
    double largest = 0;
    for (uint64_t at = 0; at < points; at += kAtOnce) {
      const size_t n = static_cast<size_t>(std::min<uint64_t>(kAtOnce, points - at));
      readPlaces(at, n, places.data());
      for (size_t i = 0; i < 3 * n; ++i)
        if (std::isfinite(places[i])) largest = std::max(largest, std::fabs(places[i]));
    }
    return largest;
  }

  bool isFound(uint64_t point) const { return found_ && found_->has(point); }

  void addKeys(Buckets<Keyed>& keyed, uint64_t points) {
    std::vector<double> places(3 * kAtOnce);
    for (uint64_t at = 0; at < points; at += kAtOnce) {
      const size_t n = static_cast<size_t>(std::min<uint64_t>(kAtOnce, points - at));
      plan_.global_ids < 0 ? readPlaces(at, n, places.data()) : readIds(at, n, places.data());
      for (size_t i = 0; i < 3 * n && grain_ > 0; ++i)
        places[i] = std::floor(places[i] / grain_ + shift_) + 0.0;
      for (size_t i = 0; i < n; ++i) {
        if (plan_.everywhere && (isFound(at + i) || !isPlace(&places[3 * i]))) continue;
        Keyed row{{}, at + i};
        std::memcpy(row.key.data(), &places[3 * i], sizeof row.key);
        keyed.add(bucketOf(row, keyed.count()), row);
      }
    }
  }

  // What is none is refused later.
  static bool isPlace(const double place[3]) {
    return std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]);
  }

  static size_t bucketOf(const Keyed& row, size_t count) {
    return static_cast<size_t>(mix(row.key[0] ^ mix(row.key[1] ^ mix(row.key[2]))) % count);
  }

  void readPlaces(uint64_t first, size_t count, double* out) {
    float narrow[3 * kAtOnce];
    const bool is_narrow = schema_.position_type == ScalarType::kFloat32;
    mesh_.readPositions(first, count, is_narrow ? static_cast<void*>(narrow) : out);
    if (is_narrow)
      convertScalars(narrow, ScalarType::kFloat32, out, ScalarType::kFloat64, 3 * count);
    for (size_t i = 0; i < 3 * count; ++i) out[i] += 0.0;  // -0 is 0
  }

  // As keys, whose bits alone matter.
  void readIds(uint64_t first, size_t count, double* out) {
    int64_t ids[kAtOnce];
    const size_t column = static_cast<size_t>(plan_.global_ids);
    mesh_.readField(column, first, count, ids);
    if (schema_.fields[column].type == ScalarType::kInt32) {
      int32_t narrow[kAtOnce];
      std::memcpy(narrow, ids, count * sizeof(int32_t));
      std::copy_n(narrow, count, ids);
    }
    for (size_t i = 0; i < count; ++i) {
      out[3 * i] = std::bit_cast<double>(ids[i]);
      out[3 * i + 1] = out[3 * i + 2] = 0;
    }
  }

  size_t pieceOf(uint64_t point) const {
    const auto after =
        std::upper_bound(plan_.first_points.begin(), plan_.first_points.end(), point);
    return static_cast<size_t>(after - plan_.first_points.begin());
  }

  void findSame(Buckets<Same>& same, uint64_t points) {
    Buckets<Keyed> keyed(same.count(), plan_.temp_dir);
    addKeys(keyed, points);
    if (plan_.everywhere && !found_) found_.emplace(account_, points);
    Account account;
    const uint64_t part = (points - 1) / same.count() + 1;
    for (size_t bucket = 0; bucket < keyed.count(); ++bucket) {
      const Array<Keyed> rows = keyed.take(bucket, account);
      for (size_t first = 0, end; first < rows.size(); first = end) {
        end = endOfKey(rows, first);
        if (!mayJoin(rows, first, end)) continue;
        for (size_t i = first + 1; i < end; ++i) {
          const uint64_t point = rows[i].point;
          same.add(static_cast<size_t>(point / part), {point, rows[first].point});
          if (found_) found_->add(point);
        }
      }
    }
  }

  static size_t endOfKey(const Array<Keyed>& rows, size_t first) {
    size_t end = first + 1;
    while (end < rows.size() && rows[end].key == rows[first].key) ++end;
    return end;
  }

  // Not where one piece has several.
  bool mayJoin(const Array<Keyed>& rows, size_t first, size_t end) {
    if (plan_.everywhere) return true;
    bool repeated = false;
    for (size_t i = first + 1; i < end; ++i)
      repeated |= pieceOf(rows[i].point) == pieceOf(rows[i - 1].point);
    kept_apart_ += repeated && pieceOf(rows[end - 1].point) != pieceOf(rows[first].point);
    return !repeated;
  }

  void number(Buckets<Same>& same, uint64_t points) {
    Account account;
    uint64_t point = 0;
    for (size_t bucket = 0; bucket < same.count(); ++bucket) {
      const Array<Same> rows = same.take(bucket, account);
      for (size_t i = 0; i < rows.size(); ++i) {
        numberUpTo(&point, rows[i].point);
        const int64_t other = -1 - static_cast<int64_t>(rows[i].first);
        new_of_.append(&other, 1);
        ++point;
      }
    }
    numberUpTo(&point, points);
    new_of_.finish();
    old_of_.finish();
  }

  void numberUpTo(uint64_t* point, uint64_t end) {
    for (; *point < end; ++*point) {
      const int64_t number = static_cast<int64_t>(old_of_.rows());
      new_of_.append(&number, 1);
      old_of_.append(point, 1);
    }
  }

  IndexedSource& mesh_;
  const Schema& schema_;
  const JoinPlan& plan_;
  RowSpool &new_of_, &old_of_;
  uint64_t kept_apart_ = 0;
  double grain_ = 0, shift_ = 0;  // of the grid; 0: exact
  Account account_;
  std::optional<PointSet> found_;  // everywhere: those that are others
};

}  // namespace

PointJoin::PointJoin(IndexedSource& mesh, const JoinPlan& plan)
    : plan_(plan),
      new_of_(sizeof(int64_t), plan.temp_dir, plan.everywhere ? kInAnyOrder : SpoolShape()),
      old_of_(sizeof(uint64_t), plan.temp_dir) {
  JoinFinder finder(mesh, plan, new_of_, old_of_);
  finder.find();
  kept_apart_ = finder.keptApart();
}

void PointJoin::tell() const {
  if (!plan_.note) return;
  const auto all = static_cast<unsigned long long>(new_of_.rows());
  const auto joined = static_cast<unsigned long long>(new_of_.rows() - old_of_.rows());
  const char* const by = plan_.global_ids < 0 ? "coordinates" : "global ids";
  if (plan_.everywhere && joined > 0)
    plan_.note(
        textOf("%llu of %llu points were joined with others at the same place; fields of "
               "floats are the mean of theirs there (option join-points, --join-points)",
               joined, all));
  else if (plan_.everywhere)
    plan_.note("no two points lie at the same place: none was joined");
  else if (joined > 0)
    plan_.note(
        textOf("%llu points were joined with those of other pieces by their %s", joined, by));
  if (kept_apart_ > 0)
    plan_.note(
        textOf("at %llu places pieces are not joined: one of them has several points "
               "with the same %s there",
               static_cast<unsigned long long>(kept_apart_), by));
}

// Of a joined point, what stands there is -1 - another one, which may have been joined later.
int64_t PointJoin::firstOf(int64_t point) {
  for (;;) {
    int64_t number;
    std::memcpy(&number, new_of_.row(static_cast<uint64_t>(point)), sizeof number);
    if (number >= 0) return point;
    point = -1 - number;
  }
}

int64_t PointJoin::newOf(uint64_t point) {
  int64_t number;
  const int64_t first = firstOf(static_cast<int64_t>(point));
  std::memcpy(&number, new_of_.row(static_cast<uint64_t>(first)), sizeof number);
  return number;
}

uint64_t PointJoin::oldOf(uint64_t point) {
  uint64_t old;
  std::memcpy(&old, old_of_.row(point), sizeof old);
  return old;
}

}  // namespace tetstream
