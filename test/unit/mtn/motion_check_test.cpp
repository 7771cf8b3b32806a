#include <gmock/gmock.h>

#include "motion_tool/motion_tool.h"

namespace {

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

}  // namespace
