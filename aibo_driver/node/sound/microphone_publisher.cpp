#include "node/sound/microphone_publisher.h"

#include <aibo_driver/Sound.h>

#include <utility>

namespace aibo_driver::node {

MicrophonePublisher::MicrophonePublisher(const ros::NodeHandle& handle, const DriverParameters& parameters,
                                         robot_time::RobotClock* robot_clock)
    : frame_id_(parameters.frame("base_link")),
      settings_({true, parameters.microphone_channels, aibo_client::kSoundRate, parameters.sound_priority}),
      stamper_(robot_clock, parameters.time_offset) {
  const ros::SubscriberStatusCallback on_change = [this](const ros::SingleSubscriberPublisher&) {
    subscribersChanged();
  };
  publisher_ = ros::NodeHandle(handle).advertise<Sound>("microphone", kQueueSize, on_change, on_change);
  audio_ = advertiseAudio(handle, on_change);
}

void MicrophonePublisher::start(std::function<void(const aibo_client::MicrophoneSettings&)> listen) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    listen_ = std::move(listen);
  }
  subscribersChanged();
}

void MicrophonePublisher::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  listen_ = nullptr;
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
  publisher_.publish(message);
  if (audio_) {
    audio_->publish(message);
  }
}

bool MicrophonePublisher::hasSubscribers() const {
  return publisher_.getNumSubscribers() > 0 || (audio_ && audio_->hasSubscribers());
}

void MicrophonePublisher::subscribersChanged() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (listen_) {
    aibo_client::MicrophoneSettings settings = settings_;
    settings.on = hasSubscribers();
    listen_(settings);
  }
}

}  // namespace aibo_driver::node
