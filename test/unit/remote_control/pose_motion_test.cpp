#include "remote_control/pose_motion.h"

#include <gmock/gmock.h>

#include "movement/joint_table.h"

namespace aibo_driver::remote_control {
namespace {

/// The pose in which all joints but these are at 0, or at the limit that is nearest to it.
Pose poseWith(const std::string& design, const Pose& differences) {
  Pose pose = differences;
  const movement::JointTable table(design, movement::kNoSpeedLimit);
  for (const movement::JointProperties& joint : table.joints()) {
    pose.emplace(joint.name, 0.0);
  }
  return pose;
}

TEST(PoseMotion, GoesFromPoseToPoseNoFasterThanTheJointsCan) {
  struct Row {
    const char* name;
    const char* design;
    std::vector<Pose> poses;
    double seconds;
    std::vector<std::string> text;
    double duration;
    std::string remark;
  };
  const Row rows[] = {
      {"one pose", "ERS-7", {{{"head_pan", 0.5}}}, 1, {"robot ERS-7\n", "at 0\n", " head_pan 28.6\n"}, 0, ""},
      {"another robot", "ERS-210", {{}, {}}, 1, {"robot ERS-210\n", "at 1000\n"}, 1, ""},
      {"three", "ERS-7", {{}, {{"mouth", -0.5}}, {}}, 0.8, {"at 800\n", " mouth -28.6\n", "at 1600\n"}, 1.6, ""},
      {"60 s", "ERS-7", {{}, {}}, 60, {"at 60000\n"}, 60, ""},
      {"176 degrees of 576 a second",
       "ERS-7",
       {{{"head_pan", -2}}, {{"head_pan", 2}}},
       0.1,
       {" head_pan -88\n", "at 320\n", " head_pan 88\n"},
       0.32,
       ""},
      {"a head that would hit the body",
       "ERS-7",
       {{{"neck_tilt", -1.3}, {"head_tilt", -0.26}}},
       1,
       {},
       0,
       "on an ERS-7, head_tilt is clipped"},
  };
  for (const Row& row : rows) {
    std::vector<Pose> poses;
    for (const Pose& pose : row.poses) {
      poses.push_back(poseWith(row.design, pose));
    }
    const PoseMotion motion = makePoseMotion("WAVE", row.design, poses, row.seconds);
    for (const std::string& part : row.text) {
      EXPECT_THAT(motion.text, testing::HasSubstr(part)) << row.name;
    }
    EXPECT_DOUBLE_EQ(motion.duration, row.duration) << row.name;
    EXPECT_EQ(motion.remark.substr(0, row.remark.size()), row.remark) << row.name;
    EXPECT_EQ(motion.remark.empty(), row.remark.empty()) << row.name << ": " << motion.remark;
    EXPECT_EQ(motion.bytes.substr(0, 4), "OMTN") << row.name;
  }
}

TEST(PoseMotion, WhatCannotBeAMotionFileIsRefusedInWords) {
  const std::tuple<const char*, std::size_t, const char*> rows[] = {
      {"ERS-7", 0, "there is no key frame"},
      {"ERS-7", 1000, "at most 64000 are allowed"},
      {"R2D2", 1, "no table of a robot named 'R2D2'"},
  };
  for (const auto& [design, size, words] : rows) {
    try {
      makePoseMotion("WAVE", design, std::vector<Pose>(size, poseWith("ERS-7", {})), 1);
      ADD_FAILURE() << words;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(words));
    }
  }
}

}  // namespace
}  // namespace aibo_driver::remote_control
