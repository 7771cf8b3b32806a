#include "joints/joint_link.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::joints {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Writes down what the robot is told.
class JointLinkTest : public ::testing::Test {
 protected:
  JointLink makeLink() {
    JointLink::Robot robot;
    robot.connections = [this] { return connections_; };
    robot.set_speed_limits = [this](const std::vector<JointSpeedLimit>& limits) {
      for (const JointSpeedLimit& limit : limits) {
        told_.push_back("V " + std::to_string(limit.id) + " " + std::to_string(limit.speed).substr(0, 4));
      }
    };
    robot.command = [this](const std::vector<JointTarget>& targets, milliseconds duration) {
      if (broken_) {
        throw NetworkException("broken");
      }
      std::string text = "J";
      for (const JointTarget& target : targets) {
        text += " " + std::to_string(target.id) + ":" + std::to_string(target.position).substr(0, 4);
      }
      told_.push_back(text + " in " + std::to_string(duration.count()));
    };
    return JointLink(robot);
  }

  std::uint64_t connections_ = 1;
  bool broken_ = false;
  std::vector<std::string> told_;
  JointLink link_ = makeLink();
};

TEST_F(JointLinkTest, SendsOrdersGivenTogetherTogether) {
  link_.send({{1, 0.5, 2.0}, {2, 0.25, 2.0}}, milliseconds(40));
  EXPECT_THAT(told_, ElementsAre("V 1 2.00", "V 2 2.00", "J 1:0.50 2:0.25 in 40"));
}

TEST_F(JointLinkTest, SendsASpeedLimitOnlyWhenItChanges) {
  link_.send({{1, 0.5, 2.0}, {2, 0.25, 2.0}}, milliseconds(0));
  told_.clear();
  link_.send({{1, 0.5, 2.0}, {2, 0.25, 1.0}}, milliseconds(0));
  EXPECT_THAT(told_, ElementsAre("V 2 1.00", "J 1:0.50 2:0.25 in 0"));
}

TEST_F(JointLinkTest, SendsSpeedLimitsAgainOverANewConnection) {
  link_.send({{1, 0.5, 2.0}}, milliseconds(0));
  told_.clear();
  connections_ = 2;
  link_.send({{1, 0.5, 2.0}}, milliseconds(0));
  EXPECT_THAT(told_, ElementsAre("V 1 2.00", "J 1:0.50 in 0"));
}

TEST_F(JointLinkTest, LimitsSpeedsWithoutMovingAndRemembersThem) {
  link_.send({{1, 0.5, 0.5}, {2, 0.25, 2.0}}, milliseconds(0));
  told_.clear();
  link_.limitSpeeds({{1, 2.0}, {2, 2.0}});
  EXPECT_THAT(told_, ElementsAre("V 1 2.00"));
  told_.clear();
  link_.limitSpeeds({{1, 2.0}, {2, 2.0}});
  EXPECT_THAT(told_, IsEmpty());
  link_.send({{1, 0.5, 0.5}}, milliseconds(0));
  EXPECT_THAT(told_, ElementsAre("V 1 0.50", "J 1:0.50 in 0"));
}

TEST_F(JointLinkTest, SendsNothingWithoutOrders) {
  link_.send({}, milliseconds(0));
  EXPECT_THAT(told_, IsEmpty());
}

TEST_F(JointLinkTest, TellsWhenTheRobotCannotBeTold) {
  broken_ = true;
  EXPECT_THROW(link_.send({{1, 0.5, 2.0}}, milliseconds(0)), NetworkException);
}

}  // namespace
}  // namespace aibo_driver::joints
