// draw: a mesh at some moments of its stream: what was written away, what is in core, what is to
// come. Depends on stream, depth_image.h.
//
// After figure 1 of Vo et al. 2007. At a moment the cells in core are those that were read and
// touch a vertex not yet finalized. The whole mesh and, for each moment, what is not yet written
// away are splatted while the stream passes: memory is that of the images and of the front.
#pragma once

#include <optional>
#include <vector>

#include "depth_image.h"
#include "front_meter.h"

namespace tetstream {

// The eye looks at the box's largest side from a little beside and above, from where the stream's
// first vertex is nearer.
class Eye {
 public:
  // Pixels of an image in which the whole box is seen.
  Eye(const Schema& schema, const double first[3], size_t width, size_t height);
  Seen look(const double position[3]) const;

 private:
  void fit(const double size[3], double width, double height);

  double rows_[3][3] = {}, centre_[3] = {}, middle_[3] = {};
};

class SweepViews {
 public:
  static constexpr size_t kMoments = 4;                 // at 1/5, ... 4/5 of the stream
  static constexpr size_t kWidth = 828, kHeight = 500;  // pixels of an image
  enum Tag : uint8_t { kInCore = 1, kToCome = 2 };

  struct Moment {
    explicit Moment(Account& account) : view(account, kWidth, kHeight) {}
    uint64_t cell = 0;  // that many were read
    uint64_t cells_in_core = 0, vertices_in_core = 0;
    bool passed = false;
    DepthImage view;  // of what is not written away
  };

  // Whether the schema tells what has to be known: the box and the number of cells.
  static bool serves(const Schema& schema);
  explicit SweepViews(const Schema& schema);
  void put(const BatchView& batch);
  void finish();

  const DepthImage& whole() const { return whole_; }
  const std::vector<Moment>& moments() const { return moments_; }

 private:
  struct Cell {
    Seen corners[4];
  };
  void addVertices(const BatchView& batch);
  void dropIntroduced();
  void addCell(const int64_t corners[4], unsigned last_uses);
  void takePlaces(uint64_t first_vertex);
  void passMoments();
  void pass(Moment& moment);

  Account account_;
  FrontMeter meter_;
  Schema schema_;
  std::optional<Eye> eye_;  // once there is a vertex
  Array<Seen> declared_;  // places of vertices from first_declared_ on that were not introduced yet
  uint64_t first_declared_ = 0;
  size_t declared_count_ = 0;
  Array<Seen> places_;  // per row of an active vertex
  Array<Cell> cells_;   // per row of a cell in core
  DepthImage whole_;
  std::vector<Moment> moments_;
};

}  // namespace tetstream
