// Files that get their names together, or not at all.
#include "joint_files.h"

#include <sys/stat.h>

#include "folder.h"
#include "status.h"

namespace tetstream::test {
namespace {

// Three of them, written and complete.
struct Three {
  explicit Three(const Folder& folder, const std::string& third = "c") {
    for (const std::string& name : {std::string("a"), std::string("b"), third}) {
      const auto sink = createFile(folder.file(name), &files);
      sink->write("new", 3);
      sink->commit();
    }
  }
  Status commit() {
    try {
      files.commit();
    } catch (const Error& error) {
      return error.status();
    }
    return Status::kOk;
  }
  JointFiles files;
};

TEST(JointFiles, HaveTheirNamesWhenAllAreCommitted) {
  Folder folder;
  writeFile(folder.file("a"), "old");
  Three three(folder);
  EXPECT_EQ(contents(folder.file("a")), "old");
  EXPECT_EQ(folder.names().count("b") + folder.names().count("c"), 0u);
  EXPECT_EQ(three.commit(), Status::kOk);
  EXPECT_EQ(folder.names(), (Names{"a", "b", "c"}));
  for (const char* name : {"a", "b", "c"}) EXPECT_EQ(contents(folder.file(name)), "new");
}

TEST(JointFiles, LeaveNothingWithoutCommit) {
  Folder folder;
  writeFile(folder.file("a"), "old");
  { const Three three(folder); }
  EXPECT_EQ(folder.names(), Names{"a"});
  Three three(folder);
  three.files.forget();
  EXPECT_EQ(folder.names(), Names{"a"});
  EXPECT_EQ(contents(folder.file("a")), "old");
}

// A folder takes the name of one of them in the meantime: it cannot be renamed, and what was is as
// it was, of the same inode.
TEST(JointFiles, AreUndoneWhereOneCannotBeRenamed) {
  for (const char* taken : {"a", "b", "c"}) {
    Folder folder;
    for (const char* name : {"a", "c"})
      if (std::string(name) != taken) writeFile(folder.file(name), "old");
    Names before = folder.names();
    struct stat was = {}, is = {};
    Three three(folder);
    ASSERT_EQ(::mkdir(folder.file(taken).c_str(), 0700), 0);
    before.insert(taken);
    ::stat(folder.file("a").c_str(), &was);
    EXPECT_EQ(three.commit(), Status::kIo);
    EXPECT_EQ(folder.names(), before) << taken;
    before.erase(taken);
    for (const std::string& name : before) EXPECT_EQ(contents(folder.file(name)), "old") << taken;
    ::stat(folder.file("a").c_str(), &is);
    EXPECT_EQ(is.st_ino, was.st_ino);
    ::rmdir(folder.file(taken).c_str());
  }
}

TEST(JointFiles, TellOfOneNameBeforeAnythingIsWritten) {
  Folder folder;
  JointFiles files;
  const auto a = createFile(folder.file("a"), &files);
  files.needDistinct();
  auto other = createFile(folder.file("././a"), &files);
  EXPECT_THROW(files.needDistinct(), Error);
  other = createFile(folder.file("b"), &files);
  files.needDistinct();
}

// By whatever path.
TEST(JointFiles, MayNotHaveOneName) {
  Folder folder;
  for (const bool there : {false, true}) {
    if (there) writeFile(folder.file("a"), "old");
    Three three(folder, "../././/" + folder.path.substr(folder.path.rfind('/') + 1) + "/a");
    EXPECT_EQ(three.commit(), Status::kBadArgument);
    EXPECT_EQ(folder.names(), there ? Names{"a"} : Names{});
  }
}

}  // namespace
}  // namespace tetstream::test
