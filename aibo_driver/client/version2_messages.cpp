#include "client/version2_messages.h"

#include <sstream>

#include "client/units.h"
#include "protocol/text.h"
#include "protocol/units.h"

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

// The server sends the duty of a joint after its position.
void setDuty(int id, double duty, std::vector<JointReading>* joints) {
  for (JointReading& joint : *joints) {
    if (joint.id == id) {
      joint.duty = duty;
    }
  }
}

// A robot's text may fill a whole frame. Its beginning is enough for a log or a diagnostic message.
std::string beginningOf(const char* text, std::size_t size) {
  constexpr std::size_t kLongestText = 512;
  const std::size_t shown = protocol::sizeOfWholeCharacters(text, size, kLongestText);
  return std::string(text, shown) + (shown < size ? "..." : "");
}

/// The value that has this number of the protocol. A number that only a newer server knows is Enum::kUnknown.
/// @param highest the highest number of the protocol that Enum has
template <typename Enum>
Enum known(unsigned number, unsigned highest) {
  return number <= highest ? static_cast<Enum>(number) : Enum::kUnknown;
}

// Identifiers that it does not know are ignored, because a newer server may send them.
void setWalk(int id, int value, std::optional<WalkReading>* walk) {
  if (!*walk) {
    walk->emplace();
  }
  switch (id) {
    case version2::WALK_FORWARD:
      (*walk)->velocity.forward = fromMicro(value);
      break;
    case version2::WALK_LEFT:
      (*walk)->velocity.left = fromMicro(value);
      break;
    case version2::WALK_TURN:
      (*walk)->velocity.turn = fromMicro(value);
      break;
    case version2::WALK_PHASE:
      (*walk)->phase = fromMicro(value);
      break;
    case version2::WALK_STATE:
      (*walk)->state = known<WalkState>(static_cast<unsigned>(value), version2::WALK_STATE_WALKS);
      break;
    default:
      break;
  }
}

}  // namespace

std::array<int, version2::NUMBER_OF_CAMERA_SETTINGS> valuesOf(const CameraSettings& settings) {
  return {settings.white_balance, settings.gain, settings.shutter_speed, settings.auto_exposure ? 1 : 0,
          settings.auto_white_balance ? 1 : 0};
}

std::optional<CameraSettings> settingsIn(const version2::CameraSettings& values) {
  if (!values.areKnown()) {
    return std::nullopt;
  }
  CameraSettings settings;
  settings.white_balance = values.of(version2::SETTING_WHITE_BALANCE);
  settings.gain = values.of(version2::SETTING_GAIN);
  settings.shutter_speed = values.of(version2::SETTING_SHUTTER_SPEED);
  settings.auto_exposure = values.of(version2::SETTING_AUTO_EXPOSURE) != 0;
  settings.auto_white_balance = values.of(version2::SETTING_AUTO_WHITE_BALANCE) != 0;
  return settings;
}

version2::Layer layerOf(Resolution resolution) {
  return static_cast<version2::Layer>(resolution);
}

RobotInfo robotIn(const version2::Hello& hello) {
  RobotInfo robot;
  robot.design = hello.robot;
  robot.server = hello.server;
  std::istringstream words(hello.capabilities);
  for (std::string word; words >> word;) {
    robot.capabilities.push_back(word);
  }
  for (std::size_t i = 0; i < hello.joint_count; ++i) {
    const version2::JointLimits& joint = hello.joints[i];
    robot.joint_limits.push_back({joint.id, fromMicro(joint.lower), fromMicro(joint.upper), fromMicro(joint.speed)});
  }
  robot.walk_limits = {hello.walk.forward, hello.walk.back, hello.walk.left, hello.walk.turn};
  return robot;
}

