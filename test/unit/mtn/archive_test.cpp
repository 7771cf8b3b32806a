#include "motion_tool/archive.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <array>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "motion_tool/motion_tool.h"
#include "support/gzip.h"
#include "support/refusal.h"
#include "support/temporary_folder.h"

namespace {

using motion_tool::ArchivedFile;
using motion_tool::fileNameOf;
using test_support::contentOf;
using test_support::gzipped;
using ::testing::AllOf;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

std::string encode32(std::size_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) {
    bytes.push_back(static_cast<char>(value >> (8 * i)));
  }
  return bytes;
}

std::string padded(std::string text, std::size_t size) {
  text.resize(size, '\0');
  return text;
}

/// An archive of motions, made as archive.h describes it.
std::string archiveOf(const std::vector<ArchivedFile>& files) {
  std::string bytes = padded("ODAR" + std::string("\0\0\3\0", 4) + encode32(files.size()) + encode32(144), 64);
  std::size_t offset = 64 + 144 * files.size();
  for (const ArchivedFile& file : files) {
    bytes += "OMTN" + padded(file.name, 128) + encode32(offset) + encode32(file.content.size()) + encode32(0);
    offset += file.content.size();
  }
  for (const ArchivedFile& file : files) {
    bytes += file.content;
  }
  return bytes;
}

std::string problemOf(const std::string& bytes) {
  return test_support::refusalOf<std::runtime_error>([&] { motion_tool::readArchive(bytes); });
}

const std::vector<ArchivedFile> kFiles = {{"a_sit#wave", "OMTN..."}, {"bark", "RIFF"}, {"growl", "RIF"}};

TEST(Archive, IsRefusedWhereverItIsCutOff) {
  const std::string bytes = archiveOf(kFiles);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(problemOf(bytes.substr(0, size)), "") << size;
  }
  EXPECT_THAT(problemOf("OMTN"), HasSubstr("does not begin with ODAR"));
  EXPECT_THAT(problemOf(bytes.substr(0, 63)), HasSubstr("within its header"));
  EXPECT_THAT(problemOf(bytes.substr(0, 300)), HasSubstr("claims to have 3 files"));
  EXPECT_THAT(problemOf(bytes.substr(0, bytes.size() - 1)),
              HasSubstr("file 3 of the archive is cut off: it has 3 bytes from byte 507, and the archive has 509"));
}

TEST(Archive, IsRefusedIfANumberLeadsBeyondItsEnd) {
  constexpr std::size_t kCount = 8;
  constexpr std::size_t kEntrySize = 12;
  constexpr std::size_t kOffset = 64 + 132;
  constexpr std::size_t kSize = 64 + 136;
  for (const std::size_t place : {kCount, kEntrySize, kOffset, kSize}) {
    for (const std::size_t value : {0x7fffffffU, 0x80000000U, 0xffffffffU, 0xfffffff0U}) {
      EXPECT_NE(problemOf(archiveOf(kFiles).replace(place, 4, encode32(value))), "") << place << " " << value;
    }
  }
}

TEST(Archive, IsRefusedIfItsFilesOverlap) {
  std::string bytes = archiveOf({{"a", std::string(1000, 'x')}, {"b", ""}});
  bytes.replace(64 + 144 + 132, 8, encode32(64 + 2 * 144) + encode32(1000));
  EXPECT_EQ(problemOf(bytes), "the archive's files overlap");
}

TEST(Archive, IsRefusedIfAGzippedFileOfItCannotBeUnpacked) {
  const std::string good = gzipped("OMTN...");
  const std::string whole = "in the archive cannot be unpacked: it is gzipped, but damaged or cut off";
  const std::string another_checksum = std::string(good).replace(good.size() - 5, 1, "?");
  for (const std::string& bad : {good.substr(0, good.size() - 1), good.substr(0, 2), another_checksum}) {
    EXPECT_THAT(problemOf(archiveOf({{"a", "OMTN"}, {"bad", bad}})), HasSubstr(whole));
  }
  const std::string nearly_all = gzipped(std::string((64U << 20U) - 1, 'x'));
  EXPECT_EQ(problemOf(archiveOf({{"a", nearly_all}, {"b", "OMTN"}, {"c", nearly_all}})),
            "the archive's files have more than 64 MiB unpacked");
  const std::string raw((64U << 20U) + 1, 'x');
  EXPECT_THAT(problemOf(archiveOf({{"a", raw}})), HasSubstr("it has more than the 67108864 bytes allowed"));
}

