#include "files/files.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <future>

#include "support/gzip.h"
#include "support/refusal.h"
#include "support/temporary_folder.h"
#include "support/test_pictures.h"

namespace {

int signal_in_fsync = 0;

}  // namespace

/// Takes the place of the system's.
extern "C" int fsync(int) {
  return signal_in_fsync == 0 ? 0 : ::kill(::getpid(), signal_in_fsync);
}

namespace aibo_driver::files {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FilesTest : public ::testing::Test {
 protected:
  FilesTest() { fs::create_directory(folder_); }

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
    return test_support::refusalOf<FileException>([&] { function(); });
  }

  const test_support::TemporaryFolder temporary_;
  const fs::path folder_ = fs::canonical(temporary_.path()) / "files of t\u00e9st";  // not the working directory
};

class LoadFileTest : public FilesTest {
 protected:
  static std::string loadRefusal(const std::string& path, std::size_t longest = 10) {
    return refusalOf([&] { loadFile(path, longest); });
  }
};

TEST_F(LoadFileTest, ReadsAWholeFileUpToTheLengthAllowed) {
  EXPECT_THAT(loadFile(write("abc"), 3), testing::ElementsAre('a', 'b', 'c'));
  EXPECT_THAT(loadFile(write(""), 3), testing::SizeIs(0));
}

TEST_F(LoadFileTest, SaysWhyItFails) {
  EXPECT_THAT(loadRefusal(write("abc"), 2), testing::EndsWith("nod.mtn': it has more than the 2 bytes allowed"));
  EXPECT_THAT(loadRefusal((folder_ / "missing").string()), HasSubstr("no such file on the computer "));
  EXPECT_THAT(loadRefusal("a/missing"), testing::EndsWith("(working directory: " + fs::current_path().string() + ")"));
  EXPECT_THAT(loadRefusal(folder_.string()), HasSubstr("not a regular file"));
  EXPECT_THAT(loadRefusal("/dev/zero"), HasSubstr("not a regular file"));
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(loadRefusal((folder_ / "pipe").string()), HasSubstr("not a regular file"));
  EXPECT_THAT(loadRefusal("~/nod.mtn"), HasSubstr("'~' is not expanded"));
  EXPECT_THAT(loadRefusal(""), HasSubstr("no such file"));
}

// A small file could fill any memory.
TEST_F(LoadFileTest, UnpacksAGzippedFileUpToTheLengthAllowed) {
  using test_support::gzipped;
  EXPECT_THAT(loadFile(write(gzipped("abc")), 3), testing::ElementsAre('a', 'b', 'c'));
  EXPECT_THAT(loadFile(write(gzipped("")), 3), testing::SizeIs(0));
  EXPECT_THAT(loadFile(write("\x1f"), 3), testing::ElementsAre(0x1f));
  EXPECT_THAT(loadRefusal(write(gzipped("abc")), 2), testing::EndsWith("it has more than the 2 bytes allowed"));
  EXPECT_THAT(loadRefusal(write(gzipped("abc").substr(0, 12))),
              testing::EndsWith("nod.mtn': it is gzipped, but damaged or cut off"));
  EXPECT_THAT(loadRefusal(write(gzipped("a") + gzipped("b"))), testing::EndsWith("has bytes after its end"));
  EXPECT_THAT(loadRefusal(write(gzipped(std::string(2000, 'x')))),
              testing::EndsWith("nod.mtn': unpacked, it has more than the 10 bytes allowed"));
}

// Files of the kernel have no size. Reading them may wait for ever, or take their content from other readers.
TEST_F(LoadFileTest, ReadsNothingOfTheKernelsFiles) {
  for (const std::string path : {"/proc/kmsg", "/proc/self/environ", "/proc/self/pagemap"}) {
    if (::access(path.c_str(), R_OK) == 0) {  // only root may read the first
      EXPECT_THAT(loadFile(path, 1000), testing::SizeIs(0)) << path;
    }
  }
}

TEST_F(LoadFileTest, APathWithControlCharactersIsRefusedAndShownWithoutThem) {
  EXPECT_THAT(loadRefusal(std::string("/etc/passwd\0.mtn", 16)), HasSubstr("'/etc/passwd?.mtn': the path"));
  EXPECT_THAT(loadRefusal("a\x1b[2J"), HasSubstr("cannot read 'a?[2J'"));
}

class ReplaceFileTest : public FilesTest {};

