// Reads .pvtu files: the names of the .vtu files whose pieces make the mesh, beside the file itself
// or below. Points that pieces share are one each.
#include <cstring>

#include "file_pool.h"
#include "pieced_mesh.h"
#include "vtk_format.h"
#include "vtu_pieces.h"
#include "xml_feed.h"

namespace tetstream {

namespace {

class PieceNames final : XmlFeed {
 public:
  explicit PieceNames(ByteSource& bytes) : XmlFeed(bytes) {}

  std::vector<std::string> run() {
    feed();
    return std::move(names_);
  }

 private:
  void start(const char* name, Attributes attributes) override {
    if (depth_ == 0) checkRoot(name, attributes);
    if (depth_ == 2 && std::strcmp(name, "Piece") == 0) {
      const char* source = find(attributes, "Source");
      if (!source || !*source) failHere("a piece has no Source");
      if (names_.size() == kMaxMeshPieces) failHere("too many pieces", Status::kUnsupported);
      names_.push_back(source);
    }
    ++depth_;
  }
  void end() override { --depth_; }

  void checkRoot(const char* name, Attributes attributes) const {
    const char* type = find(attributes, "type");
    if (std::strcmp(name, "VTKFile") != 0)
      failHere("this is not a VTK XML file: it begins with <" + cutName(name) + ">");
    if (!type || std::strcmp(type, "PUnstructuredGrid") != 0)
      failHere("the file holds \"" + cutName(type ? type : "") + "\", no PUnstructuredGrid",
               Status::kUnsupported);
  }

  std::vector<std::string> names_;
  int depth_ = 0;
};

}  // namespace

void addPvtuPieces(MeshPieces& mesh, FilePool& pool, ByteSource& bytes,
                   const ReadOptions& options) {
  for (const std::string& name : PieceNames(bytes).run())
    addVtuPieces(mesh, pool.add(pathBeside(bytes.name(), name)), options);
}

Input openPvtu(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  bytes = makeSeekable(std::move(bytes), options.temp_dir);
  const auto pool = std::make_shared<FilePool>(options.temp_dir, true);
  MeshPieces mesh;
  mesh.join = true;
  addPvtuPieces(mesh, *pool, *bytes, options);
  mesh.name = bytes->name();
  if (mesh.pieces.empty()) fail(Status::kBadData, "%s: there is no <Piece>", mesh.name.c_str());
  return openPiecedMesh(std::move(mesh), options);
}

}  // namespace tetstream