TEST(Archive, FilesAreNamedByTheirContentAndStayInTheFolder) {
  const std::tuple<std::string, std::string, std::string> rows[] = {
      {"a_sit#sit-1", "OMTN...", "a_sit_sit-1.mtn"},
      {"bark", "RIFF...", "bark.wav"},
      {"x", "NotOMTN ", "x.bin"},
      {"x", "", "x.bin"},
      {"../../etc/passwd", "OMTN", "______etc_passwd.mtn"},
      {"/etc/x", "OMTN", "_etc_x.mtn"},
      {"C:\\x", "OMTN", "C__x.mtn"},
      {".bashrc", "OMTN", "_bashrc.mtn"},
      {"-rf", "OMTN", "_rf.mtn"},
      {"", "OMTN", "_.mtn"},
      {"\x1b[2J\n\xc3\xa4", "OMTN", "__2J___.mtn"},
  };
  for (const auto& [name, content, file] : rows) {
    EXPECT_EQ(fileNameOf({name, content}), file);
  }
}

class UnpackedArchive : public ::testing::Test {
 protected:
  std::string problemOf(const std::vector<ArchivedFile>& files, bool overwrite = false) const {
    return test_support::refusalOf<std::runtime_error>([&] { motion_tool::unpack(files, folder_, overwrite); });
  }

  std::ptrdiff_t numberOfFiles() const {
    return fs::exists(folder_) ? std::distance(fs::directory_iterator(folder_), fs::directory_iterator()) : 0;
  }

  const test_support::TemporaryFolder temporary_;
  const fs::path root_ = temporary_.path();
  const fs::path folder_ = root_ / "new" / "motions";
};

TEST_F(UnpackedArchive, OverwritesNothingUnlessItIsTold) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "bark.wav") << "mine";
  EXPECT_THAT(problemOf(kFiles), HasSubstr("bark.wav already exists; --force overwrites it"));
  EXPECT_EQ(contentOf(folder_ / "bark.wav"), "mine");
  EXPECT_EQ(numberOfFiles(), 1) << "all or nothing";
  EXPECT_EQ(problemOf(kFiles, true), "");
  EXPECT_EQ(contentOf(folder_ / "bark.wav"), "RIFF");
}

TEST_F(UnpackedArchive, WritesThroughNoLink) {
  fs::create_directories(folder_);
  std::ofstream(root_ / "outside") << "mine";
  fs::create_symlink(root_ / "outside", folder_ / "bark.wav");
  fs::create_symlink(root_ / "nothing", folder_ / "a_sit_wave.mtn");
  EXPECT_THAT(problemOf(kFiles), HasSubstr("a_sit_wave.mtn already exists"));
  EXPECT_EQ(problemOf(kFiles, true), "");
  EXPECT_EQ(contentOf(root_ / "outside"), "mine");
  EXPECT_FALSE(fs::exists(root_ / "nothing"));
}

TEST_F(UnpackedArchive, RefusesTwoFilesOfTheSameName) {
  EXPECT_THAT(problemOf({{"a#b", "OMTN"}, {"a_b", "OMTN"}}, true), HasSubstr("two files that would be named a_b.mtn"));
  EXPECT_EQ(numberOfFiles(), 0);
}

// The program itself.
class AiboMtn : public UnpackedArchive {
 protected:
  AiboMtn() { std::ofstream(root_ / "x.oda", std::ios::binary) << archiveOf(kFiles); }

  /// Its output and errors, then its exit code.
  /// @param before commands of the shell
  std::string run(const std::string& arguments, const std::string& before = "") const {
    std::string output;
    FILE* const pipe = ::popen((before + AIBO_MTN " " + arguments + " 2>&1").c_str(), "r");
    std::array<char, 256> buffer{};
    while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) {
      output += buffer.data();
    }
    return output + std::to_string(WEXITSTATUS(::pclose(pipe)));
  }

  std::string archive() const { return (root_ / "x.oda").string(); }
};

TEST_F(AiboMtn, ListsAnArchive) {
  EXPECT_EQ(run(archive()),
            "       7  a_sit_wave.mtn  (a_sit#wave)\n       4  bark.wav  (bark)\n       3  growl.bin  (growl)\n0");
  EXPECT_EQ(numberOfFiles(), 0);
}

