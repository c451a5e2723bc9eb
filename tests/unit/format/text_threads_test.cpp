// Rows of text that several threads read: the same mesh, and of what is wrong the same sentence,
// for any number of threads and wherever the text is cut.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "file_scan.h"
#include "gmsh_format.h"
#include "medit_format.h"
#include "su2_format.h"
#include "tetgen_format.h"
#include "text_threads_testing.h"

namespace tetstream {
namespace {

using namespace test;

std::string meshText() {
  Words w;
  std::string text = textOf("MeshVersionFormatted 2\nDimension 3\nVertices %d\n", kPoints);
  for (int i = 0; i < kPoints; ++i) text += w.reals(3) + w.label() + "\n";
  text += textOf("Tetrahedra %d\n", kCells);
  for (int i = 0; i < kCells; ++i) text += w.corners(1, 4) + w.label() + "\n";
  text += textOf("Triangles %d\n", kCells);
  for (int i = 0; i < kCells; ++i) text += w.corners(1, 3) + w.label() + "\n";
  text += textOf("SolAtVertices %d\n2 1 2\n", kPoints);
  for (int i = 0; i < kPoints; ++i) text += w.reals(4) + "\n";
  return text + "End\n";
}

std::string msh2Text() {
  Words w;
  std::string text = textOf("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n", kPoints);
  for (int i = 0; i < kPoints; ++i) text += std::to_string(i + 3) + " " + w.reals(3) + "\n";
  text += textOf("$EndNodes\n$Elements\n%d\n", 2 * kCells);
  for (int i = 0; i < kCells; ++i)
    text += textOf("%d 2 1 7 ", i) + w.corners(3, 3) + "\n" + textOf("%d 4 3 1 2 3 ", kCells + i) +
            w.corners(3, 4) + "\n";
  text += textOf("$EndElements\n$NodeData\n1\n\"f\"\n1\n0.0\n3\n0\n3\n%d\n", kPoints);
  for (int i = 0; i < kPoints; ++i) text += std::to_string(i + 3) + " " + w.reals(3) + "\n";
  return text + "$EndNodeData\n";
}

std::string msh4Text() {
  Words w;
  std::string text =
      textOf("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 %d 1 %d\n", kPoints, kPoints);
  for (int block = 0; block < 2; ++block) {
    text += textOf("3 1 0 %d\n", kPoints / 2);
    for (int i = 0; i < kPoints / 2; ++i)
      text += std::to_string(block * kPoints / 2 + i + 1) + "\n";
    for (int i = 0; i < kPoints / 2; ++i) text += w.reals(3) + "\n";
  }
  text += textOf("$EndNodes\n$Elements\n2 %d 1 %d\n3 1 4 %d\n", 2 * kCells, 2 * kCells, kCells);
  for (int i = 0; i < kCells; ++i) text += std::to_string(i + 1) + " " + w.corners(1, 4) + "\n";
  text += textOf("2 5 2 %d\n", kCells);
  for (int i = 0; i < kCells; ++i)
    text += std::to_string(kCells + i + 1) + " " + w.corners(1, 3) + "\n";
  return text + "$EndElements\n";
}

std::string su2Text() {
  Words w;
  std::string text = textOf("NDIME= 3\nNELEM= %d\n", kCells);
  for (int i = 0; i < kCells; ++i)
    text += (i % 9 == 4 ? "5 " + w.corners(0, 3) : "10 " + w.corners(0, 4)) + std::to_string(i) +
            " and words\n";
  text += textOf("NPOIN= %d\n", kPoints);
  for (int i = 0; i < kPoints; ++i) text += w.reals(3) + std::to_string(i) + "\n";
  text += textOf("NMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= %d\n", kCells);
  for (int i = 0; i < kCells; ++i) text += "5 " + w.corners(0, 3) + "\n";
  return text;
}

std::string nodeText() {
  Words w;
  std::string text = textOf("%d 3 2 1\n", kPoints);
  for (int i = 0; i < kPoints; ++i)
    text += std::to_string(i + 1) + " " + w.reals(5) + w.label() + "\n";
  return text;
}

std::string eleText() {
  Words w;
  std::string text = textOf("%d 4 1\n", kCells);
  for (int i = 0; i < kCells; ++i)
    text += std::to_string(i + 1) + " " + w.corners(1, 4) + w.label() + "\n";
  return text;
}

std::string faceText() {
  Words w;
  std::string text = textOf("%d 1\n", kCells);
  for (int i = 0; i < kCells; ++i)
    text += std::to_string(i + 1) + " " + w.corners(1, 3) + w.label() + " -1 9\n";
  return text;
}

const TextFormat kTextFormats[] = {{"mesh", openMedit, meshText(), '#'},
                                   {"msh 2.2", openMsh, msh2Text()},
                                   {"msh 4.1", openMsh, msh4Text()},
                                   {"su2", openSu2, su2Text(), '%'}};

// --------------------------------------------------------------------------------------- the tests

TEST(TextThreads, GiveTheMeshOfOneThreadWhereverTheTextIsCut) {
  for (const TextFormat& format : kTextFormats) {
    SCOPED_TRACE(format.name);
    const std::string mesh = outcomeOf(format.opening());
    EXPECT_NE(mesh.substr(0, 6), "error:") << mesh.substr(0, 200);
    for (size_t bytes = 8; bytes < 200; bytes += 5)
      EXPECT_TRUE(outcomeOf(format.opening(),
                            {someTasks()[bytes % someTasks().size()].get(), bytes}) == mesh)
          << bytes;
    EXPECT_EQ(expectSame(format.opening(), {40, 1000, 100000}).size(), mesh.size());
  }
}

TEST(TextThreads, KnowEveryWayToEndALine) {
  for (const TextFormat& format : kTextFormats) {
    SCOPED_TRACE(format.name);
    const std::string mesh = outcomeOf(format.opening());
    std::vector<std::string> lines = linesOf(format.text);
    const auto same = [&](const std::string& text) {
      EXPECT_TRUE(expectSame(opening(format.open, text), {30, 64, 300}) == mesh);
    };
    same(joined(lines, "\r\n"));
    same(format.text.substr(0, format.text.size() - 1));
    same(joined(lines, " \t\n"));
    if (std::strcmp(format.name, "su2") != 0) same(joined(lines, "\n\n"));
    if (format.comment == 0) continue;
    const std::string comment(1, format.comment);
    std::vector<std::string> remarked;
    for (const std::string& line : lines) {
      remarked.push_back(line + (line.find('=') == line.npos ? " " + comment + " 1 2 3 4 5" : ""));
      remarked.push_back(comment + "10 1 2 3 4 0 \r");
    }
    same(joined(remarked, "\n"));
  }
}

// Rows need not stand in lines of their own, where the rest of a line means nothing.
TEST(TextThreads, ReadRowsThatShareLinesOrRunOverSeveral) {
  for (const TextFormat& format : kTextFormats) {
    if (std::strcmp(format.name, "su2") == 0) continue;
    SCOPED_TRACE(format.name);
    const std::string mesh = outcomeOf(format.opening());
    std::string one_line = format.text, short_lines = format.text;
    std::replace(one_line.begin() + 60, one_line.end(), '\n', ' ');
    std::replace(short_lines.begin() + 60, short_lines.end(), ' ', '\n');
    EXPECT_TRUE(expectSame(opening(format.open, one_line), {30, 300}) == mesh);
    EXPECT_TRUE(expectSame(opening(format.open, short_lines), {30, 300}) == mesh);
  }
}

TEST(TextThreads, FindTheFirstBadLineOfOneThread) {
  for (const TextFormat& format : kTextFormats) {
    SCOPED_TRACE(format.name);
    const std::vector<std::string> lines = linesOf(format.text);
    size_t errors = 0, tried = 0;
    for (size_t i = 2; i < lines.size(); i += 7 * oneIn(3), ++tried) {
      std::vector<std::string> damaged = lines;
      damaged[i] = kDamages[tried % std::size(kDamages)](lines[i]);
      if (i + 20 < lines.size()) damaged[i + 20] = "y" + lines[i + 20];  // and one that comes later
      SCOPED_TRACE(damaged[i].substr(0, 60));
      errors += expectSame(opening(format.open, joined(damaged, "\n")), {50, 200})
                    .starts_with("error: mesh: line");
    }
    EXPECT_GT(errors, tried / 2);
  }
}

TEST(TextThreads, StopWhereATextIsCutOff) {
  expectSameWhereverCutOff(kTextFormats);
}

// Bytes that cannot be read from some place on.
class FailingBytes final : public ByteSource {
 public:
  FailingBytes(std::string text, size_t fails_at)
      : ByteSource("mesh"), text_(std::move(text)), fails_at_(fails_at) {}
  size_t read(void* out, size_t size) override {
    if (at_ >= fails_at_) fail(Status::kIo, "mesh: the disk is broken");
    const size_t n = std::min({size, fails_at_ - at_, size_t{37}});
    std::memcpy(out, text_.data() + at_, n);
    at_ += n;
    return n;
  }
  size_t readAt(uint64_t, void*, size_t) override { return 0; }
  bool seekable() const override { return true; }
  uint64_t size() const override { return text_.size(); }

