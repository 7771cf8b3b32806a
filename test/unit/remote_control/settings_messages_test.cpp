#include "remote_control/settings_messages.h"

#include <aibo_driver/AiboDriverConfig.h>
#include <gmock/gmock.h>

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

TEST(SettingsMessages, EachSettingOfTheDriverHasItsKindAndRange) {
  const std::tuple<QString, Setting::Kind, double, double> rows[] = {
      {"jpeg_quality", Setting::Kind::kInteger, 1, 100},
      {"telemetry_rate", Setting::Kind::kNumber, 0.25, 31.25},
      {"auto_exposure", Setting::Kind::kSwitch, 0, 0},
      {"resolution", Setting::Kind::kChoice, 0, 0}};
  for (const auto& [name, kind, lowest, highest] : rows) {
    const Setting setting = settingOf(name);
    EXPECT_EQ(setting.kind, kind) << name.toStdString();
    EXPECT_EQ(setting.lowest, lowest) << name.toStdString();
    EXPECT_EQ(setting.highest, highest) << name.toStdString();
    EXPECT_FALSE(setting.description.isEmpty()) << name.toStdString();
  }
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
