/// @file sound_services.h
#ifndef AIBO_DRIVER_NODE_SOUND_SOUND_SERVICES_H
#define AIBO_DRIVER_NODE_SOUND_SOUND_SERVICES_H

#include <aibo_driver/PlaySound.h>
#include <aibo_driver/Say.h>
#include <aibo_driver/SetVolume.h>
#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "sound/player.h"

namespace aibo_driver::node {

/// The services play_sound, say and set_volume. Each call waits for the robot's answer. If something cannot be done,
/// success is false and message says why. The call itself never fails.
class SoundServices {
 public:
  /// @param client, player must outlive the services
  SoundServices(aibo_client::RcServerClient& client, sound::Player& player) : client_(client), player_(player) {}

  void advertise(const ros::NodeHandle& handle);

  // These functions carry out the services. All of them return true, because roscpp wants that.
  bool playSound(PlaySound::Request& request, PlaySound::Response& response);
  bool say(Say::Request& request, Say::Response& response);
  bool setVolume(SetVolume::Request& request, SetVolume::Response& response);

 private:
  aibo_client::RcServerClient& client_;
  sound::Player& player_;
  std::vector<ros::ServiceServer> servers_;
};

/// The action play_sound.
class PlaySoundServer {
 public:
  PlaySoundServer() = default;
  virtual ~PlaySoundServer() = default;
  PlaySoundServer(const PlaySoundServer&) = delete;
  PlaySoundServer& operator=(const PlaySoundServer&) = delete;
};

/// @param handle the action is served by its queue
/// @param player must outlive the server
std::unique_ptr<PlaySoundServer> startPlaySoundServer(const ros::NodeHandle& handle, sound::Player& player);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_SOUND_SOUND_SERVICES_H
