#include "medit_sol.h"

#include <sys/stat.h>

#include "compressed_bytes.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr int64_t kMostSolutions = 256;

// Numbers of a value of type 1 to 4: a scalar, a vector, a symmetric and a full matrix.
constexpr int kComponents[] = {0, 1, 3, 6, 9};

std::vector<int> readTypes(MeditScan& scan) {
  const int64_t count = scan.small("the number of solutions");
  if (count < 1 || count > kMostSolutions)
    scan.file().failBad(textOf("%lld solutions; there may be 1 to %lld",
                               static_cast<long long>(count),
                               static_cast<long long>(kMostSolutions)));
  std::vector<int> components;
  for (int64_t i = 0; i < count; ++i) {
    const int64_t type = scan.small("the type of a solution");
    if (type < 1 || type > 4)
      scan.file().failBad(textOf("a solution of type %lld", static_cast<long long>(type)));
    components.push_back(kComponents[type]);
  }
  return components;
}

struct ReadSolution {
  size_t data, start, components;  // start: in a row
  bool isSymmetric() const { return components == 6; }
};

// Whether the rows can be read where they lie.
bool place(MeditScan& scan, MeshIntake& intake, const std::vector<ReadSolution>& solutions,
           uint64_t count, size_t width) {
  for (const ReadSolution& s : solutions)
    if (s.isSymmetric()) return false;
  const auto rows = scan.rowsHere(count, 0, width);
  if (!rows) return false;
  const auto window = std::make_shared<FileWindow>(rows->file);
  for (const ReadSolution& s : solutions) {
    NumbersOfRow reals = scan.realsOfRow(0, s.components);
    reals.at_byte = s.start * reals.width;
    intake.placeData(s.data, *rows, reals, window);
  }
  scan.pass(*rows, "the values of a solution");
  return true;
}

void put(MeshIntake& intake, const ReadSolution& s, uint64_t row, const double* values) {
  if (!s.isSymmetric()) return intake.putData(s.data, row, values);
  double in_order[6];
  for (int k = 0; k < 6; ++k) in_order[k] = values[kMeditSymmetric[k]];
  intake.putData(s.data, row, in_order);
}

}  // namespace

void MeditSolutions::read(MeditScan& scan, MeshIntake& intake, const MeditRows& rows,
                          bool of_cells) {
  const uint64_t wanted = of_cells ? rows.tetrahedra : rows.points;
  const uint64_t count = scan.rows(0, 1, "the number of values");
  if (count != wanted)
    scan.file().failBad(textOf("%llu values for %llu %s", static_cast<unsigned long long>(count),
                               static_cast<unsigned long long>(wanted),
                               of_cells ? "tetrahedra" : "vertices"));
  const ScalarType type = scan.version() == 1 ? ScalarType::kFloat32 : ScalarType::kFloat64;
  size_t& number = of_cells ? cell_data_ : fields_;
  size_t width = 0;
  std::vector<ReadSolution> solutions;
  for (int components : readTypes(scan)) {
    const std::string name = "sol" + (number == 0 ? "" : std::to_string(number));
    solutions.push_back({intake.addData({name, components, type}, of_cells), width,
                         static_cast<size_t>(components)});
    width += static_cast<size_t>(components);
    ++number;
  }
  const uint64_t first = of_cells ? rows.first_tetrahedron : 0;
  if (first == 0 && place(scan, intake, solutions, count, width)) return;
  std::vector<double> values(width);
  scan.expectRows(count, {{{true, width}}});
  for (uint64_t i = 0; i < count; ++i) {
    scan.reals(values.data(), width, "a value of a solution");
    for (const ReadSolution& s : solutions) put(intake, s, first + i, values.data() + s.start);
  }
}

void MeditSolutions::readFile(MeditScan& scan, MeshIntake& intake, const MeditRows& rows) {
  for (MeditSection section; scan.next(&section);) {
    if (section.number == kMeditDimension) {
      const int64_t dimension = scan.small("the dimension");
      if (dimension != 3)
        scan.file().failHere(Status::kUnsupported, textOf("dimension %lld; only 3 is read",
                                                          static_cast<long long>(dimension)));
    } else if (section.number == kMeditSolAtVertices || section.number == kMeditSolAtTetrahedra) {
      read(scan, intake, rows, section.number == kMeditSolAtTetrahedra);
    } else {
      intake.note("of " + scan.file().name() + " the section " + section.name + " is left out");
      scan.skip();
    }
  }
  if (!scan.saysEnd()) intake.note(scan.file().name() + " " + kNoEnd);
}

bool exists(const std::string& path) {
  struct stat info;
  return ::stat(path.c_str(), &info) == 0;
}

std::string withExtension(const std::string& path, const char* extension) {
  const size_t slash = path.find_last_of('/');
  const size_t dot = path.find_last_of('.');
  const bool has = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  return path.substr(0, has ? dot : path.size()) + extension;
}

std::unique_ptr<ByteSource> openMeditSolution(const std::string& mesh_path) {
  const bool binary =
      mesh_path.size() > 6 && mesh_path.compare(mesh_path.size() - 6, 6, ".meshb") == 0;
  for (const char* extension : {binary ? ".solb" : ".sol", binary ? ".sol" : ".solb"}) {
    const std::string path = withExtension(mesh_path, extension);
    if (exists(path)) return unwrapped(openFile(path));
  }
  return nullptr;
}

}  // namespace tetstream
