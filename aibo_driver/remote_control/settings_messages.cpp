#include "remote_control/settings_messages.h"

#include <QRegularExpression>
#include <algorithm>

namespace aibo_driver::remote_control {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ParamDescription;

QString text(const std::string& words) {
  return QString::fromStdString(words);
}

template <typename Parameters>
QVariant valueOf(const Parameters& parameters, const std::string& name) {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&name](const auto& each) { return each.name == name; });
  return found == parameters.end() ? QVariant() : QVariant(found->value);
}

// dynamic_reconfigure writes choices as a Python dictionary. Each entry has a name, a value and, last, a description.
QVector<QPair<QString, QVariant>> choicesIn(const QString& edit_method, bool are_texts) {
  static const QRegularExpression pattern(
      "'name': '([^']*)'[^}]*?'value': '?([^',}]*)'?,[^}]*?'description': ['\"](.*?)['\"][,}]");
  QVector<QPair<QString, QVariant>> choices;
  auto entries = pattern.globalMatch(edit_method);
  while (entries.hasNext()) {
    const QRegularExpressionMatch entry = entries.next();
    const QVariant value = are_texts ? QVariant(entry.captured(2)) : QVariant(entry.captured(2).toInt());
    const QString name = are_texts ? entry.captured(2) : entry.captured(1);
    choices.append({entry.captured(3).isEmpty() ? name : name + " (" + entry.captured(3) + ")", value});
  }
  return choices;
}

Setting settingOf(const ParamDescription& parameter, const Config& lowest, const Config& highest) {
  Setting setting;
  setting.name = text(parameter.name);
  setting.description = text(parameter.description);
  const bool is_text = parameter.type == "str";
  setting.choices = choicesIn(text(parameter.edit_method), is_text);
  if (!setting.choices.empty() || is_text) {
    setting.kind = Setting::Kind::kChoice;
  } else if (parameter.type == "bool") {
    setting.kind = Setting::Kind::kSwitch;
  } else if (parameter.type == "double") {
    setting.kind = Setting::Kind::kNumber;
    setting.lowest = valueOf(lowest.doubles, parameter.name).toDouble();
    setting.highest = valueOf(highest.doubles, parameter.name).toDouble();
  } else {
    setting.lowest = valueOf(lowest.ints, parameter.name).toInt();
    setting.highest = valueOf(highest.ints, parameter.name).toInt();
  }
  return setting;
}

template <typename Parameters, typename Value>
void append(Parameters& parameters, const QString& name, const Value& value) {
  auto& parameter = parameters.emplace_back();
  parameter.name = name.toStdString();
  parameter.value = value;
}

}  // namespace

QVector<Setting> settingsIn(const dynamic_reconfigure::ConfigDescription& description) {
  QVector<Setting> settings;
  for (const auto& group : description.groups) {
    for (const ParamDescription& parameter : group.parameters) {
      const Setting setting = settingOf(parameter, description.min, description.max);
      if (setting.kind != Setting::Kind::kChoice || !setting.choices.empty()) {
        settings.append(setting);
      }
    }
  }
  return settings;
}

SettingValues valuesIn(const Config& message) {
  SettingValues values;
  for (const auto& parameter : message.bools) {
    values[text(parameter.name)] = static_cast<bool>(parameter.value);
  }
  for (const auto& parameter : message.ints) {
    values[text(parameter.name)] = parameter.value;
  }
  for (const auto& parameter : message.doubles) {
    values[text(parameter.name)] = parameter.value;
  }
  for (const auto& parameter : message.strs) {
    values[text(parameter.name)] = text(parameter.value);
  }
  return values;
}

Config changeOf(const QString& name, const QVariant& value) {
  Config message;
  switch (value.type()) {
    case QVariant::Bool:
      append(message.bools, name, value.toBool());
      break;
    case QVariant::Int:
      append(message.ints, name, value.toInt());
      break;
    case QVariant::Double:
      append(message.doubles, name, value.toDouble());
      break;
    default:
      append(message.strs, name, value.toString().toStdString());
      break;
  }
  return message;
}

}  // namespace aibo_driver::remote_control
