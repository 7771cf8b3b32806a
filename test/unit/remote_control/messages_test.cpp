#include "remote_control/messages.h"

#include <aibo_driver/AiboDriverConfig.h>
#include <gmock/gmock.h>

namespace aibo_driver::remote_control {
namespace {

std::vector<EndedMovement> ended(const std::string& letters) {
  std::vector<EndedMovement> all;
  for (const char letter : letters) {
    all.emplace_back().reason = letter;
  }
  return all;
}

TEST(EndedMovements, AreNewIfTheMessageBeforeDidNotHaveThem) {
  EXPECT_EQ(endedBetween(ended(""), ended("ab")), ended("ab"));
  EXPECT_EQ(endedBetween(ended("ab"), ended("ab")), ended(""));
  EXPECT_EQ(endedBetween(ended("ab"), ended("abc")), ended("c"));
  EXPECT_EQ(endedBetween(ended("abcdefgh"), ended("bcdefghi")), ended("i")) << "the oldest is left out";
  EXPECT_EQ(endedBetween(ended("aab"), ended("aaba")), ended("a"));
  EXPECT_EQ(endedBetween(ended("ab"), ended("bcd")), ended("cd")) << "only the newest is still there";
  EXPECT_EQ(endedBetween(ended("abc"), ended("ab")), ended("ab")) << "another driver with fewer of them";
  EXPECT_EQ(endedBetween(ended("ab"), ended("xy")), ended("xy")) << "another driver";
}

TEST(EndedMovements, AreToldIfTheyDidNotArriveAndNobodyWantedThat) {
  EndedMovement each;
  each.movement.kind = Movement::COMMAND;
  each.reason = "the motors are off";
  each.how = EndedMovement::REFUSED;
  EXPECT_EQ(complaintAbout(each), "joints: the motors are off");
  for (const auto& [kind, name] : {std::pair<int, const char*>(Movement::TRAJECTORY, "trajectory"),
                                   {Movement::WALK, "walk"},
                                   {Movement::LOOK_AT, "look there"}}) {
    each.movement.kind = static_cast<std::uint8_t>(kind);
    EXPECT_EQ(complaintAbout(each), name + QString(": the motors are off"));
  }
  each.movement.kind = Movement::MOTION;
  each.movement.name = "NOD.MTN";
  each.how = EndedMovement::NOT_REACHED;
  EXPECT_EQ(complaintAbout(each), "NOD.MTN: the motors are off");
  for (const auto how : {EndedMovement::DONE, EndedMovement::REPLACED, EndedMovement::STOPPED}) {
    each.how = how;
    EXPECT_EQ(complaintAbout(each), "");
  }
}

// The driver's own description, as its generated code publishes it, with the ranges of two numbers.
Setting settingOf(const QString& name) {
  auto description = AiboDriverConfig::__getDescriptionMessage__();
  AiboDriverConfig least = AiboDriverConfig::__getDefault__();
  AiboDriverConfig most = least;
  least.jpeg_quality = 1;
  most.jpeg_quality = 100;
  least.telemetry_rate = 0.25;
  most.telemetry_rate = 31.25;
  least.__toMessage__(description.min);
  most.__toMessage__(description.max);
  const QVector<Setting> settings = settingsIn(description);
  const auto found =
      std::find_if(settings.begin(), settings.end(), [&name](const Setting& setting) { return setting.name == name; });
  return found == settings.end() ? Setting() : *found;
}

TEST(SettingsMessages, EachSettingOfTheDriverHasItsRangeOrItsChoices) {
  const std::tuple<QString, QVariant, QVariant, int> rows[] = {{"jpeg_quality", 1, 100, 0},
                                                               {"telemetry_rate", 0.25, 31.25, 0},
                                                               {"auto_exposure", false, false, 2},
                                                               {"resolution", "208x160", "208x160", 4}};
  for (const auto& [name, lowest, highest, choices] : rows) {
    const Setting setting = settingOf(name);
    EXPECT_EQ(setting.lowest, lowest) << name.toStdString();
    EXPECT_EQ(setting.highest, highest) << name.toStdString();
    EXPECT_EQ(setting.choices.size(), choices) << name.toStdString();
    EXPECT_FALSE(setting.description.isEmpty()) << name.toStdString();
  }
  EXPECT_EQ(settingOf("auto_exposure").choices.value(1), qMakePair(QString("yes"), QVariant(true)));
  EXPECT_EQ(settingOf("resolution").choices.value(2).first, "208x160 (layer H)");
  EXPECT_EQ(settingOf("resolution").choices.value(2).second, QVariant("208x160"));
  const auto description = AiboDriverConfig::__getDescriptionMessage__();
  EXPECT_EQ(static_cast<std::size_t>(settingsIn(description).size()), description.groups.at(0).parameters.size());
}

// Python puts a text with an apostrophe between double quotes.
TEST(SettingsMessages, AChoiceMayHaveAnyDescriptionAndValue) {
  auto description = AiboDriverConfig::__getDescriptionMessage__();
  description.groups.at(0).parameters.resize(1);
  auto& parameter = description.groups[0].parameters[0];
  parameter.type = "int";
  parameter.edit_method =
      "{'enum_description': 'any', 'enum': ["
      "{'name': 'NONE', 'type': 'int', 'value': -1, 'srcline': 1, 'description': '', 'ctype': 'int'}, "
      "{'name': 'OWN', 'type': 'int', 'value': 0, 'srcline': 2, 'description': \"the camera's own\", 'ctype': 'int'}, "
      "{'name': 'LOW', 'type': 'int', 'value': 20, 'srcline': 3, 'description': '1, or \"low\"', 'ctype': 'int'}]}";
  const QVector<QPair<QString, QVariant>> expected{
      {"NONE", -1}, {"OWN (the camera's own)", 0}, {"LOW (1, or \"low\")", 20}};
  EXPECT_EQ(settingsIn(description).at(0).choices, expected);
}

TEST(SettingsMessages, EachTextIsOnePlainLine) {
  auto description = AiboDriverConfig::__getDescriptionMessage__();
  description.groups.at(0).parameters.resize(1);
  auto& parameter = description.groups[0].parameters[0];
  parameter.name = parameter.description = "a\x1b\nb";
  parameter.type = "str";
  parameter.edit_method = "{'enum': [{'name': 'B', 'value': 'c\x1b\nd', 'srcline': 1, 'description': 'x\x1bz'}]}";
  const Setting setting = settingsIn(description).at(0);
  EXPECT_EQ(setting.name, "a??b");
  EXPECT_EQ(setting.description, "a??b");
  EXPECT_EQ(setting.choices, (QVector<QPair<QString, QVariant>>{{"c??d (x?z)", "c??d"}}));
  EXPECT_EQ(valuesIn(changeOf("a", "g\x1b\nh")), (SettingValues{{"a", "g??h"}}));
}

TEST(SettingsMessages, AChangeComesBackAsItsValue) {
  const SettingValues values{{"a", 7},     {"b", -3},   {"c", 0.5},       {"d", 0.25},
                             {"e", false}, {"f", true}, {"g", "208x160"}, {"h", ""}};
  for (auto value = values.begin(); value != values.end(); ++value) {
    const auto change = changeOf(value.key(), value.value());
    EXPECT_EQ(valuesIn(change), (SettingValues{{value.key(), value.value()}}));
  }
}

}  // namespace
}  // namespace aibo_driver::remote_control
