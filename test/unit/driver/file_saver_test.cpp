#include "ros/camera/file_saver.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace aibo_driver::node {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FileSaverTest : public ::testing::Test {
 protected:
  FileSaverTest() {
    std::string pattern = (fs::temp_directory_path() / "file_saver_test.XXXXXX").string();
    folder_ = fs::canonical(::mkdtemp(pattern.data()));
  }
  ~FileSaverTest() override { fs::remove_all(folder_); }

  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  static std::string refusal(const std::string& path) {
    try {
      saveJpeg(path, {'a'});
    } catch (const SaveException& error) {
      return error.what();
    }
    return "saved";
  }

  fs::path folder_;
};

TEST_F(FileSaverTest, SavesAndTellsWhere) {
  EXPECT_EQ(saveJpeg((folder_ / "picture.jpg").string(), {'a', 'b'}), (folder_ / "picture.jpg").string());
  EXPECT_EQ(read(folder_ / "picture.jpg"), "ab");
}

TEST_F(FileSaverTest, ReplacesAnExistingFileAndLeavesNothingElse) {
  saveJpeg((folder_ / "picture.jpg").string(), {'a', 'b', 'c'});
  saveJpeg((folder_ / "picture.jpg").string(), {'d'});
  EXPECT_EQ(read(folder_ / "picture.jpg"), "d");
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(FileSaverTest, GivesTheFileTheUsualPermissions) {
  const mode_t old_mask = ::umask(022);
  saveJpeg((folder_ / "picture.jpg").string(), {'a'});
  ::umask(old_mask);
  EXPECT_EQ(fs::status(folder_ / "picture.jpg").permissions(), fs::perms(0644));
}

TEST_F(FileSaverTest, FollowsALinkToAFile) {
  saveJpeg((folder_ / "picture.jpg").string(), {'a'});
  fs::create_symlink("picture.jpg", folder_ / "latest.jpg");
  saveJpeg((folder_ / "latest.jpg").string(), {'b'});
  EXPECT_TRUE(fs::is_symlink(folder_ / "latest.jpg"));
  EXPECT_EQ(read(folder_ / "picture.jpg"), "b");
}

TEST_F(FileSaverTest, TakesARelativePathFromTheWorkingDirectory) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  const std::string saved = saveJpeg("picture.jpg", {'a'});
  fs::current_path(before);
  EXPECT_EQ(saved, (folder_ / "picture.jpg").string());
}

TEST_F(FileSaverTest, NamesAFolderThatDoesNotExist) {
  EXPECT_THAT(refusal((folder_ / "missing" / "picture.jpg").string()),
              HasSubstr("the folder " + (folder_ / "missing").string() + " does not exist"));
}

TEST_F(FileSaverTest, RefusesWhatNamesNoFile) {
  EXPECT_THAT(refusal(folder_.string()), HasSubstr("names no file"));
  EXPECT_THAT(refusal(folder_.string() + "/"), HasSubstr("names no file"));
  EXPECT_THAT(refusal((folder_ / "picture.jpg").string() + "/"), HasSubstr("names no file"));
}

TEST_F(FileSaverTest, TakesBothNamesOfAJpegInAnyCase) {
  EXPECT_EQ(saveJpeg((folder_ / "picture.jpeg").string(), {'a'}), (folder_ / "picture.jpeg").string());
  EXPECT_EQ(saveJpeg((folder_ / "PICTURE.JPG").string(), {'a'}), (folder_ / "PICTURE.JPG").string());
}

TEST_F(FileSaverTest, RefusesANameThatIsNotThatOfAJpegAndSaysABetterOne) {
  EXPECT_THAT(refusal((folder_ / "picture.png").string()), HasSubstr("name it " + (folder_ / "picture.jpg").string()));
  EXPECT_THAT(refusal((folder_ / "picture").string()), HasSubstr("name it " + (folder_ / "picture.jpg").string()));
  EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(FileSaverTest, SaysThatATildeIsNotExpanded) {
  EXPECT_THAT(refusal("~/picture.jpg"), HasSubstr("'~' is not expanded"));
}

TEST_F(FileSaverTest, DoesNotReplaceADevice) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.jpg").c_str(), 0600), 0);
  EXPECT_THAT(refusal((folder_ / "pipe.jpg").string()), HasSubstr("no regular file"));
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe.jpg"));
}

TEST_F(FileSaverTest, SaysThatPermissionIsMissing) {
  if (::geteuid() == 0) {
    GTEST_SKIP() << "root may write everywhere";
  }
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(refusal((folder_ / "picture.jpg").string()), HasSubstr("Permission denied"));
  fs::permissions(folder_, fs::perms::owner_all);
}

}  // namespace
}  // namespace aibo_driver::node
