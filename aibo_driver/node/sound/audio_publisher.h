/// @file audio_publisher.h
#ifndef AIBO_DRIVER_NODE_SOUND_AUDIO_PUBLISHER_H
#define AIBO_DRIVER_NODE_SOUND_AUDIO_PUBLISHER_H

#include <aibo_driver/Sound.h>
#include <ros/node_handle.h>

#include <memory>

namespace aibo_driver::node {

/// Publishes what the robot hears as `audio`, for the nodes of audio_common: 16 bits, little-endian, channels in turn.
/// These messages cannot say that sound is missing, so a gap of up to a second is filled with silence. A longer gap
/// shows only in the stamps. Any thread may call any function.
class AudioPublisher {
 public:
  virtual ~AudioPublisher() = default;

  virtual bool hasSubscribers() const = 0;

  /// Publishes a piece of sound. It never blocks.
  virtual void publish(const Sound& sound) = 0;
};

/// @param on_change called when a subscriber comes or goes
/// @return null if the driver was built without audio_common_msgs
std::unique_ptr<AudioPublisher> advertiseAudio(ros::NodeHandle handle, const ros::SubscriberStatusCallback& on_change);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_SOUND_AUDIO_PUBLISHER_H
