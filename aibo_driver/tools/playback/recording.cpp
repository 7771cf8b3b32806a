#include "tools/playback/recording.h"

#include <sensor_msgs/Imu.h>

#include <array>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <cstring>
#include <set>
#include <sstream>
#include <stdexcept>

namespace aibo_driver::tools {
namespace {

// The topics that show that a namespace has a robot.
constexpr std::array<const char*, 3> kSignsOfARobot{"/connection", "/joint_states", "/camera/image_raw/compressed"};

// The topics that drivers and aibo_room publish, except for tf.
constexpr std::array<const char*, 25> kOutputs{
    "audio",        "battery",     "camera/camera_info", "camera/image_raw", "camera/image_raw/compressed",
    "camera/state", "color_mask",  "color_regions",      "connection",       "imu/data_raw",
    "joint_states", "led_states",  "link_quality",       "microphone",       "motion_state",
    "odom",         "range/chest", "range/far",          "range/head",       "range/near",
    "robot_state",  "room",        "room/ball",          "streaming",        "touch",
};

std::set<std::string> robotsIn(const std::set<std::string>& topics) {
  std::set<std::string> robots;
  for (const std::string& topic : topics) {
    for (const char* sign : kSignsOfARobot) {
      if (boost::algorithm::ends_with(topic, sign)) {
        robots.insert(topic.substr(0, topic.size() - std::strlen(sign)));
      }
    }
  }
  return robots;
}

void open(rosbag::Bag& bag, const std::string& path) {
  try {
    bag.open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(
        path + " was not closed, because its recording was cut off. Repair it with: rosbag reindex " + path);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + " cannot be read as a bag: " + error.what() +
                             ". Does the file exist, and is it complete? An absolute path is needed.");
  }
}

/// True if the first field of a message is a header.
bool beginsWithHeader(const std::string& definition) {
  std::istringstream lines(definition);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string type;
    if (words >> type && line.find('=') == std::string::npos) {  // a field, neither a comment nor a constant
      return type == "Header" || type == "std_msgs/Header";
    }
  }
  return false;
}

}  // namespace

Recording::Recording(const std::string& path, const std::string& recorded_namespace)
    : name_(path.substr(path.rfind('/') + 1)) {
  open(bag_, path);
  choose(recorded_namespace);
  begin_ = messages_->getBeginTime();
  length_ = messages_->getEndTime() - begin_;
  try {
    findFramePrefix();
  } catch (const ros::Exception& error) {
    throw std::runtime_error(name_ + " is damaged at its beginning: " + error.what() + ".");
  }
}

void Recording::choose(const std::string& recorded_namespace) {
  std::set<std::string> topics;
  rosbag::View all(bag_);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    topics.insert(connection->topic);
  }
  std::set<std::string> robots = robotsIn(topics);
  if (robots.empty()) {
    throw std::runtime_error(all.size() == 0 ? name_ + " is empty: the driver sent nothing while it was recorded."
                                             : name_ + " has no robot, but only the topics " +
                                                   boost::algorithm::join(topics, ", ") + ".");
  }
  if (!recorded_namespace.empty() && robots.count(recorded_namespace) == 0) {
    throw std::runtime_error(name_ + " has no robot in " + recorded_namespace + ", but in " +
                             boost::algorithm::join(robots, ", ") + ".");
  }
  if (recorded_namespace.empty() && robots.size() > 1) {
    throw std::runtime_error(name_ + " has several robots: " + boost::algorithm::join(robots, ", ") +
                             ". Choose one, such as recorded_ns:=" + robots.begin()->substr(1) + ".");
  }
  name_space_ = recorded_namespace.empty() ? *robots.begin() : recorded_namespace;
  for (const char* name : kOutputs) {
    topics_[name_space_ + "/" + name] = name;
  }
  if (topics.count(name_space_ + "/camera/image_raw/compressed") > 0) {
    topics_.erase(name_space_ + "/camera/image_raw");
  }
  topics_["/recorded/diagnostics"] = topics_["/diagnostics"] = "diagnostics";
  messages_ = std::make_unique<rosbag::View>(
      bag_, [this](const rosbag::ConnectionInfo* connection) { return topics_.count(connection->topic) > 0; });
}

void Recording::findFramePrefix() {
  rosbag::View of_sensor(bag_, rosbag::TopicQuery(name_space_ + "/imu/data_raw"));
  if (const auto first = of_sensor.begin(); first != of_sensor.end()) {
    if (const auto imu = first->instantiate<sensor_msgs::Imu>()) {
      frame_prefix_ = imu->header.frame_id.substr(0, imu->header.frame_id.rfind('/') + 1);
    }
  }
}

// A serialized header begins with a sequence number, seconds and nanoseconds, each of 4 bytes.
void changeStamp(const std::string& definition, const std::function<ros::Time(const ros::Time&)>& change,
                 std::vector<std::uint8_t>& message) {
  constexpr std::size_t kSeconds = 4;
  constexpr std::size_t kNanoseconds = 8;
  constexpr std::size_t kEnd = 12;
  if (message.size() < kEnd || !beginsWithHeader(definition)) {
    return;
  }
  ros::Time stamp;
  std::memcpy(&stamp.sec, &message[kSeconds], sizeof(stamp.sec));
  std::memcpy(&stamp.nsec, &message[kNanoseconds], sizeof(stamp.nsec));
  if (stamp.isZero()) {
    return;
  }
  stamp = change(stamp);
  std::memcpy(&message[kSeconds], &stamp.sec, sizeof(stamp.sec));
  std::memcpy(&message[kNanoseconds], &stamp.nsec, sizeof(stamp.nsec));
}

}  // namespace aibo_driver::tools
