#include "node/body/leds_and_ears.h"

#include <gmock/gmock.h>

#include <cmath>

#include "movement/mover.h"
#include "support/fake_client.h"
#include "unit/driver/log_listener.h"

namespace aibo_driver::node {
namespace {

using test_support::listenToLog;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;

const robot_model::RobotModel& ledRobot() {
  return *robot_model::findRobotModel("ERS-7");
}

ParsedLeds ordersOf(const std::vector<std::string>& names, const std::vector<float>& intensities,
                    std::uint8_t mode = 0) {
  Leds message;
  message.names = names;
  message.intensities = intensities;
  message.mode = mode;
  return parseLeds(message, ledRobot());
}

// Intensities by the names of the LEDs.
std::map<std::string, int> intensitiesOf(const ParsedLeds& orders) {
  std::map<std::string, int> intensities;
  for (const aibo_client::LedCommand& command : orders.commands) {
    intensities[ledRobot().leds[robot_model::findLedByIdentifier(ledRobot(), command.id)].name] = command.intensity;
  }
  return intensities;
}

TEST(ParseLeds, FindsLedsByName) {
  const ParsedLeds orders = ordersOf({"face_3", "wireless"}, {0.5F, 1.0F});
  EXPECT_THAT(intensitiesOf(orders), ElementsAre(Pair("face_3", 128), Pair("wireless", 255)));
  EXPECT_TRUE(orders.refusals.empty());
}

TEST(ParseLeds, FindsGroupsOfLeds) {
  EXPECT_THAT(ordersOf({"face"}, {1.0F}).commands, SizeIs(14));
  EXPECT_THAT(ordersOf({"back"}, {1.0F}).commands, SizeIs(6));
  EXPECT_THAT(ordersOf({"head"}, {1.0F}).commands, SizeIs(6));
  EXPECT_THAT(ordersOf({"all"}, {0.0F}).commands, SizeIs(26));
  Leds tail;
  tail.names = {"tail"};
  tail.intensities = {1.0F};
  const ParsedLeds of_tail = parseLeds(tail, *robot_model::findRobotModel("ERS-210"));
  EXPECT_THAT(of_tail.commands, SizeIs(2));
}

TEST(ParseLeds, OfAnLedThatIsNamedTwiceTheLaterOneCounts) {
  EXPECT_THAT(intensitiesOf(ordersOf({"face", "face_1"}, {0, 1})), testing::Contains(Pair("face_1", 255)));
  EXPECT_THAT(intensitiesOf(ordersOf({"face_1", "face"}, {0, 1})), testing::Each(Pair(testing::_, 255)));
}

TEST(ParseLeds, SelectsTheModeOfTheMessage) {
  const std::pair<std::uint8_t, aibo_client::LedMode> rows[] = {{Leds::MODE_A, aibo_client::LedMode::kA},
                                                                {Leds::MODE_B, aibo_client::LedMode::kB}};
  for (const auto& [mode, expected] : rows) {
    EXPECT_EQ(ordersOf({"face_1"}, {1}, mode).commands.at(0).mode, expected);
  }
}

TEST(ParseLeds, LeavesNothingDarkThatIsNotOff) {
  EXPECT_THAT(intensitiesOf(ordersOf({"face_1"}, {0.001F})), ElementsAre(Pair("face_1", 1)));
  EXPECT_THAT(intensitiesOf(ordersOf({"face_1"}, {0.2F})), ElementsAre(Pair("face_1", 51))) << "a little more than 0.2";
}

TEST(ParseLeds, LeavesOutWhatItDoesNotKnowAndSaysSo) {
  const ParsedLeds orders = ordersOf({"third_eye", "face_1", "face_2", "face_3"}, {1.0F, NAN, 1.5F, 1.0F});
  EXPECT_THAT(intensitiesOf(orders), ElementsAre(Pair("face_3", 255)));
  EXPECT_THAT(ordersOf({"face_1"}, {-0.1F}).commands, IsEmpty());
  EXPECT_THAT(orders.refusals.text(),
              AllOf(HasSubstr("'third_eye'"), HasSubstr("face_1"), HasSubstr("face_2 cannot shine")));
}

TEST(ParseLeds, SaysInAFewWordsWhatIsWrongWithAMillionNames) {
  std::vector<std::string> names(movement::kMostNames, "\x1b[2J" + std::string(100, 'x'));
  const ParsedLeds allowed = ordersOf(names, {1.0F});
  EXPECT_THAT(allowed.refusals.text(), AllOf(HasSubstr("named '?[2Jxx"), HasSubstr(" and 997 more")));
  EXPECT_LT(allowed.refusals.text().size(), 1000U);
  names.resize(1'000'000, "all");
  const ParsedLeds too_many = ordersOf(names, {1.0F});
  EXPECT_THAT(too_many.commands, IsEmpty());
  EXPECT_THAT(too_many.refusals.text(), HasSubstr("it names 1000000, and at most 1000 names are allowed"));
}

TEST(ParseLeds, RefusesAMessageThatDoesNotFitTogether) {
  const ParsedLeds numbers = ordersOf({"face_1", "face_2", "face_3"}, {1.0F, 1.0F});
  EXPECT_THAT(numbers.commands, IsEmpty());
  EXPECT_THAT(numbers.refusals.text(), HasSubstr("3 names and 2 intensities"));
  const ParsedLeds mode = ordersOf({"face_1"}, {1.0F}, 2);
  EXPECT_THAT(mode.commands, IsEmpty());
  EXPECT_THAT(mode.refusals.text(), HasSubstr("no mode 2"));
}

class LedsAndEarsTest : public ::testing::Test {
 protected:
  static Leds face(float intensity) {
    Leds message;
    message.names = {"face_1", "third_eye"};
    message.intensities = {intensity};
    return message;
  }