TEST_F(ReplaceFileTest, RefusesWhatIsNoPathOfAFile) {
  fs::create_directory(folder_ / "sub");
  for (const fs::path& path : {folder_ / "missing" / "a", folder_ / "missing" / "", folder_ / "sub",
                               folder_ / "sub" / "", folder_ / "a\nb", fs::path("~/a"), fs::path()}) {
    EXPECT_THAT(refusalOf([&] { replaceFile(path.string(), "new"); }), HasSubstr("cannot write ")) << path;
  }
  EXPECT_EQ(filesInFolder(), 1U) << "nothing is left of them";
}

// The rest of what is promised: replace_file_test.py.
TEST_F(ReplaceFileTest, ASignalWaitsUntilTheFileIsWhole) {
  const std::pair<int, std::string> rows[] = {{SIGKILL, "old"}, {SIGTERM, "new"}};
  for (const auto& [signal, content] : rows) {
    const std::string path = write("old");
    EXPECT_EXIT(
        {
          signal_in_fsync = signal;
          replaceFile(path, "new");
        },
        testing::KilledBySignal(signal), "");
    EXPECT_EQ(read(path), content);
    EXPECT_EQ(filesInFolder(), signal == SIGKILL ? 2U : 1U) << "the next one removes what is left";
  }
}

class SaveJpegTest : public FilesTest {
 protected:
  // An image of one byte, which no program would show.
  static std::vector<std::uint8_t> jpegWith(std::uint8_t byte) {
    return {0xFF, 0xD8, 0xFF, 0xDA, 0, 2, byte, 0xFF, 0xD9};
  }

  std::string save(const std::string& path, std::uint8_t byte = 'a') const {
    return saveJpeg(folder_.string(), path, jpegWith(byte));
  }

  std::string saveRefusal(const std::string& path) const {
    return refusalOf([&] { save(path); });
  }

  void expectSaved(const std::string& name, std::uint8_t byte) const {
    const std::vector<std::uint8_t> jpeg = jpegWith(byte);
    EXPECT_EQ(read(folder_ / name), std::string(jpeg.begin(), jpeg.end())) << name;
  }
};

TEST_F(SaveJpegTest, FollowsALinkToAJpegInTheFolder) {
  save("picture.jpg", 'a');
  fs::create_symlink("picture.jpg", folder_ / "latest.jpg");
  save("latest.jpg", 'b');
  EXPECT_TRUE(fs::is_symlink(folder_ / "latest.jpg"));
  expectSaved("picture.jpg", 'b');
}

TEST_F(SaveJpegTest, WritesEachOfThesePaths) {
  const std::string long_name(200, 'a');
  fs::create_directory(folder_ / long_name);
  fs::create_symlink(long_name, folder_ / "pictures");
  const std::string link = (folder_ / "pictures").string();
  const fs::path in_long = folder_ / long_name / "picture.jpg";
  const std::tuple<std::string, std::string, fs::path> rows[] = {
      // the folder for pictures, the path, and what is written
      {folder_, long_name + "/../" + long_name + "/picture.jpg", in_long},
      {folder_, in_long, in_long},
      {"/", folder_ / "picture.jpg", folder_ / "picture.jpg"},
      {link, link + "/picture.jpg", in_long},
      {folder_, "picture.jpeg", folder_ / "picture.jpeg"},
      {folder_, "PICTURE.JPG", folder_ / "PICTURE.JPG"},
      {folder_, "-rf.jpg", folder_ / "-rf.jpg"},
  };
  for (const auto& [folder, path, file] : rows) {
    EXPECT_EQ(saveJpeg(folder, path, jpegWith('a')), file.string());
  }
}

TEST_F(SaveJpegTest, WritesNothingOutsideTheFolder) {
  const fs::path album = folder_ / "album";
  fs::create_directory(album);
  fs::create_symlink(folder_, album / "out");
  save("outside.jpg");
  fs::create_symlink(folder_ / "outside.jpg", album / "link.jpg");
  const std::string neighbour = (folder_ / "album2.jpg").string();
  for (const std::string path : {"../picture.jpg", "out/picture.jpg", "link.jpg", neighbour.c_str(), "/picture.jpg"}) {
    EXPECT_THAT(refusalOf([&] { saveJpeg(album.string(), path, jpegWith('b')); }),
                HasSubstr("not in the folder for pictures, " + album.string()))
        << path;
  }
  EXPECT_EQ(filesInFolder(), 2u);
  expectSaved("outside.jpg", 'a');
}

