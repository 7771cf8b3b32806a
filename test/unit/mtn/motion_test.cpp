#include "mtn/motion.h"

#include <gmock/gmock.h>

#include <cstdint>

#include "motion_tool/motion_tool.h"

namespace {

using ::testing::HasSubstr;
using ::testing::StrEq;

// A copy of exactly the file's size, so that AddressSanitizer finds reads past its end.
class ReadMotion {
 public:
  explicit ReadMotion(const std::string& bytes) : bytes_(bytes.begin(), bytes.end()) {
    bytes_.shrink_to_fit();
    good = motion.read(bytes_.data(), bytes_.size());
  }

  mtn::Motion motion;
  bool good;

 private:
  std::vector<unsigned char> bytes_;
};

std::string problemOf(const std::string& bytes) {
  const ReadMotion read(bytes);
  EXPECT_NE(read.good, read.motion.problem()[0] != '\0') << read.motion.problem();
  EXPECT_TRUE(read.good || read.motion.numberOfKeyFrames() == 0);
  return read.motion.problem();
}

std::string little(std::uint32_t value, size_t size) {
  std::string bytes;
  for (size_t i = 0; i < size; ++i) {
    bytes.push_back(static_cast<char>(value >> (8 * i)));
  }
  return bytes;
}

class MotionFile : public ::testing::Test {
 protected:
  // Offsets in the sample's bytes.
  static constexpr size_t kSection0 = 4;
  static constexpr size_t kSection1 = kSection0 + 24;
  static constexpr size_t kSection2 = kSection1 + 8 + 24;
  static constexpr size_t kSection3 = kSection2 + 8 + 56;
  static constexpr size_t kKeyFrames = kSection3 + 8 + 4;

  std::string changed(size_t place, std::uint32_t value, size_t size) const {
    std::string bytes = sample_;
    return bytes.replace(place, size, little(value, size));
  }