// A memory stick of Sony's software is gzipped at any of its levels.
TEST_F(AiboMtn, ReadsGzippedFiles) {
  const std::string motion = motion_tool::encodeMtn(
      motion_tool::parseTextForm("name HOP\nrobot ERS-7\nat 0 tail_pan 0\nat 800 tail_pan 50\n"));
  const std::pair<const char*, std::string> rows[] = {
      {"plain.mtn", motion}, {"gzipped.mtn", gzipped(motion)}, {"cut.mtn", gzipped(motion).substr(0, 40)}};
  for (const auto& [name, content] : rows) {
    temporary_.write(name, content);
  }
  const std::string printed = run((root_ / "plain.mtn").string());
  EXPECT_THAT(printed, HasSubstr("on an ERS-7, tail_pan is clipped by up to 5.0 degrees (at 800 ms)\n0"));
  EXPECT_EQ(run((root_ / "gzipped.mtn").string()), printed);
  EXPECT_THAT(run((root_ / "cut.mtn").string()), HasSubstr("cannot be read: it is gzipped, but damaged or cut off\n1"));

  temporary_.write("x.oda", gzipped(archiveOf({{"hop", gzipped(motion)}, {"none", gzipped("NotOMTN ")}})));
  EXPECT_THAT(run("--unpack " + archive() + " " + folder_.string()), HasSubstr("hop.mtn  (hop)\n       8  none.bin"));
  EXPECT_EQ(contentOf(folder_ / "hop.mtn"), motion);
  EXPECT_THAT(run("--unpack " + archive() + " " + folder_.string()), HasSubstr("already exists; --force"));
  EXPECT_THAT(run("--unpack " + archive() + " " + folder_.string() + " --force"), HasSubstr("none.bin  (none)\n0"));
}

TEST_F(AiboMtn, MakesAMotionFileAndPrintsItWithWhatARobotWouldDoDifferently) {
  const std::string text = (root_ / "x.txt").string();
  const std::string file = (root_ / "x.mtn").string();
  const std::string clipped = "aibo_mtn: on an ERS-7, head_pan is clipped by up to 2.0 degrees (at 1600 ms)\n";
  std::ofstream(text) << "name HOP\nrobot ERS-7\nat 0 head_pan 0\nat 1600 head_pan 90\n";
  EXPECT_EQ(run(text + " " + file), clipped + "0");
  EXPECT_THAT(run(file), AllOf(HasSubstr("name HOP\n"), HasSubstr("head_pan 89.99998\n"), HasSubstr(clipped + "0")));
  EXPECT_THAT(run("--help"), AllOf(HasSubstr("usage:"), HasSubstr("folder; --force overwrites files there\n0")));
  EXPECT_THAT(run(text + " /nowhere/x.mtn"),
              HasSubstr("/nowhere/x.mtn cannot be written: the folder /nowhere: No such file or directory\n1"));
}

TEST_F(AiboMtn, SaysWhatIsWrongAndFails) {
  EXPECT_EQ(run("/nowhere.mtn"), "aibo_mtn: /nowhere.mtn cannot be read: No such file or directory\n1");
  const std::string pipe = (root_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& file : {pipe, pipe + " x.mtn", root_.string(), std::string("/dev/zero")}) {
    EXPECT_THAT(run(file), HasSubstr(" cannot be read: it is not a regular file\n1"));
  }
  std::ofstream(root_ / "x.mtn") << "OMTN";
  EXPECT_THAT(run((root_ / "x.mtn").string()), HasSubstr("x.mtn is not a motion file: it ends before section 0\n1"));
  std::ofstream(root_ / "x.txt") << "robot ERS-7\nat 0 no_such_joint 0\nat x\n";
  EXPECT_THAT(run((root_ / "x.txt").string() + " " + (root_ / "x.mtn").string()),
              AllOf(HasSubstr("x.txt: "), HasSubstr("no_such_joint"), HasSubstr("\n1")));

  std::ofstream(root_ / "x.oda", std::ios::binary) << archiveOf(kFiles).substr(0, 100);
  EXPECT_EQ(run(archive()), "aibo_mtn: " + archive() + ": the archive is cut off: it claims to have 3 files\n1");
  for (const std::string& arguments : {"--unpack " + archive(), "--force " + archive(), std::string()}) {
    EXPECT_THAT(run(arguments), HasSubstr("usage:"));
  }
}

}  // namespace