 private:
  std::string text_;
  size_t fails_at_, at_ = 0;
};

TEST(TextThreads, SayThatReadingFailedOnlyAfterWhatIsWrongBefore) {
  for (const TextFormat& format : kTextFormats) {
    SCOPED_TRACE(format.name);
    const size_t place = format.text.size() * 3 / 4;
    std::string damaged = format.text;
    damaged.insert(format.text.rfind('\n', place - 1500) + 1, "?");
    const std::string whats_wrong = outcomeOf(opening(format.open, damaged));
    for (size_t fails_at = place; fails_at < place + 30; fails_at += 3)
      for (const std::string& text : {format.text, damaged}) {
        const OpenIt open = [&](const ReadOptions& options) {
          return format.open(std::make_unique<FailingBytes>(text, fails_at), options);
        };
        EXPECT_EQ(expectSame(open, {150}),
                  text == damaged ? whats_wrong : "error: mesh: the disk is broken");
      }
  }
}

TEST(TextThreads, NeedNobodyWhoComes) {
  expectSameWhoeverComes(kTextFormats);
}

// A long text, of which it is known how far it was read.
class CountedBytes final : public ByteSource {
 public:
  CountedBytes(uint64_t size, uint64_t* at) : ByteSource("mesh"), size_(size), at_(at) {}
  size_t read(void* out, size_t size) override {
    const auto n = static_cast<size_t>(std::min<uint64_t>(size, size_ - *at_));
    for (size_t i = 0; i < n; ++i) static_cast<char*>(out)[i] = "17 4.5\n "[(*at_ + i) % 8];
    *at_ += n;
    return n;
  }
  size_t readAt(uint64_t, void*, size_t) override { return 0; }
  bool seekable() const override { return true; }
  uint64_t size() const override { return size_; }

