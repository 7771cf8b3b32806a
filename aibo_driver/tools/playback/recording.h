/// @file recording.h
#ifndef AIBO_DRIVER_TOOLS_PLAYBACK_RECORDING_H
#define AIBO_DRIVER_TOOLS_PLAYBACK_RECORDING_H

#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace aibo_driver::tools {

/// What a bag holds of one robot: the topics that a driver publishes, and those of the simulated robot's room. Left out
/// are what a driver obeys, such as cmd_vel; tf, which is made again from the measurements; and decoded pictures, if
/// the robot's JPEGs are there.
class Recording {
 public:
  /// @param path a bag of record.launch, or another one with the driver's topics
  /// @param recorded_namespace the robot's namespace in the bag; empty if the bag has only one robot
  /// @throw std::runtime_error the bag cannot be used; the message says why and what to do
  Recording(const std::string& path, const std::string& recorded_namespace);

  /// The name of the file, without its folder.
  const std::string& name() const { return name_; }

  /// The robot's namespace in the bag, such as "/recorded/aibo".
  const std::string& nameSpace() const { return name_space_; }

  /// The text that the driver put before the names of all frames in tf: empty, or with a / at its end.
  const std::string& framePrefix() const { return frame_prefix_; }

  ros::Time begin() const { return begin_; }
  ros::Duration length() const { return length_; }

  /// The topics in the bag and, for each of them, its name without a namespace, such as "joint_states". These names are
  /// ours, so a bag from a stranger cannot choose others.
  const std::map<std::string, std::string>& topics() const { return topics_; }

  /// The messages of these topics, in the order of their times.
  rosbag::View& messages() { return *messages_; }

 private:
  void choose(const std::string& recorded_namespace);
  void findFramePrefix();

  rosbag::Bag bag_;
  std::string name_;
  std::string name_space_;
  std::map<std::string, std::string> topics_;
  std::string frame_prefix_;
  ros::Time begin_;
  ros::Duration length_;
  std::unique_ptr<rosbag::View> messages_;  // after the bag, which it uses
};

/// When each moment of a recording is played.
class Timeline {
 public:
  /// @param rate how much faster than the recording it plays, above 0
  explicit Timeline(double rate) : rate_(rate) {}

  /// Plays this moment of the recording now, and all other moments relative to it.
  void anchor(const ros::Time& recorded, const ros::Time& now) {
    recorded_ = recorded;
    now_ = now;
  }

  /// When a moment of the recording is played.
  ros::Time timeOf(const ros::Time& recorded) const { return now_ + (recorded - recorded_) * (1 / rate_); }

  /// Which moment of the recording is played at this time.
  ros::Time recordedAt(const ros::Time& now) const { return recorded_ + (now - now_) * rate_; }

 private:
  const double rate_;
  ros::Time recorded_;
  ros::Time now_;
};

/// Changes the stamp of a message, if the message begins with a header and the stamp is not 0.
/// @param definition the definition of the message
/// @param change gives the new stamp for an old one
/// @param message the serialized message
void changeStamp(const std::string& definition, const std::function<ros::Time(const ros::Time&)>& change,
                 std::vector<std::uint8_t>& message);

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_PLAYBACK_RECORDING_H
