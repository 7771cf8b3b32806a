#include "node/sound/microphone_publisher.h"

#include <aibo_driver/Sound.h>

#include <cstddef>
#include <cstdint>

#ifdef HAS_AUDIO_COMMON_MSGS
#include <audio_common_msgs/AudioDataStamped.h>
#endif

namespace aibo_driver::node {
namespace {

constexpr std::uint32_t kSoundQueueSize = 64;  // messages, which last for a second

#ifdef HAS_AUDIO_COMMON_MSGS
audio_common_msgs::AudioDataStamped toAudio(const Sound& sound) {
  audio_common_msgs::AudioDataStamped message;
  message.header = sound.header;
  const std::uint32_t silent = sound.missing <= sound.samples_per_second ? sound.missing : 0;
  message.header.stamp -= ros::Duration(static_cast<double>(silent) / sound.samples_per_second);
  message.audio.data.resize(2 * std::size_t{silent} * sound.channels);
  for (const std::int16_t sample : sound.samples) {
    message.audio.data.push_back(static_cast<std::uint8_t>(sample & 0xff));
    message.audio.data.push_back(static_cast<std::uint8_t>((sample >> 8) & 0xff));
  }
  return message;
}
#endif

}  // namespace

MicrophonePublisher::MicrophonePublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                                         robot_time::RobotClock* robot_clock,
                                         const std::function<void(const aibo_client::MicrophoneSettings&)>& listen)
    : frame_id_(parameters.frame("base_link")),
      channels_(parameters.microphone_channels),
      priority_(parameters.sound_priority),
      stamper_(robot_clock, parameters.time_offset) {
  const ros::SubscriberStatusCallback on_change = [this, listen](const ros::SingleSubscriberPublisher&) {
    listen(settings());
  };
  ros::NodeHandle topics(handle);
  microphone_ = topics.advertise<Sound>("microphone", kSoundQueueSize, on_change, on_change);
#ifdef HAS_AUDIO_COMMON_MSGS
  audio_ = topics.advertise<audio_common_msgs::AudioDataStamped>("audio", kSoundQueueSize, on_change, on_change);
#endif
}

aibo_client::MicrophoneSettings MicrophonePublisher::settings() const {
  return {hasSubscribers(), channels_, aibo_client::kSoundRate, priority_};
}

void MicrophonePublisher::publish(const aibo_client::HeardSound& sound) {
  Sound message;
  message.header.stamp = stamper_.stamp(sound);
  message.header.frame_id = frame_id_;
  message.frame_number = sound.frame_number;
  message.missing = sound.missing;
  message.samples_per_second = static_cast<std::uint32_t>(sound.samples_per_second);
  message.channels = static_cast<std::uint8_t>(sound.channels);
  message.samples = sound.samples;
  microphone_.publish(message);
#ifdef HAS_AUDIO_COMMON_MSGS
  audio_.publish(toAudio(message));
#endif
}

}  // namespace aibo_driver::node
