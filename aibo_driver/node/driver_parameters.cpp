#include "node/driver_parameters.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <sstream>

#include "aibo_client/exceptions.h"
#include "node/node.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::node {
namespace {

using XmlRpc::XmlRpcValue;

constexpr int kFramesOfMeasurement = 4;  // frames of 8 ms; the robot measures every 32 ms

/// Reads parameters one by one, and remembers their names and which values are refused.
class ParameterReader {
 public:
  ParameterReader(const XmlRpcValue& values, const std::string& name_prefix)
      : values_(values), name_prefix_(name_prefix) {}

  void read(const std::string& name, const std::string& /*unit*/, int minimum, int maximum, int* out) {
    const std::string allowed = "a whole number, " + std::to_string(minimum) + ".." + std::to_string(maximum);
    take(name, allowed, [=](const XmlRpcValue& value) {
      const double number = numberIn(value);  // a number may be written as 85.0
      const bool is_allowed = number >= minimum && number <= maximum && number == std::floor(number);
      *out = is_allowed ? static_cast<int>(number) : *out;
      return is_allowed;
    });
  }

  /// @param unit the unit in words to put after "a number of"; a whole number has none
  void read(const std::string& name, const std::string& unit, double minimum, double maximum, double* out) {
    std::ostringstream allowed;
    allowed << "a number of " << unit << ", " << minimum << ".." << maximum;
    take(name, allowed.str(), [=](const XmlRpcValue& value) {
      const double number = numberIn(value);
      const bool is_allowed = number >= minimum && number <= maximum;
      *out = is_allowed ? number : *out;
      return is_allowed;
    });
  }

  /// Reads a time in seconds.
  template <typename Duration>
  void read(const std::string& name, double minimum, double maximum, Duration* out) {
    double seconds = std::chrono::duration<double>(*out).count();
    read(name, "seconds", minimum, maximum, &seconds);
    *out = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
  }

  void read(const std::string& name, bool* out) {
    take(name, "true or false", [out](XmlRpcValue value) {
      const bool is_allowed = value.getType() == XmlRpcValue::TypeBoolean;
      *out = is_allowed ? static_cast<bool>(value) : *out;
      return is_allowed;
    });
  }

  /// @param acceptable returns whether a text is acceptable
  template <typename Predicate>
  void read(const std::string& name, const std::string& allowed, Predicate acceptable, std::string* out) {
    take(name, allowed, [=](XmlRpcValue value) {
      const bool is_allowed = value.getType() == XmlRpcValue::TypeString && acceptable(static_cast<std::string>(value));
      *out = is_allowed ? static_cast<std::string>(value) : *out;
      return is_allowed;
    });
  }

  std::vector<std::string> unknown() {
    std::vector<std::string> names;
    if (values_.getType() != XmlRpcValue::TypeStruct) {
      return names;
    }
    for (auto& entry : values_) {
      // A struct is a namespace below ours, and belongs to somebody else.
      if (known_.count(entry.first) == 0 && entry.second.getType() != XmlRpcValue::TypeStruct) {
        names.push_back(entry.first);
      }
    }
    return names;
  }

  /// @throw InvalidArgumentException values were refused; the message names all of them
  void checkRefusals() const {
    if (!refusals_.empty()) {
      throw aibo_client::InvalidArgumentException(refusals_ + kHowToRemove);
    }
  }

 private:
  /// @param accept sets the parameter and returns true, or returns false if the value is not allowed
  template <typename Accept>
  void take(const std::string& name, const std::string& allowed, const Accept& accept) {
    known_.insert(name);
    if (values_.hasMember(name) && !accept(values_[name])) {
      refusals_ += describeRefusal(name_prefix_ + name, values_[name], allowed) + " ";
    }
  }

  XmlRpcValue values_;
  std::string name_prefix_;
  std::set<std::string> known_;
  std::string refusals_;  ///< one sentence for each refused value
};

bool isWord(const std::string& text) {
  return !text.empty() && std::none_of(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c); });
}

bool isAnyText(const std::string& /*text*/) {
  return true;
}

bool isRobot(const std::string& text) {
  return robot_model::findRobotModel(text.c_str()) != nullptr;
}

bool isResolution(const std::string& text) {
  return camera::resolutionOf(text).has_value();
}

bool isTransport(const std::string& text) {
  return camera::transportOf(text).has_value();
}

bool isFrame(const std::string& text) {
  return isWord(text) && text.front() != '/';
}

bool isFramePrefix(const std::string& text) {
  return text.empty() || (isFrame(text) && text.back() != '/');
}