  const std::string sample_ = motion_tool::encodeMtn(motion_tool::parseTextForm(
      "name SAMPLE\ncreator test\nrobot ERS-7\n"
      "at 0 head_pan 0 head_tilt 0\nat 160 head_pan 5 head_tilt -3\nat 480 head_pan -11 head_tilt 17\n"));
};

// The bytes of a file in Sony's format, written by hand.
TEST_F(MotionFile, KnowsSonysLayout) {
  const std::string section0 = little(0, 4) + little(24, 4) + little(4, 4) + little(1, 2) + little(2, 2) +
                               little(1, 2) + little(16, 2) + little(0xdeadbeef, 4);
  const std::string section1 = little(1, 4) + little(20, 4) + "\3HOP" + "\1I" + std::string("\1X") + "pad!";
  const std::string section2 = little(2, 4) + little(16, 4) + little(1, 2) + "\5PRM:a";
  const std::string section3 = little(3, 4) + little(28, 4) + little(0, 4) + std::string(12, '\xff') + little(4321, 4);
  const ReadMotion read("OMTN" + section0 + section1 + section2 + section3);
  ASSERT_TRUE(read.good) << read.motion.problem();
  EXPECT_THAT(read.motion.name(), StrEq("HOP"));
  EXPECT_THAT(read.motion.locator(0), StrEq("PRM:a"));
  EXPECT_EQ(read.motion.position(0, 0), 4321);
}

TEST_F(MotionFile, RefusesEveryTruncationAndSaysWhy) {
  for (size_t size = 0; size < sample_.size(); ++size) {
    EXPECT_NE(problemOf(sample_.substr(0, size)), "") << size << " bytes";
  }
  EXPECT_THAT(problemOf(""), HasSubstr("OMTN"));
  EXPECT_THAT(problemOf("\x1f\x8b\x08"), HasSubstr("it is gzipped; gzip -d unpacks it"));
  EXPECT_THAT(problemOf(sample_.substr(0, kSection2)), HasSubstr("before section 2"));
  EXPECT_THAT(problemOf(sample_.substr(0, kSection2 + 10)), HasSubstr("section 2 is cut off: 10 bytes of 64"));
}

TEST_F(MotionFile, IsRefusedForEachNumberThatIsWrong) {
  const size_t second = kKeyFrames + 5 * 4;
  const struct {
    size_t place;
    std::uint32_t value;
    size_t size;
    const char* problem;  // "" if it is accepted
  } rows[] = {
      {0, 0, 4, "OMTN"},
      {kSection0 + 8, 5, 4, "5 sections"},
      {kSection0, 7, 4, "the file has section 7"},
      {kSection3, 7, 4, "the file has section 7"},
      {kSection0 + 4, 7, 4, "claims to have 7 bytes"},
      {kSection0 + 4, 23, 4, "section 0 is shorter than 24 bytes"},
      {kSection1 + 4, 8, 4, "section 1 ends before the motion's name"},
      {kSection2 + 4, 9, 4, "section 2 has no number of joints"},
      {kSection3 + 4, 11, 4, "section 3 has no type of data"},
      {kSection3 + 4, 0xffffffff, 4, "section 3 is cut off"},
      {kSection0 + 12, 2, 2, "version 2.2"},
      {kSection0 + 16, 0, 2, "no key frames"},
      {kSection0 + 16, 2, 2, "2 key frames of 2 joints have 44"},
      {kSection0 + 16, 0xffff, 2, "65535 key frames"},
      {kSection0 + 18, 7, 2, "a frame of 7 ms"},
      {kSection0 + 18, 8, 2, ""},
      {kSection0 + 18, 1000, 2, ""},
      {kSection0 + 18, 1001, 2, "a frame of 1001 ms"},
      {kSection1 + 8, 255, 1, "within the motion's name"},
      {kSection1 + 8, 23, 1, "before the creator's name"},
      {kSection2 + 8, 0, 2, "0 joints are outside 1..32"},
      {kSection2 + 8, 32, 2, "joint 2 has no locator"},
      {kSection2 + 8, 33, 2, "33 joints are outside 1..32"},
      {kSection2 + 8, 3, 2, "joint"},
      {kSection2 + 11, 'p', 1, "joint 0 has no locator"},
      {kSection2 + 20, '\n', 1, "joint 0 has no locator"},
      {kSection2 + 20, 0xff, 1, "joint 0 has no locator"},
      {kSection3 + 8, 1, 4, "type 1"},
      {second, 3749, 4, ""},  // 60 s
      {second, 3750, 4, "3750 frames to key frame 1"},
      {second, 0xffffffff, 4, "more than 60 s"},
      {second + 16, 6283186, 4, "key frame 1, PRM:/r1/c1/c2-Joint2:12 is at 6283186"},
      {second + 20, 0x80000000, 4, "more than a turn"},
  };
  for (const auto& row : rows) {
    const std::string problem = problemOf(changed(row.place, row.value, row.size));
    EXPECT_EQ(problem.empty(), std::string(row.problem).empty()) << row.place << " " << row.value;
    EXPECT_THAT(problem, HasSubstr(row.problem)) << row.place << " " << row.value;
  }
}

TEST_F(MotionFile, HasAtMost64000BytesAndNoneAfterItsLastSection) {
  EXPECT_THAT(problemOf(sample_ + "x"), HasSubstr("1 bytes follow"));
  for (const size_t size : {64000U, 64001U}) {
    const size_t unused = size - sample_.size();  // bytes after the texts of section 1
    std::string bytes = changed(kSection1 + 4, static_cast<std::uint32_t>(kSection2 - kSection1 + unused), 4);
    bytes.insert(kSection2, unused, 'x');
    EXPECT_EQ(problemOf(bytes), size == 64000 ? "" : "it has 64001 bytes, and at most 64000 are allowed");
  }
}

TEST_F(MotionFile, RefusesAJointThatAppearsTwice) {
  std::string bytes = sample_;
  bytes.replace(bytes.find("\x1aPRM:/r1/c1/c2/c3-Joint2:13"), 27, "\x17PRM:/r1/c1/c2-Joint2:12\0\0\0", 27);
  EXPECT_THAT(problemOf(bytes), HasSubstr("joints 0 and 1 are both PRM:/r1/c1/c2-Joint2:12"));
}

}  // namespace
