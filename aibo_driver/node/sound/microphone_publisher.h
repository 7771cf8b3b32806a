/// @file microphone_publisher.h
#ifndef AIBO_DRIVER_NODE_SOUND_MICROPHONE_PUBLISHER_H
#define AIBO_DRIVER_NODE_SOUND_MICROPHONE_PUBLISHER_H

#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "aibo_client/sound.h"
#include "node/driver_parameters.h"
#include "node/robot_stamper.h"

namespace aibo_driver::node {

/// Publishes what the robot hears, as `microphone`, and as `audio` if the driver was built with audio_common_msgs. The
/// robot's microphones are on only while one of the topics has a subscriber. Any thread may call any function.
///
/// `audio` is for the nodes of audio_common: 16 bits, little-endian, channels in turn. Its messages cannot say that
/// sound is missing, so a gap of up to a second is filled with silence. A longer gap shows only in the stamps.
class MicrophonePublisher {
 public:
  /// @param handle the driver's namespace
  /// @param robot_clock must outlive the publisher; if it is null, the stamp of a message is its time of arrival
  /// @param listen called from the handle's callback queue with what the robot should send, whenever a subscriber comes
  ///   or goes; must not block
  MicrophonePublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                      robot_time::RobotClock* robot_clock,
                      const std::function<void(const aibo_client::MicrophoneSettings&)>& listen);

  /// Publishes a piece of sound. It never blocks.
  void publish(const aibo_client::HeardSound& sound);

  /// What the robot should send now.
  aibo_client::MicrophoneSettings settings() const;

  bool hasSubscribers() const { return microphone_.getNumSubscribers() > 0 || audio_.getNumSubscribers() > 0; }

 private:
  const std::string frame_id_;
  const int channels_;
  const bool priority_;
  RobotStamper stamper_;
  ros::Publisher microphone_;
  ros::Publisher audio_;  ///< has no subscribers without audio_common_msgs
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_SOUND_MICROPHONE_PUBLISHER_H
