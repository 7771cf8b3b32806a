#include "movement/joint_link.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "support/fake_client.h"

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class JointLinkTest : public ::testing::Test {
 protected:
  test_support::FakeClient client_;
  std::vector<std::string>& told_ = client_.told;
  JointLink link_{client_};
};

TEST_F(JointLinkTest, SendsAllOrdersInOneRequest) {
  link_.send({{1, {0.5, 2.0}}, {2, {0.25, 2.0}}}, milliseconds(40));
  EXPECT_THAT(told_, ElementsAre("V 1:2.00", "V 2:2.00", "J 1:0.50 2:0.25 in 40"));
}

TEST_F(JointLinkTest, SendsASpeedLimitOnlyWhenItChanges) {
  link_.send({{1, {0.5, 2.0}}, {2, {0.25, 2.0}}}, milliseconds(0));
  told_.clear();
  link_.send({{1, {0.5, 2.0}}, {2, {0.25, 1.0}}}, milliseconds(0));
  EXPECT_THAT(told_, ElementsAre("V 2:1.00", "J 1:0.50 2:0.25 in 0"));
}

TEST_F(JointLinkTest, SendsSpeedLimitsAgainOverANewConnection) {
  link_.send({{1, {0.5, 2.0}}}, milliseconds(0));
  told_.clear();
  client_.connections = 2;
  link_.send({{1, {0.5, 2.0}}}, milliseconds(0));
  EXPECT_THAT(told_, ElementsAre("V 1:2.00", "J 1:0.50 in 0"));
}

TEST_F(JointLinkTest, SendsSpeedLimitsAgainThatCouldNotBeSent) {
  client_.problem = "there is no robot";
  EXPECT_THROW(link_.send({{1, {0.5, 2.0}}}, milliseconds(0)), aibo_client::NetworkException);
  client_.problem.clear();
  link_.send({{1, {0.5, 2.0}}}, milliseconds(0));
  EXPECT_THAT(told_, ElementsAre("V 1:2.00", "J 1:0.50 in 0"));
}

TEST_F(JointLinkTest, LimitsSpeedsWithoutMovingAndRemembersThem) {
  link_.send({{1, {0.5, 0.5}}, {2, {0.25, 2.0}}}, milliseconds(0));
  told_.clear();
  link_.limitSpeeds({{1, 2.0}, {2, 2.0}});
  EXPECT_THAT(told_, ElementsAre("V 1:2.00"));
  told_.clear();
  link_.limitSpeeds({{1, 2.0}, {2, 2.0}});
  EXPECT_THAT(told_, IsEmpty());
  link_.send({{1, {0.5, 0.5}}}, milliseconds(0));
  EXPECT_THAT(told_, ElementsAre("V 1:0.50", "J 1:0.50 in 0"));
}

TEST_F(JointLinkTest, SendsNothingToARobotOfAnotherDesign) {
  JointLink link{client_, "ERS-7"};
  client_.present.robot.design = "ERS-210";
  EXPECT_THROW(link.send({{1, {0.5, 2.0}}}, milliseconds(0)), aibo_client::CommandException);
  EXPECT_THROW(link.limitSpeeds({{1, 2.0}}), aibo_client::CommandException);
  EXPECT_THAT(told_, IsEmpty());
  client_.present.robot.design = "ERS-7";
  link.send({{1, {0.5, 2.0}}}, milliseconds(0));
  EXPECT_THAT(told_, ElementsAre("V 1:2.00", "J 1:0.50 in 0"));
}

TEST_F(JointLinkTest, SendsToARobotThatDoesNotSayItsDesign) {
  JointLink link{client_, "ERS-7"};
  link.send({{1, {0.5, 2.0}}}, milliseconds(0));
  EXPECT_THAT(told_, ElementsAre("V 1:2.00", "J 1:0.50 in 0")) << "a version 1 server";
}

TEST_F(JointLinkTest, SendsNothingWithoutOrders) {
  link_.send({}, milliseconds(0));
  EXPECT_THAT(told_, IsEmpty());
}

TEST_F(JointLinkTest, ThrowsIfTheRobotCannotBeReached) {
  client_.problem = "broken";
  EXPECT_THROW(link_.send({{1, {0.5, 2.0}}}, milliseconds(0)), aibo_client::NetworkException);
}

}  // namespace
}  // namespace aibo_driver::movement
