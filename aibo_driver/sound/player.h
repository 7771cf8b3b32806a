/// @file player.h
#ifndef AIBO_DRIVER_SOUND_PLAYER_H
#define AIBO_DRIVER_SOUND_PLAYER_H

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "sound/source.h"

namespace aibo_driver::sound {

/// How a sound was played.
struct PlayedSound {
  aibo_client::EndedHow how = aibo_client::EndedHow::kUnknown;
  std::string message;  ///< in a sentence for the user
};

/// A sound that plays or has played. Any thread may call any function.
class Playback {
 public:
  /// How the sound was played; empty while it plays.
  std::optional<PlayedSound> end() const;

  /// The time since the sound began.
  std::chrono::duration<double> time() const { return std::chrono::steady_clock::now() - begin_; }

 private:
  friend class Player;

  std::uint64_t number_ = 0;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Source source_;
  std::vector<std::int16_t> next_;  ///< samples that were read but not sent
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool is_given_up_ = false;                  // guarded by mutex_
  std::string problem_;                       // why no more samples were sent; guarded by mutex_
  std::optional<aibo_client::SoundEnd> end_;  // guarded by mutex_
};

/// Plays one sound at a time on the robot. It reads the source as fast as the robot plays, and keeps the robot's buffer
/// nearly full. Any thread may call any function, except where its comment says otherwise.
class Player {
 public:
  static constexpr std::chrono::milliseconds kTimeout{2000};  ///< how long to wait for an answer of the robot

  /// @param client must outlive the player. Its on_sound_ended has to call ended()
  explicit Player(aibo_client::RcServerClient& client) : client_(client) {}
  ~Player() { finish(); }

  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Begins a sound. It replaces the one that plays.
  /// @throw InvalidArgumentException the source has no sound
  /// @throw the exceptions of RcServerClient::playSamples()
  std::shared_ptr<Playback> play(Source source);

  /// Stops this sound or, if `playback` is null, the sound that plays. Nothing happens if it has ended.
  /// @throw the exceptions of RcServerClient::stopSound()
  void stop(const std::shared_ptr<Playback>& playback = nullptr);

  /// Call this on the client's thread, which it does not block.
  void ended(const aibo_client::SoundEnd& end);

  /// True while a sound plays.
  bool isPlaying() const;

  /// Sends no more samples. The client should be stopped.
  void finish();

 private:
  void feed(Playback* playback, std::size_t room);
  void giveUp();

  aibo_client::RcServerClient& client_;
  std::mutex order_mutex_;  ///< held from the beginning to the end of play(), stop() and finish()
  std::thread feeder_;      // guarded by order_mutex_
  mutable std::mutex mutex_;
  std::shared_ptr<Playback> playback_;              // the newest sound; guarded by mutex_
  std::optional<aibo_client::SoundEnd> early_end_;  // the last one of a sound that was not playback_; guarded by mutex_
};

}  // namespace aibo_driver::sound

#endif  // AIBO_DRIVER_SOUND_PLAYER_H