Telemetry telemetryIn(const version2::Telemetry& measured, const std::string& design) {
  Telemetry telemetry;
  telemetry.frame_number = measured.frame_number;
  telemetry.joints.reserve(measured.count);
  telemetry.sensors.reserve(measured.count);
  for (std::size_t i = 0; i < measured.count; ++i) {
    const version2::TelemetryEntry& entry = measured.entries[i];
    if (entry.group == version2::GROUP_JOINT) {
      telemetry.joints.push_back({entry.id, fromMicro(entry.value)});
    } else if (entry.group == version2::GROUP_SENSOR) {
      const robot_model::SensorKind kind = sensorKind(design, entry.id);
      telemetry.sensors.push_back({entry.id, protocol::sensorValueFromVersion2(kind, entry.value)});
    } else if (entry.group == version2::GROUP_DUTY) {
      setDuty(entry.id, fromMicro(entry.value), &telemetry.joints);
    } else {
      setWalk(entry.id, entry.value, &telemetry.walk);
    }
  }
  return telemetry;
}

std::vector<JointTarget> targetsIn(const version2::JointTargets& accepted) {
  std::vector<JointTarget> targets;
  for (std::size_t i = 0; i < accepted.count; ++i) {
    targets.push_back({accepted.joints[i].id, fromMicro(accepted.joints[i].value)});
  }
  return targets;
}

std::vector<LedCommand> ledsIn(const version2::LedValues& accepted) {
  std::vector<LedCommand> leds;
  for (std::size_t i = 0; i < accepted.count; ++i) {
    const version2::LedValue& led = accepted.leds[i];
    leds.push_back({led.id, led.intensity, led.mode == version2::LED_MODE_B ? LedMode::kB : LedMode::kA});
  }
  return leds;
}

ActivityEnd endIn(const version2::EndMessage& message) {
  ActivityEnd end;
  end.kind = known<EndedKind>(message.what, version2::ENDED_JOINTS);
  end.how = known<EndedHow>(message.how, version2::END_FELL);
  end.name = beginningOf(message.name, message.name_size);
  end.reason = beginningOf(message.reason, message.reason_size);
  return end;
}

MotorsAndPosture stateIn(const version2::MotorsAndPosture& state) {
  return {state.motors_on ? MotorState::kOn : MotorState::kOff,
          known<PostureNow>(state.posture, version2::POSTURE_CARRIED)};
}

std::string describe(const version2::ErrorMessage& message) {
  const std::string text = beginningOf(message.text, message.text_size);
  return text.empty() ? "error code " + std::to_string(message.code) : text;
}

version2::JointTargets targetsOf(const JointCommand& command) {
  version2::JointTargets targets = {};
  targets.duration_ms = static_cast<unsigned short>(command.duration.count());
  for (const JointTarget& target : command.targets) {
    targets.joints[targets.count++] = {static_cast<unsigned char>(target.id), toMicro(target.position)};
  }
  return targets;
}

version2::SpeedLimits limitsOf(const std::vector<JointSpeedLimit>& wanted) {
  version2::SpeedLimits limits = {};
  for (const JointSpeedLimit& limit : wanted) {
    limits.joints[limits.count++] = {static_cast<unsigned char>(limit.id), toMicro(limit.speed)};
  }
  return limits;
}

version2::LedValues ledsOf(const std::vector<LedCommand>& wanted) {
  version2::LedValues values = {};
  for (const LedCommand& led : wanted) {
    values.leds[values.count++] = {static_cast<unsigned char>(led.id), static_cast<unsigned char>(led.intensity),
                                   led.mode == LedMode::kA ? version2::LED_MODE_A : version2::LED_MODE_B};
  }
  return values;
}

version2::ColorTable tableOf(const ColorTablePtr& chosen, std::ptrdiff_t index) {
  version2::ColorTable table = {static_cast<unsigned char>(index), {}};
  for (std::size_t i = 0; i < kColorSegments; ++i) {
    const std::optional<ColorRange> range = chosen ? chosen->segments.at(i) : std::nullopt;
    const auto byte = [](int value) { return static_cast<unsigned char>(value); };
    table.segments[i] = range ? version2::ColorSegment{byte(range->cr_min), byte(range->cr_max), byte(range->cb_min),
                                                       byte(range->cb_max)}
                              : version2::EMPTY_COLOR_SEGMENT;
  }
  return table;
}

}  // namespace aibo_client
