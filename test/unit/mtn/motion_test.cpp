#include "mtn/motion.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion_tool/motion_tool.h"
#include "sample_motion.h"

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

class MotionTest : public ::testing::Test {
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

  const std::string sample_ = motion_tool::encodeMtn(sampleMotion());
};

TEST_F(MotionTest, readsAWholeFile) {
  const ReadMotion read(sample_);
  const mtn::Motion& motion = read.motion;
  ASSERT_TRUE(read.good) << motion.problem();
  EXPECT_THAT(motion.name(), StrEq("SAMPLE"));
  EXPECT_THAT(motion.creator(), StrEq("test"));
  EXPECT_THAT(motion.design(), StrEq("DRX-1000"));
  EXPECT_EQ(motion.frameMilliseconds(), 16);
  ASSERT_EQ(motion.numberOfJoints(), 2);
  EXPECT_THAT(motion.locator(0), StrEq("PRM:/r1/c1/c2-Joint2:12"));
  EXPECT_THAT(motion.locator(1), StrEq("PRM:/r1/c1/c2/c3-Joint2:13"));
  ASSERT_EQ(motion.numberOfKeyFrames(), 3);
  EXPECT_EQ(motion.milliseconds(0), 0);
  EXPECT_EQ(motion.milliseconds(1), 160);
  EXPECT_EQ(motion.milliseconds(2), 320);
  EXPECT_EQ(motion.position(1, 0), 100000);
  EXPECT_EQ(motion.position(1, 1), -50000);
  EXPECT_EQ(motion.position(2, 0), -200000);
  EXPECT_EQ(motion.position(2, 1), 300000);
}

