#include "remote_control/settings_messages.h"

#include <aibo_driver/AiboDriverConfig.h>
#include <gmock/gmock.h>

#include <algorithm>

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
  EXPECT_EQ(settingOf("jpeg_quality").kind, Setting::Kind::kInteger);
  EXPECT_EQ(settingOf("jpeg_quality").lowest, 1);
  EXPECT_EQ(settingOf("jpeg_quality").highest, 100);
  EXPECT_EQ(settingOf("telemetry_rate").kind, Setting::Kind::kNumber);
  EXPECT_EQ(settingOf("telemetry_rate").lowest, 0.25);
  EXPECT_EQ(settingOf("telemetry_rate").highest, 31.25);
  EXPECT_EQ(settingOf("auto_exposure").kind, Setting::Kind::kSwitch);
  EXPECT_FALSE(settingOf("auto_exposure").description.isEmpty());
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
  for (const QVariant& value : {QVariant(7), QVariant(0.5), QVariant(true), QVariant("208x160")}) {
    EXPECT_EQ(valuesIn(changeOf("name", value)), (SettingValues{{"name", value}}));
  }
}

}  // namespace
}  // namespace aibo_driver::remote_control
