// This file is for a system without audio_common_msgs, such as Debian.

#include "node/sound/audio_publisher.h"

namespace aibo_driver::node {

std::unique_ptr<AudioPublisher> advertiseAudio(ros::NodeHandle, const ros::SubscriberStatusCallback&) {
  return nullptr;
}

}  // namespace aibo_driver::node