// The bytes of a file in Sony's format, written by hand.
TEST_F(MotionTest, knowsSonysLayout) {
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

TEST_F(MotionTest, refusesEveryTruncationAndSaysWhy) {
  for (size_t size = 0; size < sample_.size(); ++size) {
    EXPECT_NE(problemOf(sample_.substr(0, size)), "") << size << " bytes";
  }
  EXPECT_THAT(problemOf(""), HasSubstr("OMTN"));
  EXPECT_THAT(problemOf(sample_.substr(0, kSection2)), HasSubstr("before section 2"));
  EXPECT_THAT(problemOf(sample_.substr(0, kSection2 + 10)), HasSubstr("section 2 is cut off: 10 bytes of 64"));
}

TEST_F(MotionTest, refusesBytesAfterTheLastSection) {
  EXPECT_THAT(problemOf(sample_ + "x"), HasSubstr("1 bytes follow"));
}

TEST_F(MotionTest, refusesAFileThatIsTooLarge) {
  EXPECT_THAT(problemOf(sample_ + std::string(mtn::MAX_FILE_SIZE, '\0')), HasSubstr("at most 64000"));
  for (const size_t size : {64000U, 64001U}) {
    const size_t unused = size - sample_.size();  // bytes after the texts of section 1
    std::string bytes = changed(kSection1 + 4, static_cast<std::uint32_t>(kSection2 - kSection1 + unused), 4);
    bytes.insert(kSection2, unused, 'x');
    EXPECT_EQ(problemOf(bytes), size == 64000 ? "" : "it has 64001 bytes, and at most 64000 are allowed");
  }
}

TEST_F(MotionTest, refusesWrongSections) {
  EXPECT_THAT(problemOf(changed(0, 0, 4)), HasSubstr("OMTN"));
  EXPECT_THAT(problemOf(changed(kSection0 + 8, 5, 4)), HasSubstr("5 sections"));
  for (const size_t section : {kSection0, kSection1, kSection2, kSection3}) {
    EXPECT_THAT(problemOf(changed(section, 7, 4)), HasSubstr("the file has section 7"));
    for (const std::uint32_t size : {0U, 7U, 9U, 0x7fffffffU, 0xffffffffU}) {
      EXPECT_NE(problemOf(changed(section + 4, size, 4)), "") << "section at " << section << " of " << size << " bytes";
    }
    EXPECT_THAT(problemOf(changed(section + 4, 7, 4)), HasSubstr("claims to have 7 bytes"));
  }
  EXPECT_THAT(problemOf(changed(kSection0 + 4, 23, 4)), HasSubstr("section 0 is shorter than 24 bytes"));
  EXPECT_THAT(problemOf(changed(kSection1 + 4, 8, 4)), HasSubstr("section 1 ends before the motion's name"));
  EXPECT_THAT(problemOf(changed(kSection2 + 4, 9, 4)), HasSubstr("section 2 has no number of joints"));
  EXPECT_THAT(problemOf(changed(kSection3 + 4, 11, 4)), HasSubstr("section 3 has no type of data"));
}

TEST_F(MotionTest, refusesAbsurdNumbersInSection0) {
  EXPECT_THAT(problemOf(changed(kSection0 + 12, 2, 2)), HasSubstr("version 2.2"));
  EXPECT_THAT(problemOf(changed(kSection0 + 16, 0, 2)), HasSubstr("no key frames"));
  EXPECT_THAT(problemOf(changed(kSection0 + 16, 2, 2)), HasSubstr("2 key frames of 2 joints have 44"));
  EXPECT_THAT(problemOf(changed(kSection0 + 16, 0xffff, 2)), HasSubstr("65535 key frames"));
  EXPECT_THAT(problemOf(changed(kSection0 + 18, 0, 2)), HasSubstr("a frame of 0 ms"));
  EXPECT_THAT(problemOf(changed(kSection0 + 18, 7, 2)), HasSubstr("a frame of 7 ms"));
  EXPECT_EQ(problemOf(changed(kSection0 + 18, 8, 2)), "");
  EXPECT_EQ(problemOf(changed(kSection0 + 18, 1000, 2)), "");
  EXPECT_THAT(problemOf(changed(kSection0 + 18, 1001, 2)), HasSubstr("a frame of 1001 ms"));
}

TEST_F(MotionTest, refusesTextsThatLeaveTheirSection) {
  EXPECT_THAT(problemOf(changed(kSection1 + 8, 255, 1)), HasSubstr("within the motion's name"));
  EXPECT_THAT(problemOf(changed(kSection1 + 8, 23, 1)), HasSubstr("before the creator's name"));
}

TEST_F(MotionTest, refusesWrongJoints) {
  EXPECT_THAT(problemOf(changed(kSection2 + 8, 0, 2)), HasSubstr("0 joints are outside 1..32"));
  EXPECT_THAT(problemOf(changed(kSection2 + 8, 33, 2)), HasSubstr("33 joints are outside 1..32"));
  EXPECT_THAT(problemOf(changed(kSection2 + 8, 3, 2)), HasSubstr("joint"));
  EXPECT_THAT(problemOf(changed(kSection2 + 11, 'p', 1)), HasSubstr("joint 0 has no locator"));
  for (const unsigned char character : {'\n', ' ', '\x7f', '\xff'}) {
    EXPECT_THAT(problemOf(changed(kSection2 + 20, character, 1)), HasSubstr("joint 0 has no locator"));
  }
}

TEST_F(MotionTest, takesAsManyJointsAndCharactersAsItHasRoomFor) {
  motion_tool::KeyFrameMotion motion = sampleMotion();
  motion.name.assign(mtn::MAX_TEXT_SIZE, 'n');
  motion.locators.clear();
  for (int i = 0; i < mtn::MAX_JOINTS; ++i) {
    motion.locators.push_back("PRM:" + std::string(mtn::MAX_LOCATOR_SIZE - 6, 'j') + std::to_string(10 + i));
  }
  motion.key_frames = {{0, std::vector<int>(mtn::MAX_JOINTS, mtn::MAX_POSITION)},
                       {160, std::vector<int>(mtn::MAX_JOINTS, -mtn::MAX_POSITION)}};
  const std::string bytes = motion_tool::encodeMtn(motion);
  const ReadMotion read(bytes);
  ASSERT_TRUE(read.good) << read.motion.problem();
  EXPECT_EQ(read.motion.name(), motion.name);
  EXPECT_EQ(read.motion.locator(mtn::MAX_JOINTS - 1), motion.locators.back());
  EXPECT_EQ(read.motion.position(1, mtn::MAX_JOINTS - 1), -mtn::MAX_POSITION);
  motion.locators.back() += "j";
  try {
    motion_tool::encodeMtn(motion);
    ADD_FAILURE() << "a locator is too long";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("a joint's locator has 64 characters, more than 63"));
  }
  motion.name += "n";
  try {
    motion_tool::encodeMtn(motion);
    ADD_FAILURE() << "a name is too long";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("a text has more than 255 characters: nnn"));
  }
}