TEST_F(SaveJpegTest, ReplacesNothingButJpegs) {
  for (const std::string content : {"ssh-rsa key", "", "\xff\xd8"}) {
    std::ofstream(folder_ / "key.jpg", std::ios::binary) << content;
    EXPECT_EQ(saveRefusal("key.jpg"),
              "cannot write " + (folder_ / "key.jpg").string() +
                  ": it exists and is not a JPEG, or cannot be read; give another name, or remove it");
    EXPECT_EQ(read(folder_ / "key.jpg"), content);
  }
  ASSERT_EQ(::mkfifo((folder_ / "pipe.jpg").c_str(), 0600), 0);
  EXPECT_THAT(saveRefusal("pipe.jpg"), HasSubstr("not a regular file"));
  std::ofstream(folder_ / "authorized_keys") << "ssh-rsa key";
  fs::create_symlink("authorized_keys", folder_ / "link.jpg");
  EXPECT_THAT(saveRefusal("link.jpg"),
              HasSubstr("'link.jpg': it is a link to " + (folder_ / "authorized_keys").string()));
  EXPECT_EQ(read(folder_ / "authorized_keys"), "ssh-rsa key");
}

// Another user who may write into the folder for pictures.
TEST_F(SaveJpegTest, WritesNothingThroughALinkThatReplacesAFolderMeanwhile) {
  const fs::path pictures = folder_ / "pictures";
  const fs::path outside = folder_ / "outside";
  fs::create_directories(pictures / "album");
  fs::create_directory(outside);
  fs::create_directory_symlink(outside, pictures / "link");
  std::atomic<bool> goes_on{true};
  auto other = std::async(std::launch::async, [&] {
    while (goes_on) {
      ::renameat2(AT_FDCWD, (pictures / "album").c_str(), AT_FDCWD, (pictures / "link").c_str(), RENAME_EXCHANGE);
    }
  });
  for (int i = 0; i < 5000; ++i) {
    refusalOf([&] { saveJpeg(pictures.string(), "album/picture.jpg", jpegWith('a')); });
  }
  goes_on = false;
  other.get();
  EXPECT_TRUE(fs::is_empty(outside));
}

TEST_F(SaveJpegTest, RefusesWhatIsNoPathOfAJpegInAFolderAndSaysWhatToDo) {
  const std::pair<std::string, std::string> rows[] = {
      {"missing/picture.jpg", "the folder " + (folder_ / "missing").string() + " does not exist"},
      {folder_.string(), "does not name a file"},
      {folder_ / "picture.png", "name it " + (folder_ / "picture.jpg").string()},
      {"picture", "name it picture.jpg"},
      {std::string("picture.sh\0.jpg", 15), "cannot write 'picture.sh?.jpg'"},  // for the system, it is picture.sh
      {"picture\n.jpg", "cannot write 'picture?.jpg'"},
      {"\xE2\x80\xAEgpj.jpg", "holds control characters"},
      {"~/picture.jpg", "'~' is not expanded"},
  };
  for (const auto& [path, problem] : rows) {
    EXPECT_THAT(saveRefusal(path), HasSubstr(problem));
  }
  EXPECT_THAT(refusalOf([&] { saveJpeg((folder_ / "missing").string(), "picture.jpg", jpegWith('a')); }),
              HasSubstr("make it, or set ~picture_folder"));
  EXPECT_EQ(filesInFolder(), 0u);
}

void setEnvironment(const char* name, const char* value) {
  value == nullptr ? ::unsetenv(name) : ::setenv(name, value, 1);
}

TEST(RosHome, IsTheOneOfTheEnvironmentOrOfTheUserAndAbsolute) {
  const std::string of_user = std::string(::getpwuid(::getuid())->pw_dir) + "/.ros";
  const std::string here = fs::current_path().string();
  const struct {
    const char* ros_home;
    const char* home;
    std::string expected;
  } rows[] = {
      {"/ros", "/home/me", "/ros"},
      {nullptr, "/home/me", "/home/me/.ros"},
      {"", "/home/me", "/home/me/.ros"},
      {nullptr, nullptr, of_user},
      {nullptr, "", of_user},
      {"ros", nullptr, here + "/ros"},
      {nullptr, "me", here + "/me/.ros"},
  };
  for (const auto& row : rows) {
    setEnvironment("ROS_HOME", row.ros_home);
    setEnvironment("HOME", row.home);
    EXPECT_EQ(rosHome(), row.expected);
    EXPECT_EQ(pictureFolder(""), row.expected);
  }
}