 private:
  uint64_t size_, *at_;
};

TEST(TextThreads, ReadSomePiecesAheadAndNoMore) {
  constexpr uint64_t kRows = 50000, kPieceBytes = 1000;
  for (const auto& tasks : someTasks()) {
    uint64_t read = 0;
    FileScan scan(std::make_unique<CountedBytes>(8 * kRows, &read), '#',
                  {tasks.get(), kPieceBytes});
    scan.expectRows(kRows, {{{false, 1}, {true, 1}}});
    for (uint64_t i = 0; i < kRows; ++i) {
      int64_t whole;
      double real;
      scan.integers(&whole, 1, "a number");
      scan.reals(&real, 1, "a number");
      ASSERT_TRUE(whole == 17 && real == 4.5);
      ASSERT_LE(read, 8 * i + (2 * tasks->threads() + 1) * kPieceBytes);
      if (i % 1000 == 0) {
        EXPECT_EQ(scan.offset(), 8 * i + 6);
        EXPECT_EQ(scan.place(), "mesh: line " + std::to_string(i + 1));
      }
    }
    EXPECT_TRUE(scan.word().empty());
    EXPECT_EQ(read, 8 * kRows);
  }
}

class TetgenThreads : public testing::Test {
 protected:
  TetgenThreads() : folder_(std::filesystem::temp_directory_path() / "tetstream_threads.XXXXXX") {
    EXPECT_NE(::mkdtemp(folder_.data()), nullptr);
  }
  ~TetgenThreads() override { std::filesystem::remove_all(folder_); }
  // Any of the three may be another one.
  std::string expectSameOf(const std::string& node, const std::string& ele,
                           const std::string& face) {
    const std::pair<const char*, const std::string*> files[] = {
        {"/m.node", &node}, {"/m.ele", &ele}, {"/m.face", &face}};
    for (const auto& [name, text] : files) std::ofstream(folder_ + name, std::ios::binary) << *text;
    return expectSame(
        [this](ReadOptions options) {
          options.path = folder_ + "/m.ele";
          return openTetgen(openFile(options.path), options);
        },
        {40, 150});
  }

 private:
  std::string folder_;
};

TEST_F(TetgenThreads, GiveTheMeshAndTheErrorsOfOneThread) {
  const std::string texts[] = {nodeText(), eleText(), faceText()};
  EXPECT_NE(expectSameOf(texts[0], texts[1], texts[2]).substr(0, 6), "error:");
  for (size_t file = 0; file < 3; ++file) {
    const std::vector<std::string> lines = linesOf(texts[file]);
    for (size_t i = 1; i < lines.size(); i += 7) {
      std::vector<std::string> damaged = lines;
      damaged[i] = kDamages[i % std::size(kDamages)](lines[i]);
      damaged[i / 2 + 1] += "# 1 2 3";
      std::string now[] = {texts[0], texts[1], texts[2]};
      now[file] = joined(damaged, i % 2 ? "\n" : "\r\n");
      SCOPED_TRACE(damaged[i].substr(0, 60));
      expectSameOf(now[0], now[1], now[2]);
    }
  }
}

}  // namespace
}  // namespace tetstream
