#include "movement/joint_targets.h"

#include <gmock/gmock.h>

#include <chrono>

#include "aibo_client/exceptions.h"
#include "support/fake_client.h"

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class JointTargetsTest : public ::testing::Test {
 protected:
  void send(const JointTargets& targets) { sendTargets(client_, "ERS-7", targets, milliseconds(40)); }

  test_support::FakeClient client_;
};

TEST_F(JointTargetsTest, AreSentInOneRequest) {
  send({{1, {1, 0.5, 2.0}}, {2, {2, 0.25, 2.0}}});
  EXPECT_THAT(client_.told, ElementsAre("V 1:2.00", "V 2:2.00", "J 1:0.50 2:0.25 in 40"));
}

TEST_F(JointTargetsTest, SendsNothingToARobotOfAnotherDesign) {
  client_.present.robot.design = "ERS-210";
  EXPECT_THROW(send({{1, {1, 0.5, 2.0}}}), aibo_client::CommandException);
  EXPECT_THAT(client_.told, IsEmpty());
  client_.present.robot.design = "ERS-7";
  send({{1, {1, 0.5, 2.0}}});
  EXPECT_THAT(client_.told, ElementsAre("V 1:2.00", "J 1:0.50 in 40"));
}

TEST_F(JointTargetsTest, ThrowIfTheRobotCannotBeReached) {
  client_.problem = "broken";
  EXPECT_THROW(send({{1, {1, 0.5, 2.0}}}), aibo_client::NetworkException);
}

}  // namespace
}  // namespace aibo_driver::movement
