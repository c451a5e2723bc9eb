// Reads SU2's meshes: text of NAME= sections. Points are numbered from 0 in their order; markers
// label faces, from 1 in their order, and name the labels; zones label cells.
#include <algorithm>
#include <map>

#include "file_scan.h"
#include "mesh_intake.h"
#include "status.h"
#include "su2_format.h"
#include "text_number.h"
#include "vtk_cells.h"

namespace tetstream {

namespace {

constexpr const char* kZone = "zone";
constexpr size_t kLeastBytes = 4;  // of an element or a point: two numbers with ends

// The numbers are VTK's of its linear cells.
const CellKind* kindOf(int64_t type) {
  const VtkCell& cell = vtkCell(type);
  const bool linear = cell.fate == VtkCell::kKnown && cell.kind.nodes == cornersOf(cell.kind.shape);
  return linear && !hasRowCorners(type) ? &cell.kind : nullptr;
}

class Su2Reader {
 public:
  Su2Reader(std::unique_ptr<ByteSource> bytes, const ReadOptions& options)
      : file_(std::move(bytes), '%', options.threads),
        intake_(file_, options, ScalarType::kFloat64) {
    intake_.addLabels(kZone);
  }

  std::unique_ptr<IndexedSource> read() {
    for (;;) {
      std::string name(file_.word());
      if (name.empty()) break;
      readSection(takeName(std::move(name)));
    }
    if (!any_points_) file_.failBad("there is no section NPOIN=");
    nameMarkers();
    return intake_.finish();
  }

 private:
  // "NAME=", "NAME= 3", "NAME =3" and "NAME=3" are the same; what follows is kept for count().
  std::string takeName(std::string word) {
    size_t equals = word.find('=');
    if (equals == word.npos) {
      const std::string next(file_.word());
      if (next.empty() || next[0] != '=') file_.failBad(quoted(word) + " where NAME= should be");
      value_ = next.substr(1);
      return word;
    }
    value_ = word.substr(equals + 1);
    word.resize(equals);
    return word;
  }

  int64_t integer(const char* what) {
    if (value_.empty()) return file_.integer(what);
    int64_t value;
    if (!parseInteger(value_, &value))
      file_.failBad(quoted(value_) + " is no number; " + what + " should be here");
    return value;
  }

  uint64_t count(const char* what) {
    const int64_t found = integer(what);
    if (found < 0) file_.failBad(std::string(what) + " is below 0");
    file_.checkClaim(static_cast<uint64_t>(found), kLeastBytes, what);
    file_.line();  // a second number of older files
    return static_cast<uint64_t>(found);
  }

  void readSection(const std::string& name) {
    if (name == "NDIME") {
      const int64_t dimension = integer("the dimension");
      if (dimension != 3)
        file_.failHere(Status::kUnsupported,
                       textOf("dimension %lld; only 3 is read", static_cast<long long>(dimension)));
    } else if (name == "NZONE" || name == "NMARK") {
      integer("a number");
    } else if (name == "IZONE") {
      beginZone(integer("the number of a zone"));
    } else if (name == "NELEM") {
      readElements();
    } else if (name == "NPOIN") {
      readPoints();
    } else if (name == "MARKER_TAG") {
      readMarker();
    } else {
      leaveOut(name);
    }
  }

  // Boxes for shape optimisation have so many rows, which may begin with the names of markers; of
  // other sections rows of numbers are passed over.
  void leaveOut(const std::string& name) {
    if (name.rfind("FFD_", 0) == 0) {
      intake_.leaveOut("sections of boxes for shape optimisation (FFD_)");
      const bool has_rows = name.size() > 7 && name.compare(name.size() - 7, 7, "_POINTS") == 0;
      if (!has_rows) file_.line();
      for (uint64_t rows = has_rows ? count("the rows of a box") : 0; rows > 0; --rows)
        file_.line();
      return;
    }
    intake_.note("what " + name + "= says is left out");
    for (;;) {
      file_.line();
      const std::string_view word = file_.peekWord();
      if (word.empty() || std::string_view("+-.0123456789").find(word[0]) == word.npos) return;
    }
  }

  // The cells of a zone use points of that zone, which follow.
  void beginZone(int64_t zone) {
    zone_ = zone;
    first_point_ = static_cast<int64_t>(intake_.mesh().pointCount());
    zone_points_ = -1;
  }

