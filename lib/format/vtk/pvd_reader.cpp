// Reads .pvd files, which name the .vtu and .pvtu files of each time step: those of one step are
// pieces. Points that pieces share are one each.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "file_pool.h"
#include "pieced_mesh.h"
#include "status.h"
#include "text_number.h"
#include "time_steps.h"
#include "vtk_format.h"
#include "vtu_pieces.h"
#include "xml_feed.h"

namespace tetstream {

namespace {

struct StepFile {
  std::string name;
  double time = 0;
  bool is_told = false;
};

class StepFiles final : XmlFeed {
 public:
  explicit StepFiles(ByteSource& bytes) : XmlFeed(bytes) {}

  std::vector<StepFile> run() {
    feed();
    return std::move(files_);
  }

 private:
  void start(const char* name, Attributes attributes) override {
    if (depth_ == 0) checkRoot(name, attributes);
    if (depth_ == 2 && std::strcmp(name, "DataSet") == 0) add(attributes);
    ++depth_;
  }
  void end() override { --depth_; }

  void checkRoot(const char* name, Attributes attributes) const {
    const char* type = find(attributes, "type");
    if (std::strcmp(name, "VTKFile") != 0 || !type || std::strcmp(type, "Collection") != 0)
      failHere("this is no collection of VTK's files");
  }

  void add(Attributes attributes) {
    constexpr size_t kMaxFiles = 1 << 20;
    const char *file = find(attributes, "file"), *timestep = find(attributes, "timestep");
    if (!file || !*file) failHere("a DataSet has no file");
    if (files_.size() == kMaxFiles) failHere("too many files", Status::kUnsupported);
    StepFile row = {file};
    if (timestep) {
      row.time = realIn(timestep).value_or(std::nan(""));
      if (std::isnan(row.time)) failHere("a timestep is no number");
      row.is_told = true;
    }
    files_.push_back(std::move(row));
  }

  std::vector<StepFile> files_;
  int depth_ = 0;
};

}  // namespace

Input openPvd(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  bytes = makeSeekable(std::move(bytes), options.temp_dir);
  const std::vector<StepFile> files = StepFiles(*bytes).run();
  MeshPieces mesh;
  mesh.name = bytes->name();
  mesh.join = true;
  std::vector<double> times;
  times.reserve(files.size());
  for (const StepFile& file : files) times.push_back(file.time);
  const bool are_told =
      std::any_of(files.begin(), files.end(), [](const StepFile& file) { return file.is_told; });
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  if (times.empty()) fail(Status::kBadData, "%s: there is no <DataSet>", mesh.name.c_str());
  const double time =
      times[static_cast<size_t>(chooseStep(mesh, times.size(), options, [&](uint64_t step) {
        return are_told ? std::optional(times[static_cast<size_t>(step)]) : std::nullopt;
      }))];
  ReadOptions of_file = options;
  of_file.step = kLastStep;  // of those within a file: the one that was asked for is of the files
  const auto pool = std::make_shared<FilePool>(options.temp_dir, true);
  for (const StepFile& file : files) {
    if (file.time != time) continue;
    const std::string path = pathBeside(bytes->name(), file.name);
    if (file.name.ends_with(".pvtu"))
      addPvtuPieces(mesh, *pool, *openFile(path), of_file);
    else
      addVtuPieces(mesh, pool->add(path), of_file);
  }
  mesh.name = bytes->name();
  return openPiecedMesh(std::move(mesh), options);
}

}  // namespace tetstream