bool isCameraName(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

std::string cameraNameIn(const std::string& name_space) {
  std::string name = name_space.substr(name_space.find_first_not_of('/'));
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

bool isAbsoluteOrEmpty(const std::string& text) {
  return text.empty() || text.front() == '/';
}

bool isCameraInfoUrl(const std::string& text) {
  return text.empty() || text.rfind("file:///", 0) == 0 || text.rfind("file://${ROS_HOME}", 0) == 0 ||
         text.rfind("package://", 0) == 0;
}

}  // namespace

int telemetryPeriodOf(double rate) {
  if (rate == 0) {
    return 0;
  }
  constexpr int kLongest = 65535 / kFramesOfMeasurement;
  const double measurements = kHighestTelemetryRate / rate;
  return kFramesOfMeasurement * static_cast<int>(std::lround(std::clamp<double>(measurements, 1, kLongest)));
}

double telemetryRateOf(int period) {
  return period == 0 ? 0 : kHighestTelemetryRate * kFramesOfMeasurement / period;
}

DriverParameters parseDriverParameters(const XmlRpcValue& values, const std::string& name_prefix,
                                       const std::string& name_space) {
  DriverParameters parameters;
  ParameterReader reader(values, name_prefix);
  reader.read("host", "the robot's name or address, without blanks", isWord, &parameters.client.host);
  reader.read("port", "", 1, 65535, &parameters.client.port);
  visitLiveNumbers([&](const char* name, const char* unit, auto member, auto lowest, auto highest) {
    reader.read(name, unit, lowest, highest, &(parameters.live.*member));
  });
  parameters.client.jpeg_quality = parameters.live.jpeg_quality;
  reader.read("connect_timeout", 0.05, 60.0, &parameters.client.connect_timeout);
  reader.read("read_timeout", 0.05, 60.0, &parameters.client.read_timeout);
  reader.read("reconnect_wait_max", 0.01, 60.0, &parameters.client.reconnect_wait_max);
  const double wait_max = std::chrono::duration<double>(parameters.client.reconnect_wait_max).count();
  parameters.client.reconnect_wait_min =
      std::min(parameters.client.reconnect_wait_min, parameters.client.reconnect_wait_max);
  reader.read("reconnect_wait_min", 0.01, wait_max, &parameters.client.reconnect_wait_min);

  reader.read("stream_on_start", &parameters.stream_on_start);
  reader.read("stream_on_demand", &parameters.stream_on_demand);
  reader.read("resolution", camera::kResolutionNames, isResolution, &parameters.live.resolution);
  reader.read("transport", camera::kTransportNames, isTransport, &parameters.live.transport);
  parameters.client.picture_transport = *camera::transportOf(parameters.live.transport);
  reader.read("color_rate", "images a second", camera::kLowestFrameRate, camera::kCameraRate, &parameters.color_rate);
  reader.read("color_tables", "the files or names of colour tables, separated by blanks, or empty", isAnyText,
              &parameters.color_tables);
  reader.read("microphone_channels", "", 1, 2, &parameters.microphone_channels);
  reader.read("sound_priority", &parameters.sound_priority);
  reader.read("adaptive", &parameters.live.adaptive);
  reader.read("auto_exposure", &parameters.live.auto_exposure);
  reader.read("auto_white_balance", &parameters.live.auto_white_balance);
  reader.read("take_picture_timeout", 0.1, 60.0, &parameters.take_picture_timeout);
  reader.read("picture_folder", "the absolute path of a folder, or empty", isAbsoluteOrEmpty,
              &parameters.picture_folder);
  reader.read("use_robot_time", &parameters.use_robot_time);
  reader.read("time_offset", -60.0, 60.0, &parameters.time_offset);

  reader.read("frame_id", "a frame's name, not empty, without blanks, not beginning with '/'", isFrame,
              &parameters.frame_id);
  reader.read("frame_prefix", "a prefix for frames without blanks, not beginning or ending with '/', or empty",
              isFramePrefix, &parameters.frame_prefix);
  reader.read("camera_name", "a name of letters, digits and underscores, or empty", isCameraName,
              &parameters.camera_name);
  if (parameters.camera_name.empty()) {
    parameters.camera_name = cameraNameIn(name_space);
  }
  reader.read("camera_info_url", "file:///FILE.yaml, package://PACKAGE/FILE.yaml or empty", isCameraInfoUrl,
              &parameters.camera_info_url);

  reader.read("robot", "ERS-7 or ERS-210", isRobot, &parameters.robot);
  reader.read("joint_speed_limit", "rad/s", 0.1, 20.0, &parameters.joint_speed_limit);
  reader.read("motion_speed_limit", "rad/s", 0.1, 20.0, &parameters.motion_speed_limit);
  reader.read("approach_speed", "rad/s", 0.05, 20.0, &parameters.approach_speed);
  reader.read("leave_out_missing_joints", &parameters.client.leave_out_missing_joints);
  reader.read("publish_footprint", &parameters.publish_footprint);

  walk::WalkSettings& walk = parameters.walk;
  reader.read("walk_speed_limit", "m/s", 0.0, 1.0, &walk.speed_limit);
  reader.read("walk_side_limit", "m/s", 0.0, 1.0, &walk.side_limit);
  reader.read("walk_turn_limit", "rad/s", 0.0, 10.0, &walk.turn_limit);
  reader.read("walk_scale", "times", 0.2, 5.0, &walk.scale);
  reader.read("walk_side_scale", "times", 0.2, 5.0, &walk.side_scale);
  reader.read("walk_turn_scale", "times", 0.2, 5.0, &walk.turn_scale);
  reader.read("walk_direction", "rad", -1.0, 1.0, &walk.direction);
  reader.read("walk_curve", "rad/m", -5.0, 5.0, &walk.curve);
  reader.read("guard", &parameters.client.guard_walks);
  reader.read("get_up", &parameters.get_up);
  reader.read("cmd_vel_timeout", 0.1, 0.5, &walk.timeout);
  reader.read("publish_odom_tf", &walk.publish_odom_tf);

  reader.checkRefusals();
  parameters.unknown = reader.unknown();
  return parameters;
}

DriverParameters readDriverParameters(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle) {
  XmlRpcValue values;
  private_handle.getParam(private_handle.getNamespace(), values);
  return parseDriverParameters(values, private_handle.getNamespace() + "/", handle.getNamespace());
}

}  // namespace aibo_driver::node
