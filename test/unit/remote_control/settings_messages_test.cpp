#include "remote_control/settings_messages.h"

#include <aibo_driver/AiboDriverConfig.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <tuple>

namespace aibo_driver::remote_control {
namespace {

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

TEST(SettingsMessages, EachOfTheDriversSettingsIsThere) {
  const auto description = AiboDriverConfig::__getDescriptionMessage__();
  const QVector<Setting> settings = settingsIn(description);
  ASSERT_EQ(static_cast<std::size_t>(settings.size()), description.groups.at(0).parameters.size());
}

TEST(SettingsMessages, NumbersHaveTheirRange) {
  const auto parameters = AiboDriverConfig::__getDescriptionMessage__().groups.at(0).parameters;
  const std::tuple<QString, Setting::Kind, double, double> numbers[] = {
      {"jpeg_quality", Setting::Kind::kInteger, 1, 100},
      {"telemetry_rate", Setting::Kind::kNumber, 0.25, 31.25},
      {"auto_exposure", Setting::Kind::kSwitch, 0, 0}};
  for (const auto& [name, kind, lowest, highest] : numbers) {
    const Setting setting = settingOf(name);
    EXPECT_EQ(setting.kind, kind) << name.toStdString();
    EXPECT_EQ(setting.lowest, lowest) << name.toStdString();
    EXPECT_EQ(setting.highest, highest) << name.toStdString();
    const auto parameter = std::find_if(parameters.begin(), parameters.end(), [&setting](const auto& each) {
      return each.name == setting.name.toStdString();
    });
    EXPECT_EQ(setting.description.toStdString(), parameter->description);
  }
}

TEST(SettingsMessages, ChoicesHaveAllTheirValues) {
  const Setting resolution = settingOf("resolution");
  EXPECT_EQ(resolution.kind, Setting::Kind::kChoice);
  ASSERT_EQ(resolution.choices.size(), 4);
  EXPECT_EQ(resolution.choices[2].first, "208x160 (layer H)");
  EXPECT_EQ(resolution.choices[2].second, QVariant("208x160"));
  const Setting gain = settingOf("gain");
  EXPECT_EQ(gain.kind, Setting::Kind::kChoice);
  ASSERT_EQ(gain.choices.size(), 3);
  EXPECT_EQ(gain.choices[0].first, "GAIN_LOW (-6 dB)");
  EXPECT_EQ(gain.choices[0].second, QVariant(1));
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

TEST(SettingsMessages, ATextThatIsNoChoiceIsLeftOut) {
  auto description = AiboDriverConfig::__getDescriptionMessage__();
  description.groups.at(0).parameters.resize(1);
  description.groups[0].parameters[0].type = "str";
  description.groups[0].parameters[0].edit_method = "";
  EXPECT_TRUE(settingsIn(description).empty());
}

TEST(SettingsMessages, AChangeComesBackAsItsValue) {
  dynamic_reconfigure::Config all;
  const SettingValues values{{"a", 7},     {"b", -3},   {"c", 0.5},       {"d", 0.25},
                             {"e", false}, {"f", true}, {"g", "208x160"}, {"h", ""}};
  for (auto value = values.begin(); value != values.end(); ++value) {
    const auto change = changeOf(value.key(), value.value());
    EXPECT_EQ(valuesIn(change), (SettingValues{{value.key(), value.value()}}));
    all.ints.insert(all.ints.end(), change.ints.begin(), change.ints.end());
    all.doubles.insert(all.doubles.end(), change.doubles.begin(), change.doubles.end());
    all.bools.insert(all.bools.end(), change.bools.begin(), change.bools.end());
    all.strs.insert(all.strs.end(), change.strs.begin(), change.strs.end());
  }
  EXPECT_EQ(valuesIn(all), values);
}

}  // namespace
}  // namespace aibo_driver::remote_control