TEST_F(MotionTest, refusesAJointThatAppearsTwice) {
  std::string bytes = sample_;
  bytes.replace(bytes.find("\x1aPRM:/r1/c1/c2/c3-Joint2:13"), 27, "\x17PRM:/r1/c1/c2-Joint2:12\0\0\0", 27);
  EXPECT_THAT(problemOf(bytes), HasSubstr("joints 0 and 1 are both PRM:/r1/c1/c2-Joint2:12"));
}

TEST_F(MotionTest, refusesAbsurdKeyFrames) {
  const size_t second = kKeyFrames + 5 * 4;
  EXPECT_THAT(problemOf(changed(kSection3 + 8, 1, 4)), HasSubstr("type 1"));
  EXPECT_THAT(problemOf(changed(second, 3749, 4)), "") << "60 s";
  EXPECT_THAT(problemOf(changed(second, 3750, 4)), HasSubstr("3750 frames to key frame 1"));
  EXPECT_THAT(problemOf(changed(second, 0xffffffff, 4)), HasSubstr("more than 60 s"));
  EXPECT_THAT(problemOf(changed(second + 16, 6283186, 4)),
              HasSubstr("key frame 1, PRM:/r1/c1/c2-Joint2:12 is at 6283186"));
  EXPECT_THAT(problemOf(changed(second + 20, 0x80000000, 4)), HasSubstr("more than a turn"));
}

TEST_F(MotionTest, isEmptyAfterAnInvalidFile) {
  mtn::Motion motion;
  const auto* bytes = reinterpret_cast<const unsigned char*>(sample_.data());
  ASSERT_TRUE(motion.read(bytes, sample_.size()));
  EXPECT_FALSE(motion.read(bytes, sample_.size() - 1));
  EXPECT_EQ(motion.numberOfJoints(), 0);
  EXPECT_EQ(motion.numberOfKeyFrames(), 0);
  EXPECT_EQ(motion.frameMilliseconds(), 0);
  EXPECT_EQ(std::string(motion.name()) + motion.creator() + motion.design(), "");
  ASSERT_TRUE(motion.read(bytes, sample_.size()));
  EXPECT_THAT(motion.problem(), StrEq(""));
}

// ------------------------------------------------------------------------------------------------------ any bytes

// Reads everything in an accepted file. AddressSanitizer finds reads outside it.
long sumOfAll(const mtn::Motion& motion) {
  long sum = 0;
  for (int i = 0; i < motion.numberOfKeyFrames(); ++i) {
    sum += motion.milliseconds(i);
    for (int joint = 0; joint < motion.numberOfJoints(); ++joint) {
      EXPECT_LE(std::abs(motion.position(i, joint)), mtn::MAX_POSITION);
      sum += motion.position(i, joint);
    }
  }
  return sum;
}

// MTN_RANDOM_FILES sets a larger number than the quick test's.
int randomFiles() {
  const char* wanted = std::getenv("MTN_RANDOM_FILES");
  return wanted != nullptr ? std::atoi(wanted) : 20000;
}

TEST_F(MotionTest, survivesRandomBytes) {
  std::mt19937 random(1);
  for (int i = 0; i < randomFiles(); ++i) {
    std::string bytes(random() % 300, '\0');
    for (char& byte : bytes) {
      byte = static_cast<char>(random());
    }
    EXPECT_NE(problemOf(bytes), "");
    EXPECT_NE(problemOf("OMTN" + bytes), "");
  }
}

TEST_F(MotionTest, survivesDamagedFiles) {
  std::mt19937 random(2);
  int accepted = 0;
  for (int i = 0; i < randomFiles(); ++i) {
    std::string bytes = sample_;
    for (unsigned damages = 1 + random() % 4; damages > 0; --damages) {
      const size_t place = random() % bytes.size();
      switch (random() % 4) {
        case 0:
          bytes[place] = static_cast<char>(random());
          break;
        case 1:
          bytes[place] = static_cast<char>(bytes[place] ^ (1 << (random() % 8)));
          break;
        case 2:
          bytes.erase(place, random() % 8);
          break;
        default:
          bytes.insert(place, random() % 8, static_cast<char>(random()));
          break;
      }
      if (bytes.empty()) {
        break;
      }
    }
    const ReadMotion read(bytes);
    if (read.good) {
      ++accepted;
      sumOfAll(read.motion);
    }
  }
  EXPECT_GT(accepted, 0) << "damage that only changes a position keeps the file valid";
}

}  // namespace
