// Pages as files: complete, readable, and never a part of one under the final name. Where this
// build has no cairo, it says so.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "layout_page.h"
#include "shapes.h"
#include "status.h"
#include "sweep_page.h"

namespace tetstream::test {
namespace {

namespace fs = std::filesystem;

// A folder that is gone at the end.
struct Folder {
  Folder() {
    char name[] = "/tmp/tetstream-page-XXXXXX";
    path = ::mkdtemp(name);
  }
  ~Folder() { fs::remove_all(path); }
  std::string at(const char* name) const { return (path / name).string(); }
  bool empty() const { return fs::is_empty(path); }
  fs::path path;
};

LayoutDiagram& readInto(LayoutDiagram& diagram, const TestMesh& mesh) {
  MeshStream stream(mesh, {});
  BatchView batch;
  while (stream.next(batch)) diagram.put(batch);
  diagram.finish();
  return diagram;
}

void drawOf(const TestMesh& mesh, const std::string& path, const std::string& title = "mesh",
            size_t size = 50) {
  LayoutDiagram diagram(mesh.schema, size, size);
  drawLayout(path, readInto(diagram, mesh), title);
}

Status statusOf(const std::function<void()>& body, const char* says) {
  try {
    body();
  } catch (const Error& error) {
    EXPECT_NE(error.text().find(says), std::string::npos) << error.text();
    return error.status();
  }
  return Status::kOk;
}

#ifdef TETSTREAM_WITH_CAIRO

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream all;
  all << file.rdbuf();
  return all.str();
}

void expectSvg(const std::string& path) {
  const std::string text = bytesOf(path), end = "</svg>\n";
  EXPECT_EQ(text.substr(0, 5), "<?xml");
  ASSERT_GT(text.size(), end.size());
  EXPECT_EQ(text.substr(text.size() - end.size()), end);
}

void expectPng(const std::string& path) {
  const std::string bytes = bytesOf(path);
  ASSERT_GT(bytes.size(), 100u);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
}

TEST(LayoutPage, IsWrittenAsItsExtensionSays) {
  const Folder folder;
  const TestMesh mesh = inStreamOrder(shuffled(fullGrid(3, 2, 2), 1));
  drawOf(mesh, folder.at("a.svg"));
  expectSvg(folder.at("a.svg"));
  drawOf(mesh, folder.at("a.PNG"));
  expectPng(folder.at("a.PNG"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 2);  // no temporary ones
}

TEST(LayoutPage, IsDrawnOfAnySizeAndTitle) {
  const Folder folder;
  const std::vector<size_t> sizes =
      slowRun() ? std::vector<size_t>{3} : std::vector<size_t>{1, 3, 2000};
  std::vector<TestMesh> meshes = {makeMesh(ScalarType::kFloat64, {}, {})};
  if (!slowRun()) meshes.insert(meshes.end(), {oneCell(), cubesAtVertex(1)});
  for (const TestMesh& mesh : meshes)
    for (size_t size : sizes) {
      drawOf(mesh, folder.at("a.svg"), "", size);
      expectSvg(folder.at("a.svg"));
      drawOf(mesh, folder.at("a.png"), "<&>\"\xff\n" + std::string(3000, 'w') + "\xc3\xa9.vtu",
             size);
      expectPng(folder.at("a.png"));
    }
}

// The last line that is drawn can be found again: what is dark in the picture is the raster.
TEST(LayoutPage, HoldsTheRasterAsOneImage) {
  const Folder folder;
  drawOf(fullGrid(2, 2, 2), folder.at("a.svg"));
  const std::string text = bytesOf(folder.at("a.svg"));
  const size_t image = text.find("<image");
  ASSERT_NE(image, std::string::npos);
  EXPECT_EQ(text.find("<image", image + 1), std::string::npos);
}

TEST(SweepPage, IsWrittenWithAnImageForEachMoment) {
  const Folder folder;
  const TestMesh mesh = fullGrid(4, 2, 2);
  Cut cut;
  cut.say_box = true;
  MeshStream stream(mesh, cut);
  SweepViews views(stream.schema());
  LayoutDiagram diagram(stream.schema(), 10, 10);
  BatchView batch;
  while (stream.next(batch)) {
    views.put(batch);
    diagram.put(batch);
  }
  views.finish();
  diagram.finish();
  drawSweep(folder.at("a.svg"), views, diagram.figures(), "mesh");
  expectSvg(folder.at("a.svg"));
  const std::string text = bytesOf(folder.at("a.svg"));
  size_t images = 0;
  for (size_t at = text.find("<image"); at != std::string::npos; at = text.find("<image", at + 1))
    ++images;
  EXPECT_EQ(images, SweepViews::kMoments);
  drawSweep(folder.at("a.png"), views, diagram.figures(), "mesh");
  expectPng(folder.at("a.png"));
}

TEST(Picture, NeedsAKnownExtension) {
  const Folder folder;
  for (const char* name : {"a", "a.gif", "svg", ".svg", "a.svg.gz", "apng"})
    EXPECT_EQ(statusOf([&] { drawOf(oneCell(), folder.at(name)); }, ".svg or .png"),
              *name == '.' ? Status::kOk : Status::kUnsupported)
        << name;
}

TEST(Picture, LeavesNothingAfterAFailure) {
  const Folder folder;
  EXPECT_EQ(statusOf([&] { drawOf(oneCell(), folder.at("absent/a.svg")); }, "absent"), Status::kIo);
  const auto stop = [](Canvas& canvas) {
    canvas.fill(Frame{0, 0, 5, 5}, kWhite);
    fail(Status::kCancelled, "stop here");
  };
  for (const char* name : {"a.svg", "a.png"})
    EXPECT_EQ(statusOf([&] { drawPicture(folder.at(name), 10, 10, stop); }, "stop here"),
              Status::kCancelled);
  EXPECT_TRUE(folder.empty());
}

// A full disk is told by the system's word, while the picture is written.
TEST(Picture, TellsThatTheDiskIsFull) {
  struct stat info;
  ASSERT_EQ(::stat("/dev/full", &info), 0);
  const Folder folder;
  for (const char* name : {"a.svg", "a.png"}) {
    ASSERT_EQ(::symlink("/dev/full", folder.at(name).c_str()), 0);
    EXPECT_EQ(statusOf([&] { drawOf(fullGrid(2, 2, 2), folder.at(name)); }, "write"), Status::kIo);
  }
}

#else

TEST(Picture, SaysThatThisBuildDrawsNone) {
  const Folder folder;
  EXPECT_EQ(statusOf([&] { drawOf(oneCell(), folder.at("a.svg")); }, "cairo"),
            Status::kUnsupported);
  EXPECT_EQ(statusOf([&] { checkPicture("a.png"); }, "cairo"), Status::kUnsupported);
  EXPECT_TRUE(folder.empty());
}

#endif

}  // namespace
}  // namespace tetstream::test
