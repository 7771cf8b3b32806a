#include "motion_tool/motion_tool.h"

#include <gmock/gmock.h>

namespace {

// What a function of motion_tool.h says of a motion of an ERS-7 on this robot.
template <typename Result>
Result verdict(Result (*function)(const mtn::Motion&, const robot_model::RobotModel&), const std::string& key_frames,
               const std::string& on) {
  std::istringstream text("robot ERS-7\n" + key_frames);
  std::string bytes = motion_tool::encodeMtn(motion_tool::parseTextForm(text));
  mtn::Motion motion;
  EXPECT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
  // The body's yaw, before the positions of the last key frame, is no joint's.
  bytes[bytes.size() - static_cast<std::size_t>(motion.numberOfJoints()) * mtn::VALUE_SIZE - 1] = '\xff';
  return function(motion, *robot_model::findRobotModel(on.c_str()));
}

std::vector<std::string> obstaclesOf(const std::string& key_frames, const std::string& on = "ERS-7") {
  return verdict(motion_tool::findObstacles, key_frames, on);
}

std::string changesOf(const std::string& key_frames, const std::string& on = "ERS-7") {
  return verdict(motion_tool::describeChanges, key_frames, on);
}

TEST(MotionCheck, FindsWhatAnErs7CannotDo) {
  const struct {
    const char* motion;
    std::vector<const char*> obstacles;
  } rows[] = {
      {"at 0 neck_tilt -60 head_tilt 5\nat 1600 neck_tilt 0 head_tilt -5\n", {}},
      {"at 0 head_pan 88.0009 neck_tilt -60 head_tilt 4.9991\nat 16 neck_tilt -57.0793\n", {}},
      {"at 0 head_tilt -15\n", {}},  // a joint that is not in it is out of the way
      {"at 0 head_pan 0 left_ear 0 right_ear 0\nat 16 left_ear 1\n", {}},
      {"at 0 head_pan 0\nat 1600 head_pan 88.5\nat 3200 head_pan -88.5\n",
       {"at 1600 ms, head_pan is at 88.5 degrees, outside -88.0 to 88.0", "at 3200 ms, head_pan is at -88.5 degrees"}},
      {"at 0 neck_tilt -60 head_tilt 4\n",
       {"at 0 ms, head_tilt is below 5.0 degrees, where it hits neck_tilt at -60.0"}},
      {"at 0 mouth -40 head_tilt 4 left_front_rotator -22 left_front_elevator -9.5\n",
       {"hits left_front_rotator at", "hits mouth at"}},
      {"at 0 neck_tilt -10\nat 160 neck_tilt -50\n",
       {"at 160 ms, neck_tilt would have moved at 250.0 degrees a second, above its limit of 182.5"}},
  };
  for (const auto& row : rows) {
    const std::vector<std::string> found = obstaclesOf(row.motion);
    ASSERT_EQ(found.size(), row.obstacles.size()) << row.motion;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_THAT(found[i], testing::HasSubstr(row.obstacles[i]));
    }
  }
  EXPECT_THAT(obstaclesOf("at 0 head_pan 0\n", "ERS-210"),
              testing::ElementsAre(testing::HasSubstr("an ERS-210 has no joint PRM:/r1/c1/c2-Joint2:12")));
}

TEST(MotionCheck, SaysInOneLineWhatARobotDoesDifferently) {
  EXPECT_EQ(changesOf("at 0 head_pan 0\nat 1600 head_pan 80\n"), "");
  EXPECT_EQ(changesOf("at 0 head_pan 0\nat 1600 head_pan 90\nat 3200 head_pan -90\nat 3232 head_pan -60\n"),
            "on an ERS-7, 2 positions are clipped, by up to 2.0 degrees (head_pan at 1600 ms); "
            "1 step is too fast, so it takes 3.25 s, which is 0.02 s longer");
  EXPECT_EQ(changesOf("at 0 head_pan 100\n"),
            "an ERS-7 does not play it: it moves head_pan to 100.0 degrees at 0 ms, 12.0 beyond what it can do there; "
            "up to 5.0 are clipped");
}

}  // namespace
