#include "node/sound/sound_services.h"

#include "node/service_answer.h"
#include "sound/sound_file.h"
#include "sound/speech.h"

namespace aibo_driver::node {

void SoundServices::advertise(const ros::NodeHandle& handle) {
  ros::NodeHandle services(handle);
  servers_.push_back(services.advertiseService("play_sound", &SoundServices::playSound, this));
  servers_.push_back(services.advertiseService("say", &SoundServices::say, this));
  servers_.push_back(services.advertiseService("set_volume", &SoundServices::setVolume, this));
}

bool SoundServices::playSound(PlaySound::Request& request, PlaySound::Response& response) {
  if (request.stop) {
    return answer(response, "Nothing was stopped", [this] {
      player_.stop();
      return "No sound plays.";
    });
  }
  return answer(response, "Nothing was played", [&] {
    player_.play(sound::openSoundFile(request.file));
    return "'" + request.file + "' plays.";
  });
}

bool SoundServices::say(Say::Request& request, Say::Response& response) {
  return answer(response, "Nothing was said", [&] {
    player_.play(sound::speak(request.text, request.voice));
    return "The robot speaks.";
  });
}

bool SoundServices::setVolume(SetVolume::Request& request, SetVolume::Response& response) {
  return answer(response, "The volume was not set", [&] {
    response.volume = static_cast<std::uint8_t>(client_.setVolume(request.volume, sound::Player::kTimeout));
    return "The volume is " + std::to_string(response.volume) + ".";
  });
}

}  // namespace aibo_driver::node
