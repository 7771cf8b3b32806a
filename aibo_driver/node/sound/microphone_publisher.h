/// @file microphone_publisher.h
#ifndef AIBO_DRIVER_NODE_SOUND_MICROPHONE_PUBLISHER_H
#define AIBO_DRIVER_NODE_SOUND_MICROPHONE_PUBLISHER_H

#include <ros/node_handle.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "aibo_client/sound.h"
#include "node/driver_parameters.h"
#include "node/robot_stamper.h"
#include "node/sound/audio_publisher.h"

namespace aibo_driver::node {

/// Publishes what the robot hears, as `microphone`, and as `audio` if the driver was built with audio_common_msgs. The
/// robot's microphones are on only while one of the topics has a subscriber. Any thread may call any function.
class MicrophonePublisher {
 public:
  static constexpr std::uint32_t kQueueSize = 64;  ///< messages, which last for a second

  /// @param handle the driver's namespace
  /// @param robot_clock must outlive the publisher; if it is null, the stamp of a message is its time of arrival
  MicrophonePublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                      robot_time::RobotClock* robot_clock);

  /// Calls `listen` with what the robot should send, now and whenever a subscriber comes or goes.
  /// @param listen must not block
  void start(std::function<void(const aibo_client::MicrophoneSettings&)> listen);

  /// Stops the calls of `listen`. After this function returns, `listen` is not running and is not called any more.
  void stop();

  /// Publishes a piece of sound. It never blocks.
  void publish(const aibo_client::HeardSound& sound);

  bool hasSubscribers() const;

 private:
  void subscribersChanged();

  const std::string frame_id_;
  const aibo_client::MicrophoneSettings settings_;  ///< the settings while the microphones are on
  RobotStamper stamper_;
  std::mutex mutex_;
  std::function<void(const aibo_client::MicrophoneSettings&)> listen_;  ///< empty unless start() was called
  ros::Publisher publisher_;
  std::unique_ptr<AudioPublisher> audio_;  ///< null without audio_common_msgs
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_SOUND_MICROPHONE_PUBLISHER_H