TEST(PictureFolder, IsTheChosenOneOrPicturesOrThatOfRos) {
  const test_support::TemporaryFolder home;
  setEnvironment("HOME", home.path().c_str());
  setEnvironment("ROS_HOME", "/ros_home");
  EXPECT_EQ(pictureFolder("/chosen"), "/chosen");
  EXPECT_EQ(pictureFolder(""), "/ros_home");
  home.write("Pictures/picture", "");
  EXPECT_EQ(pictureFolder(""), home.path("Pictures"));
}

using Bytes = std::vector<std::uint8_t>;

Bytes withSegment(const Bytes& jpeg, std::uint8_t marker, const std::string& content, std::size_t at = 2) {
  const std::size_t size = content.size() + 2;
  Bytes segment = {0xFF, marker, static_cast<std::uint8_t>(size >> 8), static_cast<std::uint8_t>(size)};
  segment.insert(segment.end(), content.begin(), content.end());
  Bytes result = jpeg;
  result.insert(result.begin() + static_cast<std::ptrdiff_t>(at), segment.begin(), segment.end());
  return result;
}

TEST(WithoutComments, CommentsAndApplicationDataAreLeftOut) {
  const Bytes picture = test_pictures::make();
  EXPECT_EQ(withoutComments(picture), picture);
  Bytes filled = picture;
  filled.insert(filled.begin() + 2, 3, 0xFF);  // bytes that may precede a marker
  EXPECT_EQ(withoutComments(filled), picture);
  const std::string key = "\nssh-rsa key of a stranger\n";
  EXPECT_EQ(withoutComments(withSegment(picture, 0xFE, key)), picture);
  EXPECT_EQ(withoutComments(withSegment(withSegment(picture, 0xFE, ""), 0xFE, std::string(65533, 'x'))), picture);
  EXPECT_EQ(withoutComments(withSegment(picture, 0xFE, key, test_pictures::findMarker(picture, 0xDA))), picture);
  for (int application = 0; application < 16; ++application) {
    const auto marker = static_cast<std::uint8_t>(0xE0 + application);
    EXPECT_EQ(withoutComments(withSegment(picture, marker, key)), picture) << application;
    EXPECT_EQ(withoutComments(withSegment(picture, marker, std::string("JFIF\0\1\2\0\0\1\0\1\1\1xxx", 17))), picture)
        << application << ": a thumbnail";
  }
}

TEST_F(SaveJpegTest, SavesNoComments) {
  saveJpeg(folder_.string(), "picture.jpg", withSegment(jpegWith('a'), 0xFE, "\nssh-rsa key of a stranger\n"));
  expectSaved("picture.jpg", 'a');
}

TEST(WithoutComments, ADamagedPictureIsRefused) {
  const Bytes picture = test_pictures::make();
  for (std::size_t size = 0; size < test_pictures::findMarker(picture, 0xDA); ++size) {
    EXPECT_THROW(withoutComments(Bytes(picture.begin(), picture.begin() + static_cast<std::ptrdiff_t>(size))),
                 FileException)
        << size;
  }
  EXPECT_THAT(test_support::refusalOf<FileException>([&] {
                withoutComments({0xFF, 0xD8, 0xFF, 0xFE, 0, 3, 'a', 0xFF, 0xFE, 0, 1, 0xFF, 0xDA, 0, 2});
              }),
              testing::EndsWith("a segment at byte 7 is damaged"));
}

TEST(FileNameOnRobot, HasCapitalsAndAnEnding) {
  EXPECT_EQ(motionFileName("nod"), "NOD.MTN");
  EXPECT_EQ(motionFileName("Nod.mtn"), "NOD.MTN");
  EXPECT_EQ(motionFileName("nod.2"), "NOD.2");
  EXPECT_EQ(motionFileName(""), "");
  EXPECT_EQ(motionFileName("nod\x1b[2J\n"), "NOD?[2J?.MTN");
  EXPECT_EQ(pictureFileName("aibo0001"), "AIBO0001.JPG");
}

TEST(LoadMotion, ReadsAMotionAndNothingElse) {
  EXPECT_FALSE(loadMotion(MEMORY_STICK "/OPEN-R/MW/DATA/P/NOD.MTN").empty());
  EXPECT_THAT(test_support::refusalOf<FileException>([&] { loadMotion(MEMORY_STICK "/OPEN-R/MW/CONF/RCSERVER.CFG"); }),
              testing::EndsWith("/RCSERVER.CFG' is not a motion file: it does not begin with OMTN"));
}

}  // namespace
}  // namespace aibo_driver::files
