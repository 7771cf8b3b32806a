#include "sound/player.h"

#include <utility>

#include "aibo_client/exceptions.h"
#include "text/sentence.h"

namespace aibo_driver::sound {

using aibo_client::EndedHow;
using aibo_client::kMostSamplesAtOnce;
using aibo_client::kSoundRate;
using aibo_client::SoundEnd;

namespace {

// The robot frees room for 512 samples at a time, and its clock may be slower than ours.
constexpr double kSlowestRate = 0.9 * kSoundRate;
constexpr std::size_t kFreedAtOnce = 512;

/// How long to wait until there is room for one request.
std::chrono::duration<double> timeUntilRoom(std::size_t room) {
  const std::size_t needed = kMostSamplesAtOnce + kFreedAtOnce;
  return std::chrono::duration<double>(room >= kMostSamplesAtOnce ? 0
                                                                  : static_cast<double>(needed - room) / kSlowestRate);
}

std::string secondsOf(std::uint32_t samples) {
  return text::decimal(samples / static_cast<double>(kSoundRate), 1) + " s";
}

std::string describe(const SoundEnd& end, const std::string& problem) {
  switch (end.how) {
    case EndedHow::kDone:
      return "It was played to its end, " + secondsOf(end.samples) +
             (end.gaps == 0 ? "."
                            : ". " + std::to_string(end.gaps) + " gaps, " + secondsOf(end.missing) +
                                  " in all, because samples came too late: is the radio link weak?");
    case EndedHow::kReplaced:
      return "Another sound has replaced it.";
    case EndedHow::kStopped:
      return "It was stopped.";
    case EndedHow::kRefused:
      return "The robot has ended it: " + (problem.empty() ? "no more samples came for 2 s." : problem);
    case EndedHow::kLost:
      return "The connection to the robot was lost. The sound does not go on when it is back.";
    default:
      return "The robot does not say how it has ended.";
  }
}

}  // namespace

std::optional<PlayedSound> Playback::end() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return end_ ? std::optional<PlayedSound>({end_->how, describe(*end_, problem_)}) : std::nullopt;
}

std::shared_ptr<Playback> Player::play(Source source) {
  const std::lock_guard<std::mutex> order(order_mutex_);
  const auto playback = std::make_shared<Playback>();
  const std::vector<std::int16_t> first = source(kMostSamplesAtOnce);
  if (first.empty()) {
    throw aibo_client::InvalidArgumentException("there is no sound in it");
  }
  playback->next_ = source(kMostSamplesAtOnce);
  playback->source_ = std::move(source);
  const aibo_client::SoundProgress progress = client_.playSamples(0, first, playback->next_.empty(), kTimeout);
  playback->number_ = progress.sound;
  giveUp();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    playback_ = playback;
    if (early_end_ && early_end_->sound == progress.sound) {
      playback->end_ = early_end_;
    }
    early_end_.reset();  // a robot that restarts counts its sounds from the beginning
  }
  if (!playback->next_.empty()) {
    feeder_ = std::thread([this, playback, room = progress.room] { feed(playback.get(), room); });
  }
  return playback;
}

void Player::stop(const std::shared_ptr<Playback>& playback) {
  const std::lock_guard<std::mutex> order(order_mutex_);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!playback_ || playback_->end() || (playback && playback != playback_)) {
      return;
    }
  }
  client_.stopSound(kTimeout);
  giveUp();
}

void Player::ended(const SoundEnd& end) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (playback_ && playback_->number_ == end.sound) {
    const std::lock_guard<std::mutex> playback_lock(playback_->mutex_);
    playback_->end_ = end;
    playback_->changed_.notify_all();
  } else {
    early_end_ = end;
  }
}

bool Player::isPlaying() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return playback_ && !playback_->end();
}

void Player::finish() {
  const std::lock_guard<std::mutex> order(order_mutex_);
  giveUp();
}

/// Ends the thread of the present sound.
void Player::giveUp() {
  std::shared_ptr<Playback> playback;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    playback = playback_;
  }
  if (playback) {
    const std::lock_guard<std::mutex> lock(playback->mutex_);
    playback->is_given_up_ = true;
    playback->changed_.notify_all();
  }
  if (feeder_.joinable()) {
    feeder_.join();
  }
}

// If a request fails, the client reports the sound's end: at once, or when the robot has got no samples for 2 s.
void Player::feed(Playback* playback, std::size_t room) {
  try {
    for (bool is_last = false; !is_last;) {
      {
        std::unique_lock<std::mutex> lock(playback->mutex_);
        const auto is_over = [playback] { return playback->is_given_up_ || playback->end_; };
        if (playback->changed_.wait_for(lock, timeUntilRoom(room), is_over)) {
          return;
        }
      }
      const std::vector<std::int16_t> samples = std::exchange(playback->next_, playback->source_(kMostSamplesAtOnce));
      is_last = playback->next_.empty();
      room = client_.playSamples(playback->number_, samples, is_last, kTimeout).room;
    }
  } catch (const std::exception& error) {
    const std::lock_guard<std::mutex> lock(playback->mutex_);
    playback->problem_ = error.what();
  }
}

}  // namespace aibo_driver::sound
