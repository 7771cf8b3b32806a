#include "body/led_names.h"

#include <gmock/gmock.h>

namespace aibo_driver::body {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
}

TEST(LedNames, AreThoseOfLedsAndGroups) {
  EXPECT_THAT(findLeds("face_1", ers7()), ElementsAre(7));
  EXPECT_THAT(findLeds("face", ers7()), SizeIs(14));
  EXPECT_THAT(findLeds("all", ers7()), SizeIs(26));
  EXPECT_THAT(findLeds("nose", ers7()), IsEmpty());
}

TEST(LedNames, AreListedAndEachIsKnown) {
  for (const std::string& name : namesOfLeds(ers7())) {
    EXPECT_THAT(findLeds(name, ers7()), Not(IsEmpty())) << name;
  }
  EXPECT_THAT(namesOfLeds(ers7()), Contains("back"));
  EXPECT_THAT(namesOfLeds(ers7()), Not(Contains("tail")));  // an ERS-7 has none there
}

TEST(LedLevel, IsNeverOffAboveZero) {
  EXPECT_EQ(ledLevel(0), 0);
  EXPECT_EQ(ledLevel(0.0001), 1);
  EXPECT_EQ(ledLevel(0.2F), 51) << "the float is a little more than 0.2";
  EXPECT_EQ(ledLevel(1), 255);
}

}  // namespace
}  // namespace aibo_driver::body
