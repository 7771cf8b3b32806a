#include "node/body/led_memory.h"

#include <gmock/gmock.h>

#include <cmath>

namespace aibo_driver::node {
namespace {

using aibo_client::LedMode;

class LedMemoryTest : public ::testing::Test {
 protected:
  bool connect(int protocol_version) {
    aibo_client::ConnectionStatus status;
    status.state = aibo_client::ConnectionState::kConnected;
    status.protocol_version = protocol_version;
    return memory_.update(status);
  }

  bool disconnect() { return memory_.update(aibo_client::ConnectionStatus()); }

  float intensity(int id) const { return memory_.states().intensities.at(static_cast<std::size_t>(id) - 1); }
  int mode(int id) const { return memory_.states().modes.at(static_cast<std::size_t>(id) - 1); }

  LedMemory memory_{*robot_model::findRobotModel("ERS-7")};
};

TEST_F(LedMemoryTest, KnowsNothingWithoutAConnection) {
  EXPECT_THAT(memory_.states().names, testing::SizeIs(26));
  EXPECT_THAT(memory_.states().intensities, testing::SizeIs(26));
  EXPECT_THAT(memory_.states().intensities, testing::Each(::testing::IsNan()));
  EXPECT_FALSE(disconnect()) << "nothing is different";
}

TEST_F(LedMemoryTest, KnowsThatARobotThatWasConnectedHasSwitchedThemOff) {
  EXPECT_TRUE(connect(2));
  EXPECT_THAT(memory_.states().intensities, testing::Each(0));
  memory_.accept({{7, 255, LedMode::kB}});
  EXPECT_FALSE(connect(2)) << "the status changes for many reasons";
  EXPECT_EQ(intensity(7), 1);
  EXPECT_TRUE(disconnect());
  EXPECT_TRUE(std::isnan(intensity(7)));
  EXPECT_TRUE(connect(2));
  EXPECT_EQ(intensity(7), 0);
  EXPECT_EQ(mode(7), LedStates::MODE_A);
}

TEST_F(LedMemoryTest, KnowsOfAVersion1ServerOnlyWhatItAccepted) {
  connect(1);
  EXPECT_TRUE(memory_.accept({{7, 51}}));
  EXPECT_FALSE(memory_.accept({{7, 51}})) << "nothing is different";
  EXPECT_FLOAT_EQ(intensity(7), 0.2F);
  EXPECT_TRUE(std::isnan(intensity(8)));
}

TEST_F(LedMemoryTest, KnowsTheLatestStateOfEach) {
  connect(2);
  memory_.accept({{7, 51}, {8, 255, LedMode::kB}, {99, 255}});
  EXPECT_EQ(mode(7), LedStates::MODE_A);
  EXPECT_EQ(mode(8), LedStates::MODE_B);
  memory_.accept({{7, 51, LedMode::kB}});
  EXPECT_EQ(mode(7), LedStates::MODE_B);
}

TEST_F(LedMemoryTest, KnowsWhichAreOnlyOnOrOff) {
  connect(2);
  memory_.accept({{6, 1, LedMode::kB}});
  EXPECT_EQ(intensity(6), 1);
  EXPECT_EQ(mode(6), LedStates::MODE_A);
}

}  // namespace
}  // namespace aibo_driver::node
