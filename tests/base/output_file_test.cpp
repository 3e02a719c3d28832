#include "base/output_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/errors.h"

namespace tetraglass::base {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public testing::Test {
 protected:
  OutputFileTest() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) /
              ("tetraglass-" + std::to_string(::getpid()) + "-" + test->name());
    fs::create_directories(folder_);
  }
  ~OutputFileTest() override {
    std::error_code ignored;
    fs::permissions(folder_, fs::perms::owner_all, ignored);
    fs::remove_all(folder_, ignored);
  }

  static std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  fs::path folder_;
};

TEST_F(OutputFileTest, AppearsOnlyWithTheCommit) {
  {
    OutputFile file(path("a.png"));
    EXPECT_EQ(fs::path(file.temporary_path()).extension(), ".png");
    EXPECT_EQ(fs::path(file.temporary_path()).parent_path(), folder_);
    file.write(std::string("one\0two", 7));
    EXPECT_FALSE(fs::exists(path("a.png")));
    file.commit();
    EXPECT_EQ(content(path("a.png")), std::string("one\0two", 7));
  }
  EXPECT_EQ(files(), 1U);
}

TEST_F(OutputFileTest, LeavesNothingBehindWithoutACommit) {
  { OutputFile(path("a.npy")).write("half"); }
  EXPECT_EQ(files(), 0U);
}

TEST_F(OutputFileTest, KeepsTheOldFileUntilTheCommit) {
  std::ofstream(path("a.txt")) << "old";
  { OutputFile(path("a.txt")).write("new"); }
  EXPECT_EQ(content(path("a.txt")), "old");
  OutputFile file(path("a.txt"));
  file.write("a longer text");
  file.write("new");  // the whole content, not more of it
  file.commit();
  EXPECT_EQ(content(path("a.txt")), "new");
  EXPECT_EQ(files(), 1U);
}

TEST_F(OutputFileTest, TakesALargeFile) {
  const std::string bytes(10'000'000, 'x');
  OutputFile file(path("a.bin"));
  file.write(bytes);
  file.commit();
  EXPECT_EQ(content(path("a.bin")), bytes);
}

TEST_F(OutputFileTest, RefusesPlacesThatCannotBeWrittenTo) {
  EXPECT_THROW(OutputFile(""), WriteError);
  EXPECT_THROW(OutputFile{folder_.string()}, WriteError);
  EXPECT_THROW(OutputFile(path("no/such/folder/a.png")), WriteError);
  try {
    OutputFile(path("missing/a.png"));
    FAIL() << "nothing was thrown";
  } catch (const WriteError& error) {
    EXPECT_EQ(std::string(error.what()).find(path("missing/a.png") + ": "), 0U) << error.what();
  }
  if (::geteuid() != 0) {  // root may write anywhere
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_THROW(OutputFile(path("a.png")), WriteError);
  }
}

TEST_F(OutputFileTest, SaysWhenTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  OutputFile file(path("a.png"));
  fs::remove(file.temporary_path());
  fs::create_symlink("/dev/full", file.temporary_path());
  EXPECT_THROW(file.write("bytes"), WriteError);
}

TEST_F(OutputFileTest, SaysWhenTheCommitFails) {
  OutputFile file(path("a.png"));
  fs::create_directories(path("a.png/full"));  // in the meantime
  EXPECT_THROW(file.commit(), WriteError);
}

}  // namespace
}  // namespace tetraglass::base