  static movement::Order order() { return {"/user", std::chrono::steady_clock::now()}; }

  test_support::FakeClient client_;
  movement::JointTable table_{"ERS-7", 3.0};
  movement::MeasuredJoints measured_{table_};
  movement::Mover mover_{table_, measured_, client_, 0.5};
  LedsAndEars commander_{ledRobot(), client_, mover_};
};

TEST_F(LedsAndEarsTest, SendsLedsAndEars) {
  commander_.receiveLeds(face(1.0F));
  Ears ears;
  ears.right = 1;
  commander_.receiveEars(ears, order());
  EXPECT_THAT(client_.told, ElementsAre("LEDs 7:255", "ears 01"));
}

TEST_F(LedsAndEarsTest, FlicksNoEarOfAStoppedRobot) {
  const std::vector<std::string>& log = listenToLog();
  mover_.stop({"/somebody", std::chrono::steady_clock::now()});
  client_.told.clear();
  commander_.receiveEars(Ears(), order());
  EXPECT_THAT(client_.told, IsEmpty());
  EXPECT_THAT(log, ElementsAre("A command to the ears was dropped: stopped by /somebody; call release."));
  commander_.receiveLeds(face(1.0F));
  EXPECT_THAT(client_.told, ElementsAre("LEDs 7:255")) << "they move nothing";
}

TEST_F(LedsAndEarsTest, SendsNothingToARobotOfAnotherDesign) {
  client_.present.robot.design = "ERS-210";
  commander_.receiveLeds(face(1.0F));
  commander_.receiveEars(Ears(), order());
  EXPECT_THAT(client_.told, IsEmpty());
}

TEST_F(LedsAndEarsTest, DropsWhatCannotBeSentAndSaysWhy) {
  const std::vector<std::string>& log = listenToLog();
  client_.problem = "not connected";
  commander_.receiveLeds(face(1.0F));
  commander_.receiveEars(Ears(), order());
  client_.problem.clear();
  EXPECT_THAT(client_.told, IsEmpty());
  EXPECT_THAT(log, ElementsAre(HasSubstr("'third_eye'"), "A command to the LEDs was dropped: not connected",
                               "A command to the ears was dropped: not connected"));
}

}  // namespace
}  // namespace aibo_driver::node
