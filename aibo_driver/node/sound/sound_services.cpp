#include <aibo_driver/PlaySound.h>
#include <aibo_driver/Say.h>
#include <aibo_driver/SetVolume.h>

#include <cstdint>
#include <string>

#include "node/service.h"
#include "node/services.h"
#include "sound/source.h"

namespace aibo_driver::node {

Services soundServices(aibo_client::RcServerClient& client, sound::Player& player) {
  return {
      service<PlaySound>("play_sound", "Nothing was played",
                         [&player](auto& call) -> std::string {
                           if (call.request.stop) {
                             call.failure = "Nothing was stopped";
                             player.stop();
                             return "No sound plays.";
                           }
                           player.play(sound::openSoundFile(call.request.file));
                           return "'" + call.request.file + "' plays.";
                         }),
      service<Say>("say", "Nothing was said",
                   [&player](auto& call) {
                     player.play(sound::speak(call.request.text, call.request.voice));
                     return "The robot speaks.";
                   }),
      service<SetVolume>("set_volume", "The volume was not set",
                         [&client](auto& call) {
                           const int volume = client.setVolume(call.request.volume, sound::Player::kTimeout);
                           call.response.volume = static_cast<std::uint8_t>(volume);
                           return "The volume is " + std::to_string(volume) + ".";
                         }),
  };
}

}  // namespace aibo_driver::node
