#include "ros/files.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace aibo_driver::node {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class FilesTest : public ::testing::Test {
 protected:
  FilesTest() {
    std::string pattern = (fs::temp_directory_path() / "files_test.XXXXXX").string();
    folder_ = fs::canonical(::mkdtemp(pattern.data()));
  }
  ~FilesTest() override { fs::remove_all(folder_); }

  std::string write(const std::string& content) const {
    const std::string path = (folder_ / "nod.mtn").string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  template <typename Function>
  static std::string refusalOf(const Function& function) {
    try {
      function();
    } catch (const FileException& error) {
      return error.what();
    }
    return "not refused";
  }

  fs::path folder_;
};

class LoadFileTest : public FilesTest {
 protected:
  static std::string loadRefusal(const std::string& path, std::size_t longest = 10) {
    return refusalOf([&] { loadFile(path, longest); });
  }
};

TEST_F(LoadFileTest, ReadsAWholeFileUpToTheLengthAllowed) {
  EXPECT_THAT(loadFile(write("abc"), 3), ElementsAre('a', 'b', 'c'));
  EXPECT_THAT(loadFile(write(""), 3), SizeIs(0));
}

TEST_F(LoadFileTest, SaysWhyItFails) {
  EXPECT_THAT(loadRefusal(write("abc"), 2), HasSubstr("more than the 2 bytes"));
  EXPECT_THAT(loadRefusal((folder_ / "missing").string()), HasSubstr("no such file on the driver's machine"));
  EXPECT_THAT(loadRefusal("missing"), HasSubstr(fs::current_path().string()));
  EXPECT_THAT(loadRefusal(folder_.string()), HasSubstr("not a regular file"));
  EXPECT_THAT(loadRefusal("/dev/zero"), HasSubstr("not a regular file"));
  EXPECT_THAT(loadRefusal("~/nod.mtn"), HasSubstr("'~' is not expanded"));
  EXPECT_THAT(loadRefusal(""), HasSubstr("no such file"));
}

class SaveJpegTest : public FilesTest {
 protected:
  static std::string saveRefusal(const std::string& path) {
    return refusalOf([&] { saveJpeg(path, {'a'}); });
  }
};

TEST_F(SaveJpegTest, SavesAndReturnsThePath) {
  EXPECT_EQ(saveJpeg((folder_ / "picture.jpg").string(), {'a', 'b'}), (folder_ / "picture.jpg").string());
  EXPECT_EQ(read(folder_ / "picture.jpg"), "ab");
}

TEST_F(SaveJpegTest, ReplacesAnExistingFileAndLeavesNothingElse) {
  saveJpeg((folder_ / "picture.jpg").string(), {'a', 'b', 'c'});
  saveJpeg((folder_ / "picture.jpg").string(), {'d'});
  EXPECT_EQ(read(folder_ / "picture.jpg"), "d");
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(SaveJpegTest, GivesTheFileTheUsualPermissions) {
  const mode_t old_mask = ::umask(022);
  saveJpeg((folder_ / "picture.jpg").string(), {'a'});
  ::umask(old_mask);
  EXPECT_EQ(fs::status(folder_ / "picture.jpg").permissions(), fs::perms(0644));
}

TEST_F(SaveJpegTest, FollowsALinkToAFile) {
  saveJpeg((folder_ / "picture.jpg").string(), {'a'});
  fs::create_symlink("picture.jpg", folder_ / "latest.jpg");
  saveJpeg((folder_ / "latest.jpg").string(), {'b'});
  EXPECT_TRUE(fs::is_symlink(folder_ / "latest.jpg"));
  EXPECT_EQ(read(folder_ / "picture.jpg"), "b");
}

TEST_F(SaveJpegTest, TakesARelativePathFromTheWorkingDirectory) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  const std::string saved = saveJpeg("picture.jpg", {'a'});
  fs::current_path(before);
  EXPECT_EQ(saved, (folder_ / "picture.jpg").string());
}

TEST_F(SaveJpegTest, NamesTheFolderThatDoesNotExist) {
  EXPECT_THAT(saveRefusal((folder_ / "missing" / "picture.jpg").string()),
              HasSubstr("the folder " + (folder_ / "missing").string() + " does not exist"));
}

TEST_F(SaveJpegTest, RefusesAPathThatDoesNotNameAFile) {
  EXPECT_THAT(saveRefusal(folder_.string()), HasSubstr("does not name a file"));
  EXPECT_THAT(saveRefusal(folder_.string() + "/"), HasSubstr("does not name a file"));
  EXPECT_THAT(saveRefusal((folder_ / "picture.jpg").string() + "/"), HasSubstr("does not name a file"));
}

TEST_F(SaveJpegTest, TakesBothNamesOfAJpegInAnyCase) {
  EXPECT_EQ(saveJpeg((folder_ / "picture.jpeg").string(), {'a'}), (folder_ / "picture.jpeg").string());
  EXPECT_EQ(saveJpeg((folder_ / "PICTURE.JPG").string(), {'a'}), (folder_ / "PICTURE.JPG").string());
}

TEST_F(SaveJpegTest, RefusesANameThatIsNotThatOfAJpegAndSuggestsOne) {
  EXPECT_THAT(saveRefusal((folder_ / "picture.png").string()),
              HasSubstr("name it " + (folder_ / "picture.jpg").string()));
  EXPECT_THAT(saveRefusal((folder_ / "picture").string()), HasSubstr("name it " + (folder_ / "picture.jpg").string()));
  EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(SaveJpegTest, SaysThatATildeIsNotExpanded) {
  EXPECT_THAT(saveRefusal("~/picture.jpg"), HasSubstr("'~' is not expanded"));
}

TEST_F(SaveJpegTest, DoesNotReplaceADevice) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.jpg").c_str(), 0600), 0);
  EXPECT_THAT(saveRefusal((folder_ / "pipe.jpg").string()), HasSubstr("not a regular file"));
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe.jpg"));
}

TEST_F(SaveJpegTest, SaysThatPermissionIsMissing) {
  if (::geteuid() == 0) {
    GTEST_SKIP() << "root may write everywhere";
  }
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(saveRefusal((folder_ / "picture.jpg").string()), HasSubstr("Permission denied"));
  fs::permissions(folder_, fs::perms::owner_all);
}

}  // namespace
}  // namespace aibo_driver::node
