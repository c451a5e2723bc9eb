// Many files of which few are open: those that cannot be read twice stay.
#include "file_pool.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "compressed_bytes.h"
#include "folder.h"
#include "status.h"

namespace tetstream::test {
namespace {

TEST(FilePool, ReadsManyFilesAndAPipe) {
  const Folder folder;
  const auto pool = std::make_shared<FilePool>(folder.path);
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe) << "once"; });
  std::vector<std::unique_ptr<ByteSource>> files;
  files.push_back(pool->add(pipe));
  writer.join();
  for (size_t k = 1; k < 200; ++k) {
    const std::string path = folder.file(std::to_string(k));
    writeFile(path, "text " + std::to_string(k));
    files.push_back(pool->add(path));
  }
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(contents(*readAgain(*files[0])), "once");
    for (size_t k = 1; k < 200; ++k)
      EXPECT_EQ(contents(*readAgain(*files[k])), "text " + std::to_string(k));
  }
}

size_t openFiles() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<size_t>(std::distance(begin(all), end(all)));
}

// Each is a file of its own while it is open, of which there are no more than of others.
TEST(FilePool, TakesWrappingsOffIfAsked) {
  const Folder folder;
  Bytes wrapping;
  const std::unique_ptr<ByteSink> sink = wrapped(createMemory(wrapping), Wrapping::kGzip);
  sink->write("text", 4);
  sink->commit();
  const std::string bytes(wrapping.begin(), wrapping.end());
  for (const bool unwraps : {false, true}) {
    const size_t before = openFiles();
    const auto pool = std::make_shared<FilePool>(folder.path, unwraps);
    std::vector<std::unique_ptr<ByteSource>> files;
    for (size_t k = 0; k < 100; ++k) {
      const std::string path = folder.file(std::to_string(k));
      writeFile(path, bytes);
      files.push_back(pool->add(path));
    }
    for (const auto& file : files) EXPECT_EQ(contents(*readAgain(*file)), unwraps ? "text" : bytes);
    EXPECT_LE(openFiles(), before + 65);
  }
}

TEST(FilePool, SpoolsWhereItIsTold) {
  const Folder folder;
  const auto pool = std::make_shared<FilePool>("/no/such/folder");
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { const std::ofstream nothing(pipe); });
  try {
    pool->add(pipe);
    ADD_FAILURE() << "spooled elsewhere";
  } catch (const Error& error) {
    EXPECT_NE(error.text().find("/no/such/folder"), std::string::npos) << error.text();
  }
  writer.join();
}

}  // namespace
}  // namespace tetstream::test
