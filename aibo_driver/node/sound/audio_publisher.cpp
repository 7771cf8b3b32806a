#include "node/sound/audio_publisher.h"

#include <audio_common_msgs/AudioDataStamped.h>

#include <cstddef>
#include <cstdint>

#include "node/sound/microphone_publisher.h"

namespace aibo_driver::node {
namespace {

class StampedAudio : public AudioPublisher {
 public:
  StampedAudio(ros::NodeHandle& handle, const ros::SubscriberStatusCallback& on_change)
      : publisher_(handle.advertise<audio_common_msgs::AudioDataStamped>("audio", MicrophonePublisher::kQueueSize,
                                                                         on_change, on_change)) {}

  bool hasSubscribers() const override { return publisher_.getNumSubscribers() > 0; }

  void publish(const Sound& sound) override {
    audio_common_msgs::AudioDataStamped message;
    message.header = sound.header;
    const std::uint32_t silent = sound.missing <= sound.samples_per_second ? sound.missing : 0;
    message.header.stamp -= ros::Duration(static_cast<double>(silent) / sound.samples_per_second);
    message.audio.data.resize(2 * std::size_t{silent} * sound.channels);
    for (const std::int16_t sample : sound.samples) {
      message.audio.data.push_back(static_cast<std::uint8_t>(sample & 0xff));
      message.audio.data.push_back(static_cast<std::uint8_t>((sample >> 8) & 0xff));
    }
    publisher_.publish(message);
  }

 private:
  const ros::Publisher publisher_;
};

}  // namespace

std::unique_ptr<AudioPublisher> advertiseAudio(ros::NodeHandle handle, const ros::SubscriberStatusCallback& on_change) {
  return std::make_unique<StampedAudio>(handle, on_change);
}

}  // namespace aibo_driver::node
