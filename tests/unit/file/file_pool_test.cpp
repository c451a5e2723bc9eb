// Many files of which few are open: those that cannot be read twice stay.
#include "file_pool.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <fstream>
#include <thread>

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
