#include "remote_control/messages.h"

#include <QRegularExpression>
#include <algorithm>
#include <utility>

#include "text/plain_text.h"

namespace aibo_driver::remote_control {
namespace {

using dynamic_reconfigure::Config;

constexpr std::size_t kLongestText = 1000;  // bytes
constexpr int kLongestName = 200;           // characters

// More settings than a driver has. Each is a row of the form, and a regular expression searches its choices.
constexpr int kMostSettings = 100;
constexpr std::size_t kLongestEditMethod = 4096;  // bytes

RobotCondition::Posture postureOf(std::uint8_t posture) {
  switch (posture) {
    case RobotState::STANDING:
      return RobotCondition::Posture::kStanding;
    case RobotState::SITTING:
      return RobotCondition::Posture::kSitting;
    case RobotState::LYING:
      return RobotCondition::Posture::kLying;
    case RobotState::WALKING:
      return RobotCondition::Posture::kWalking;
    case RobotState::FALLEN:
      return RobotCondition::Posture::kFallen;
    case RobotState::CARRIED:
      return RobotCondition::Posture::kCarried;
    default:
      return RobotCondition::Posture::kNotKnown;
  }
}

QString nameOf(const Movement& movement) {
  switch (movement.kind) {
    case Movement::COMMAND:
      return "joints";
    case Movement::TRAJECTORY:
      return "trajectory";
    case Movement::WALK:
      return "walk";
    case Movement::LOOK_AT:
      return "look there";
    default:
      return fromRos(movement.name);
  }
}

// dynamic_reconfigure writes choices as a Python dictionary. Each entry has a name, a value and, last, a description.
QVector<QPair<QString, QVariant>> choicesIn(const QString& edit_method, bool are_texts) {
  static const QRegularExpression pattern(
      "'name': '([^']*)'[^}]*?'value': '?([^',}]*)'?,[^}]*?'description': ['\"](.*?)['\"][,}]");
  QVector<QPair<QString, QVariant>> choices;
  auto entries = pattern.globalMatch(edit_method);
  while (entries.hasNext()) {
    const QRegularExpressionMatch entry = entries.next();
    const auto part = [&entry](int number) { return fromRos(entry.captured(number).toStdString()); };
    const QVariant value = are_texts ? QVariant(part(2)) : QVariant(part(2).toInt());
    const QString name = are_texts ? part(2) : part(1);
    choices.append({part(3).isEmpty() ? name : name + " (" + part(3) + ")", value});
  }
  return choices;
}

template <typename Parameters, typename Value>
void append(Parameters& parameters, const QString& name, const Value& value) {
  auto& parameter = parameters.emplace_back();
  parameter.name = name.toStdString();
  parameter.value = value;
}

}  // namespace

QString fromRos(const std::string& text) {
  return QString::fromStdString(text::plainLine(text, kLongestText));
}

QStringList fromRos(const std::vector<std::string>& texts) {
  QStringList list;
  for (const std::string& text : texts) {
    list.append(fromRos(text));
  }
  return list;
}

RobotCondition conditionIn(const RobotState& message) {
  RobotCondition condition;
  condition.motors = message.motors == RobotState::ON    ? RobotCondition::Motors::kOn
                     : message.motors == RobotState::OFF ? RobotCondition::Motors::kOff
                                                         : RobotCondition::Motors::kNotKnown;
  condition.posture = postureOf(message.posture);
  condition.is_stopped = message.stopped != 0;
  condition.stopped_by = fromRos(message.stopped_by).left(kLongestName);
  return condition;
}

QStringList touchedPlacesIn(const Touch& message) {
  const std::pair<const char*, bool> places[] = {{"paw_left_front", message.paw_left_front},
                                                 {"paw_left_hind", message.paw_left_hind},
                                                 {"paw_right_front", message.paw_right_front},
                                                 {"paw_right_hind", message.paw_right_hind},
                                                 {"chin", message.chin},
                                                 {"head", message.head},
                                                 {"back_front", message.back_front},
                                                 {"back_middle", message.back_middle},
                                                 {"back_rear", message.back_rear}};
  QStringList touched;
  for (const auto& [place, is_touched] : places) {
    if (is_touched) {
      touched.append(place);
    }
  }
  return touched;
}

// The list `now` is the list `before` without some entries at its beginning, and with new ones at its end.
std::vector<EndedMovement> endedBetween(const std::vector<EndedMovement>& before,
                                        const std::vector<EndedMovement>& now) {
  for (auto first = before.begin(); first != before.end(); ++first) {
    const auto kept = before.end() - first;
    if (kept <= static_cast<std::ptrdiff_t>(now.size()) && std::equal(first, before.end(), now.begin())) {
      return {now.begin() + kept, now.end()};
    }
  }
  return now;
}

QString complaintAbout(const EndedMovement& ended) {
  switch (ended.how) {
    case EndedMovement::DONE:
    case EndedMovement::REPLACED:
    case EndedMovement::STOPPED:
      return "";
    default:
      return nameOf(ended.movement) + ": " + fromRos(ended.reason);
  }
}

QVector<Setting> settingsIn(const dynamic_reconfigure::ConfigDescription& description) {
  const SettingValues lowest = valuesIn(description.min);
  const SettingValues highest = valuesIn(description.max);
  QVector<Setting> settings;
  for (const auto& group : description.groups) {
    for (const auto& parameter : group.parameters) {
      Setting setting;
      setting.name = fromRos(parameter.name);
      setting.description = fromRos(parameter.description);
      setting.lowest = lowest.value(setting.name);
      setting.highest = highest.value(setting.name);
      if (settings.size() == kMostSettings || parameter.edit_method.size() > kLongestEditMethod) {
        continue;
      }
      const bool is_text = parameter.type == "str";
      setting.choices = parameter.type == "bool" ? QVector<QPair<QString, QVariant>>{{"no", false}, {"yes", true}}
                                                 : choicesIn(QString::fromStdString(parameter.edit_method), is_text);
      if (!is_text || !setting.choices.empty()) {
        settings.append(setting);
      }
    }
  }
  return settings;
}

SettingValues valuesIn(const Config& message) {
  SettingValues values;
  for (const auto& parameter : message.bools) {
    values[fromRos(parameter.name)] = static_cast<bool>(parameter.value);
  }
  for (const auto& parameter : message.ints) {
    values[fromRos(parameter.name)] = parameter.value;
  }
  for (const auto& parameter : message.doubles) {
    values[fromRos(parameter.name)] = parameter.value;
  }
  for (const auto& parameter : message.strs) {
    values[fromRos(parameter.name)] = fromRos(parameter.value);
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
