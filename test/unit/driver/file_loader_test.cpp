#include "ros/body/file_loader.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace aibo_driver::node {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class FileLoaderTest : public ::testing::Test {
 protected:
  FileLoaderTest() {
    std::string pattern = (fs::temp_directory_path() / "file_loader_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~FileLoaderTest() override { fs::remove_all(folder_); }

  std::string write(const std::string& content) const {
    const std::string path = (folder_ / "nod.mtn").string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  static std::string refusal(const std::string& path, std::size_t longest = 10) {
    try {
      loadFile(path, longest);
    } catch (const LoadException& error) {
      return error.what();
    }
    return "loaded";
  }

  fs::path folder_;
};

TEST_F(FileLoaderTest, ReadsAWholeFileUpToTheLengthAllowed) {
  EXPECT_THAT(loadFile(write("abc"), 3), ElementsAre('a', 'b', 'c'));
  EXPECT_THAT(loadFile(write(""), 3), SizeIs(0));
}

TEST_F(FileLoaderTest, SaysWhyItCannot) {
  EXPECT_THAT(refusal(write("abc"), 2), HasSubstr("more than the 2 bytes"));
  EXPECT_THAT(refusal((folder_ / "missing").string()), HasSubstr("no such file on the driver's machine"));
  EXPECT_THAT(refusal("missing"), HasSubstr(fs::current_path().string()));
  EXPECT_THAT(refusal(folder_.string()), HasSubstr("no regular file"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("no regular file"));
  EXPECT_THAT(refusal("~/nod.mtn"), HasSubstr("'~' is not expanded"));
  EXPECT_THAT(refusal(""), HasSubstr("no such file"));
}

}  // namespace
}  // namespace aibo_driver::node
