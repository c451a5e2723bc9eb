// measure: two meshes side by side: how well one stands for the other. Depends on mesh_scan.h,
// field_difference.h, boundary_distance.h, cut_image.h.
//
// Each mesh is read once; then their cells and boundaries are compared, in core or, what is larger,
// piece by piece from temporary files.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "boundary_distance.h"
#include "compare_options.h"
#include "cut_image.h"
#include "field_difference.h"
#include "mesh_scan.h"

namespace tetstream {

// What every comparison needs of the caller's options.
struct ComparePlan {
  CompareOptions options;
  std::vector<std::pair<std::string, double>> fields;  // empty: all; weight 0: not compared
  std::string regions = "auto";
  uint64_t seed = 1;
  size_t memory_bytes = 0;
  std::string temp_dir;
};

constexpr size_t kDefaultCompareMemory = size_t{512} << 20;

struct FieldComparison {
  std::string name;
  size_t first = 0, components = 1;
  bool is_finite = true;  // else it is not compared, and the figures below are no numbers
  double range = 0;       // norm of the original's ranges of the components
  double largest = 0, largest_place[3] = {0, 0, 0};
  double largest_inside = 0;  // where the original is inside the simplified mesh
  double unit = 1;            // a power of two near the largest difference of both meshes' values
  double mean_square = 0;     // over the original's volume, in squares of it
  double mean_square_inside = 0;
  double cmse() const;
  double rms() const;
  double rmsInside() const;
  double cpsnr() const;  // decibels; infinite where there is no error, none of a constant field
  double percent(double error) const;  // of the range; of a constant field: the error times 100
  ErrorHistogram histogram;            // volumes
};

struct MeshFigures {
  TopologyFigures topology;
  ShapeFigures shapes;
  double boundary_area = 0;
};

struct RegionComparison {
  int64_t label;
  RegionFigures original, simplified;
  std::string name;  // of the label, if it has one
};

struct FaceLabelComparison {
  int64_t label;
  FaceLabelFigures original, simplified;
  std::string name;
};

// What the picture shows of one field.
struct CutComparison {
  CutPlane plane;
  bool is_whole = true;  // else the simplified mesh goes on where the original's part ends
  std::string field;     // empty: there is none
  size_t components = 1;
  std::vector<double> zero;
  std::unique_ptr<CutImage> original, simplified;
};

class Comparison {
 public:
  // Throws kBadArgument for fields and regions that are not in both meshes.
  Comparison(const Schema& original, const Schema& simplified, const ComparePlan& plan);

  // Throws kBadArgument where none of its cells is of the part that is asked for.
  void readOriginal(Source& source, const Done& done);
  void readSimplified(Source& source, const Done& done);  // then
  // Once both were read. The figures are the same for any number of threads.
  void measure(const Tasks* tasks, const Done& done);

  // Then:
  const MeshFigures& original() const { return figures_[0]; }
  const MeshFigures& simplified() const { return figures_[1]; }
  const Box& box() const { return box_; }  // of the original
  // Of the original, that were compared: all, or those of the part that was asked for.
  uint64_t cellsCompared() const { return cells_compared_; }
  double volumeCompared() const { return volume_compared_; }
  double diagonal() const;
  bool topologyKept() const;
  const std::vector<FieldComparison>& fields() const { return fields_; }
  const FieldComparison* firstField() const;  // that was compared; null if none was
  // Fields that only one of the meshes has, a name a line; none where fields were asked for.
  const std::string& onlyOriginal() const { return only_[0]; }
  const std::string& onlySimplified() const { return only_[1]; }
  const VolumeSums& volumes() const { return volumes_; }
  const DistanceFigures& toSimplified() const { return distances_[0]; }
  const DistanceFigures& toOriginal() const { return distances_[1]; }
  const std::vector<RegionComparison>& regions() const { return regions_; }
  const std::vector<FaceLabelComparison>& faceLabels() const { return face_labels_; }
  const std::string& regionWords() const { return region_words_; }
  const CutComparison* cut() const { return cut_ ? &*cut_ : nullptr; }
  bool isExact() const { return plan_.options.samples == 0; }
  bool isWhole() const { return plan_.options.box.empty(); }
  int64_t samples() const { return plan_.options.samples; }
  int64_t surfaceSamples() const { return plan_.options.surfaceSamples(); }
  size_t peakBytes() const { return account_.peak(); }

 private:
  void matchFields(const Schema& original, const Schema& simplified, ScanPlan plans[2]);
  void findLeftOut();
  void matchRegions(const Schema& original, const Schema& simplified, ScanPlan plans[2]);
  void checkPart();
  void checkExtent() const;
  void findRanges();
  void findRange(FieldComparison& field) const;
  void measureFields(const Tasks* tasks, const Done& done);
  void measureDistances(const Tasks* tasks, const Done& done);
  void compareRegions();
  template <class Pair>
  void nameLabels(std::vector<Pair>& pairs, const std::string& array) const;
  void drawCut();
  void checkCutMeets(const CutComparison& cut) const;

  ComparePlan plan_;
  Box part_;
  size_t memory_;
  Account account_;
  Schema schemas_[2];
  std::vector<FieldComparison> fields_;
  std::string only_[2];
  size_t values_ = 0;                       // of a corner
  std::vector<std::string> region_arrays_;  // candidates
  std::unique_ptr<MeshScan> original_, simplified_;
  MeshFigures figures_[2];
  Box box_;
  uint64_t cells_compared_ = 0;
  double volume_compared_ = 0;
  VolumeSums volumes_;
  DistanceFigures distances_[2];
  std::vector<RegionComparison> regions_;
  std::vector<FaceLabelComparison> face_labels_;
  std::string region_words_;
  std::optional<CutComparison> cut_;
};

}  // namespace tetstream
