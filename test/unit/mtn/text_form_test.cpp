#include "motion_tool/motion_tool.h"

#include <gmock/gmock.h>

#include <stdexcept>
#include <utility>

#include "support/refusal.h"
#include "support/temporary_folder.h"

namespace {

using motion_tool::KeyFrameMotion;
using test_support::contentOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

KeyFrameMotion parse(const std::string& text) {
  return motion_tool::parseTextForm(text);
}

std::string problemOf(const std::string& text) {
  return test_support::refusalOf<std::runtime_error>([&] { motion_tool::encodeMtn(parse(text)); });
}

std::string print(const std::string& bytes) {
  mtn::Motion motion;
  EXPECT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
  return motion_tool::printTextForm(motion);
}

TEST(TextForm, IsParsed) {
  const KeyFrameMotion motion = parse(
      "# a comment\r\n"
      "name  HELLO WORLD \r\n"
      "creator me\n"
      "robot ERS-7\n"
      "frame 8\n"
      "\n"
      "at 0 head_pan 0 head_tilt 10  # degrees\n"
      "at 80 head_tilt 20.5\n"
      "  head_pan -1\n"
      "at 160\n");
  EXPECT_EQ(motion.name, "HELLO WORLD");
  EXPECT_EQ(motion.creator, "me");
  EXPECT_EQ(motion.design, "DRX-1000");
  EXPECT_EQ(motion.frame_milliseconds, 8);
  EXPECT_THAT(motion.locators, ElementsAre("PRM:/r1/c1/c2-Joint2:12", "PRM:/r1/c1/c2/c3-Joint2:13"));
  ASSERT_EQ(motion.key_frames.size(), 3U);
  EXPECT_THAT(motion.key_frames[0].positions, ElementsAre(0, 174533));
  EXPECT_EQ(motion.key_frames[1].milliseconds, 80);
  EXPECT_THAT(motion.key_frames[1].positions, ElementsAre(-17453, 357792));
  EXPECT_EQ(motion.key_frames[2].milliseconds, 160);
  EXPECT_EQ(motion.key_frames[2].positions, motion.key_frames[1].positions);
}

// TextInAFile has what else editors write.
TEST(TextForm, IsParsedWhateverEditorWroteIt) {
  EXPECT_EQ(motion_tool::encodeMtn(parse("\xef\xbb\xbf# \xfc\x04\x1a\x85\r\nname NOD\r\nrobot ERS-7\r\n"
                                         "at 0 head_pan 0 # gr\xc3\xbcn\r\nat 320 head_pan 10\r\n\x1a")),
            motion_tool::encodeMtn(parse("name NOD\nrobot ERS-7\nat 0 head_pan 0\nat 320 head_pan 10")));
}

TEST(TextForm, NamesTheEarsAndTheirStates) {
  const std::string text = "robot ERS-7\nat 0 left_ear 0 right_ear -1\nat 16 left_ear 1000000\n";
  const KeyFrameMotion motion = parse(text);
  EXPECT_THAT(motion.locators, ElementsAre("PRM:/r1/c1/c2/c3/e5-Joint4:15", "PRM:/r1/c1/c2/c3/e6-Joint4:16"));
  EXPECT_THAT(motion.key_frames[1].positions, ElementsAre(1000000, -1)) << "not in degrees";
  const std::string bytes = motion_tool::encodeMtn(motion);
  EXPECT_THAT(print(bytes), HasSubstr("at 16\n  left_ear 1000000\n  right_ear -1\n"));
  EXPECT_EQ(motion_tool::encodeMtn(parse(print(bytes))), bytes);
  EXPECT_THAT(parse("robot ERS-210\nat 0 left_ear 0\n").locators, ElementsAre("PRM:/r1/c1/c2/c3/e1-Joint3:j5"));
  EXPECT_THAT(problemOf("robot ERS-7\nat 0 left_ear 0.5\n"), HasSubstr("\"0.5\" is not a number of states"));
  for (const std::string state : {"6283186", "-6283186"}) {
    EXPECT_THAT(problemOf("robot ERS-7\nat 0 left_ear " + state + "\n"),
                HasSubstr("left_ear has a state that does not fit"));
  }
}

TEST(TextForm, SurvivesTheRoundTrip) {
  KeyFrameMotion motion = parse("robot ERS-7\nat 0 head_pan 0 head_tilt 0\nat 160 head_pan 5 head_tilt -3\n");
  motion.key_frames[1].positions = {1234567, -7654};
  const std::string bytes = motion_tool::encodeMtn(motion);
  const std::string text = print(bytes);
  EXPECT_THAT(text, HasSubstr("robot ERS-7\n"));
  EXPECT_THAT(text, HasSubstr("head_pan 70.73548\n"));
  EXPECT_EQ(motion_tool::encodeMtn(parse(text)), bytes);
}

TEST(TextForm, PrintsNoControlCharacters) {
  KeyFrameMotion motion = parse("robot ERS-7\nat 0 head_pan 0\n");
  motion.name = "#\x1b[2J\n#";
  EXPECT_THAT(print(motion_tool::encodeMtn(motion)), HasSubstr("name ??[2J??\n"));
}

TEST(TextForm, NamesTheLineOfAMistake) {
  const std::string begin = "robot ERS-7\nat 0 head_pan 1\n";
  const std::pair<std::string, std::string> rows[] = {
      {"", "no key frame"},
      {"robot ERS-7\nhead_pan 1\n", "line 2: \"head_pan\" comes before the first \"at\""},
      {"at 0 head_pan 1\n", "line 1: which robot?"},
      {"robot ERS-7\nat 16 head_pan 1\n", "line 2: the first key frame must be at 0 ms"},
      {"\xef\xbb\xbf" + begin + "n\xc3\xbc 1\n", "line 3: an ERS-7 has no joint \"n\xc3\xbc\""},
      {begin + "\x1a\nat 16\n", "line 3: \x1a has no angle"},
      {begin + "at 16 head_pan 1\xc2\xb0\n", "line 3: \"1\xc2\xb0\" is not a number"},
      {begin + "at 32\nat 16\n", "line 4: the key frames are not in the order"},
      {begin + "at 16 head_pan\n", "line 3: head_pan has no angle"},
      {begin + "at 16 tail_pan 1\n", "line 3: tail_pan is not in the first key frame"},
      {begin + "at 160000\n", "more than 60 s"},
      {"name " + std::string(256, 'n') + "\n" + begin, "more than 255 characters"},
      {"frame 7\n" + begin, "line 1: a frame of 7 ms is outside 8..1000 ms"},
      {"frame 1001\n" + begin, "line 1: a frame of 1001 ms"},
      {begin + "frame 16\n", "line 3: \"frame\" comes before the first \"at\""},
  };
  for (const auto& [text, problem] : rows) {
    EXPECT_THAT(problemOf(text), HasSubstr(problem)) << text;
  }
  EXPECT_EQ(problemOf("name " + std::string(255, 'n') + "\n" + begin), "");
}

TEST(TextForm, ALineForATerminalHasNothingThatATerminalObeys) {
  EXPECT_EQ(motion_tool::forTerminal("Gr\xc3\xbc\xc3\x9f.mtn is cut off"), "Gr\xc3\xbc\xc3\x9f.mtn is cut off");
  EXPECT_EQ(motion_tool::forTerminal("DRX\x1b]0;title\x07"), "DRX?]0;title?");
  EXPECT_EQ(motion_tool::forTerminal("\xe2\x80\xae"), "???");
}

TEST(TextForm, NamesAllMistakesAtOnce) {
  EXPECT_EQ(problemOf("robot ERS-7\nat 0 head_pan 1 left_wing 2 mouth -5\nat 20 head_pan x mouth -400\n  mouth -10\n"
                      "at soon\nat 33\n"),
            "line 2: an ERS-7 has no joint \"left_wing\"\n"
            "line 3: 20 ms is not a multiple of a frame, which has 16 ms; 16 and 32 are\n"
            "line 3: \"x\" is not a number of degrees\n"
            "line 3: mouth is more than a turn away\n"
            "line 5: \"soon\" is not a number of milliseconds\n"
            "line 6: 33 ms is not a multiple of a frame, which has 16 ms; 32 and 48 are");
}

// Sony's motions name their robot in many ways.
TEST(MotionCheck, JointsDecideWhichRobotAMotionIsFor) {
  const struct {
    const char* key_frames;
    const char* design;
    const char* robot;  // null: none
  } rows[] = {
      {"at 0 head_pan 0 neck_tilt 0\n", "DRX-1000_Head", "ERS-7"},
      {"at 0 tail_pan 0\n", "DRX-1000_Tail", "ERS-7"},
      {"at 0 left_ear 0 right_ear 0\n", "DRX-1000_Ear", "ERS-7"},
      {"at 0 mouth -10\n", "", "ERS-7"},
      {"at 0 head_pan 0 tail_pan 0 PRM:/r1/c1/c2/c3-Joint2:j3 0\n", "DRX-910", "ERS-7"},
      {"at 0 head_pan 0 PRM:/r1/c1/c2/c3-Joint2:j3 0\n", "DRX-910", "ERS-210"},
      {"at 0 PRM:/r1/c1/c2/c3-Joint2:j3 0\n", "DRX-1000_Head", "ERS-210"},
      {"at 0 PRM:/r1/c1/c2/c3/e1-Joint3:j5 0\n", "DRX-910_Ear", "ERS-210"},
      {"at 0 PRM:/r9/c1-Joint2:91 0\n", "DRX-1000", nullptr},
  };
  for (const auto& row : rows) {
    motion_tool::KeyFrameMotion content = motion_tool::parseTextForm(std::string("robot ERS-7\n") + row.key_frames);
    content.design = row.design;
    const std::string bytes = motion_tool::encodeMtn(content);
    mtn::Motion motion;
    EXPECT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
    const robot_model::RobotModel* robot = motion_tool::robotOf(motion);
    EXPECT_EQ(robot, row.robot == nullptr ? nullptr : robot_model::findRobotModel(row.robot)) << row.key_frames;
  }
}

// The motions on the memory stick.
const char* const kMotions[] = {"LIE", "NOD", "WAG", "SIT"};

TEST(ShippedMotions, AreMadeFromTheirSources) {
  for (const std::string name : kMotions) {
    const std::string source = contentOf(MOTION_SOURCES "/" + name + ".txt");
    EXPECT_EQ(contentOf(MOTIONS "/" + name + ".MTN"), motion_tool::encodeMtn(motion_tool::parseTextForm(source)))
        << name << ": make it again: docs/motions.md";
  }
}

TEST(ShippedMotions, CanBeDoneByAnErs7AndEndWhereTheyBegan) {
  for (const std::string name : kMotions) {
    const std::string bytes = contentOf(MOTIONS "/" + name + ".MTN");
    mtn::Motion motion;
    ASSERT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
    EXPECT_EQ(motion_tool::describeChanges(motion, *robot_model::findRobotModel("ERS-7")), "") << name;
    for (int joint = 0; joint < motion.numberOfJoints(); ++joint) {
      EXPECT_EQ(motion.position(motion.numberOfKeyFrames() - 1, joint), motion.position(0, joint)) << name << joint;
    }
  }
}

}  // namespace