  int64_t corner(int64_t point) {
    if (zone_points_ >= 0 && point >= zone_points_)
      file_.failBad(textOf("point %lld, where there are %lld", static_cast<long long>(point),
                           static_cast<long long>(zone_points_)));
    largest_ = std::max(largest_, point);
    return first_point_ + point;
  }

  const CellKind& readRow(int64_t* corners) {
    int64_t type;
    file_.integers(&type, 1, "the type of an element");
    const CellKind* kind = kindOf(type);
    if (!kind)
      file_.failHere(Status::kUnsupported, textOf("an element of type %lld, which is not known",
                                                  static_cast<long long>(type)));
    file_.integers(corners, static_cast<size_t>(kind->nodes), "a point of an element", 0,
                   INT64_MAX / 2);
    for (int k = 0; k < kind->nodes; ++k) corners[k] = corner(corners[k]);
    orderVtkCorners(type, corners);
    return *kind;
  }

  // The points of an element of that type.
  static size_t pointsOf(int64_t type) {
    const CellKind* kind = kindOf(type);
    return kind ? static_cast<size_t>(kind->nodes) : SIZE_MAX;
  }

  void readElements() {
    const uint64_t elements = count("the number of elements");
    file_.expectRows(elements, {{{false, 1}}, pointsOf, true});
    int64_t corners[8];
    for (uint64_t i = 0; i < elements; ++i) {
      const CellKind& kind = readRow(corners);
      if (dimensionOf(kind.shape) == 3)
        intake_.addCell(kind, corners, &zone_, static_cast<int64_t>(i));
      else
        intake_.leaveOut("elements of a lower dimension among the cells");
      file_.passLine();  // its number
    }
  }

  void readPoints() {
    const uint64_t points = count("the number of points");
    file_.expectRows(points, {{{true, 3}}, nullptr, true});
    for (uint64_t i = 0; i < points; ++i) {
      double position[3];
      file_.reals(position, 3, "the position of a point");
      intake_.addPoint(position);
      file_.passLine();  // its number
    }
    any_points_ = true;
    zone_points_ = static_cast<int64_t>(points);
    if (largest_ >= zone_points_)
      file_.failBad(textOf("an element before uses point %lld, but there are %lld",
                           static_cast<long long>(largest_), static_cast<long long>(zone_points_)));
    largest_ = -1;
  }

  // Markers of one name, in several zones, have one label.
  void readMarker() {
    const std::string name(value_.empty() ? std::string(file_.word()) : value_);
    if (name.empty()) file_.failBad("a marker without a name");
    file_.line();
    const std::string next = takeName(std::string(file_.word()));
    if (next != "MARKER_ELEMS") file_.failBad(quoted(next) + " where MARKER_ELEMS= should be");
    const int64_t label =
        markers_.emplace(name, static_cast<int64_t>(markers_.size() + 1)).first->second;
    const uint64_t elements = count("the number of a marker's elements");
    int64_t corners[8];
    for (uint64_t i = 0; i < elements; ++i) {
      if (file_.peekWord().find('=') != std::string_view::npos) {
        if (i == 0) return skipSendReceive();
        file_.failBad("a marker has fewer elements than it says");
      }
      const CellKind& kind = readRow(corners);
      if (dimensionOf(kind.shape) == 2)
        intake_.addFace(kind, corners, label);
      else
        intake_.leaveOut("elements of markers that are no faces");
      file_.line();
    }
  }

  // A marker SEND_RECEIVE names points of another part of the mesh.
  void skipSendReceive() {
    file_.line();
    intake_.leaveOut("markers between parts");
    while (!file_.peekWord().empty() && file_.peekWord().find('=') == std::string_view::npos)
      file_.line();
  }

  void nameMarkers() {
    std::vector<LabelName> names;
    for (const auto& [name, label] : markers_) names.push_back({"", label, name});
    intake_.nameLabels(std::move(names));
  }

  FileScan file_;
  MeshIntake intake_;
  std::string value_;  // what stood behind NAME=
  std::map<std::string, int64_t> markers_;
  int64_t zone_ = 0, first_point_ = 0, zone_points_ = -1, largest_ = -1;
  bool any_points_ = false;
};

}  // namespace

Input openSu2(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  Input input;
  input.indexed = Su2Reader(std::move(bytes), options).read();
  return input;
}

}  // namespace tetstream
