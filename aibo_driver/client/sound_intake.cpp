#include "client/sound_intake.h"

#include <algorithm>
#include <string>
#include <utility>

#include "client/fault.h"
#include "protocol/sound_requests.h"
#include "protocol/version2.h"
#include "robot_model/robot_model.h"

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

constexpr std::chrono::milliseconds kFrame{robot_model::FRAME_MILLISECONDS};

// How late sound may come. The client disconnects a robot that is silent for longer.
constexpr std::chrono::seconds kLongestDelay{5};
// The robot's clock may be faster than this computer's by one part in this number (our choice).
constexpr int kClockTolerance = 64;

}  // namespace

void SoundIntake::askedFor(const MicrophoneSettings& settings) {
  asked_ = settings;
  in_force_.reset();
  next_frame_.reset();
}

void SoundIntake::heard(const unsigned char* payload, std::size_t size, std::chrono::steady_clock::time_point arrival) {
  const auto pushed = decoded<version2::HeardSound>(payload, size, "sound");
  if (!in_force_ || !in_force_->on || pushed.channels != in_force_->channels) {
    return;  // the sound was on its way when the settings were changed
  }
  const unsigned frames = std::max(1U, (pushed.count + frameSize() - 1) / frameSize());
  if (!limit_.admit(arrival, kFrame / 2, static_cast<int>(frames)).is_admitted) {
    ++context_.counters.thinned_sounds;
    context_.warnOnce("sound",
                      "sends more than twice as much sound as it was asked to; the rest is dropped and counted");
    return;
  }
  HeardSound sound;
  sound.frame_number = pushed.frame_number;
  sound.arrival = arrival;
  sound.connection_number = context_.number;
  sound.channels = in_force_->channels;
  sound.samples_per_second = in_force_->samples_per_second;
  sound.missing = missingBefore(pushed.frame_number, pushed.count, arrival);
  sound.samples.reserve(pushed.samples_size / version2::BYTES_PER_SAMPLE);
  for (std::size_t i = 0; i < pushed.samples_size; i += version2::BYTES_PER_SAMPLE) {
    sound.samples.push_back(protocol::decodeBigEndianSigned16(pushed.samples + i));
  }
  ++context_.counters.sounds;
  context_.counters.sound_gaps += sound.missing > 0 ? 1 : 0;
  context_.notifier.tell(&Callbacks::on_heard, "on_heard", sound);
}

/// Samples of each channel in a frame.
unsigned SoundIntake::frameSize() const {
  return version2::SAMPLES_PER_FRAME * static_cast<unsigned>(in_force_->samples_per_second) / 16000;
}

/// Samples of each channel that should have come before this frame. A frame number that goes back, or runs ahead of the
/// time that has passed, is ignored, because users fill what is missing with silence.
std::uint32_t SoundIntake::missingBefore(std::uint32_t frame_number, unsigned count,
                                         std::chrono::steady_clock::time_point arrival) {
  const auto skipped = next_frame_ ? static_cast<std::int32_t>(frame_number - *next_frame_) : 0;
  if (!next_frame_) {
    began_ = arrival;
    frames_ = 0;
  }
  const unsigned already_heard = next_frame_ ? beyond_frame_ : 0;
  const unsigned heard = (skipped == 0 ? already_heard : 0) + count;
  next_frame_ = frame_number + heard / frameSize();
  beyond_frame_ = heard % frameSize();
  frames_ += heard / frameSize();
  const auto passed = arrival - began_;
  const auto most = static_cast<std::uint64_t>((passed + passed / kClockTolerance + kLongestDelay) / kFrame);
  if (skipped <= 0 || frames_ + static_cast<std::uint64_t>(skipped) > most) {
    return 0;
  }
  frames_ += static_cast<std::uint64_t>(skipped);
  return static_cast<std::uint32_t>(skipped) * frameSize() - already_heard;
}

// The robot may report the end of a sound only after it has accepted the next one. So the end of a sound that this
// client itself has stopped or replaced is reported at once, and the robot's report is ignored.
void SoundIntake::accepted(const SoundPart& part) {
  if (part.size == 0) {
    return end(EndedHow::kStopped);
  }
  if (part.sound <= ended_ || (playing_ && part.sound < playing_->sound)) {
    return;  // the robot has meanwhile ended the sound, or answers in another order
  }
  if (part.position == 0) {
    end(EndedHow::kReplaced);
  }
  playing_ = part;
}

void SoundIntake::ended(const unsigned char* payload, std::size_t size) {
  const auto pushed = decoded<version2::SoundEnd>(payload, size, "sound");
  const bool is_known_already = pushed.how == version2::END_REPLACED || pushed.how == version2::END_STOPPED;
  if (!playing_ || is_known_already) {
    return;
  }
  // If the last samples come too late, the robot has already played at least as many samples of silence instead.
  const std::uint32_t whole = playing_->position + playing_->size;
  const bool is_whole = pushed.samples == whole || (pushed.samples > whole && pushed.gaps > 0);
  if (pushed.how == version2::END_DONE && !(playing_->is_last && is_whole)) {
    return;  // the robot reports the end of an earlier sound
  }
  const EndedHow how = pushed.how == version2::END_DONE      ? EndedHow::kDone
                       : pushed.how == version2::END_REFUSED ? EndedHow::kRefused
                                                             : EndedHow::kUnknown;
  const SoundEnd end = {playing_->sound, how, pushed.samples, pushed.gaps, pushed.missing};
  playing_.reset();
  ended_ = end.sound;
  context_.notifier.tell(&Callbacks::on_sound_ended, "on_sound_ended", end);
}

void SoundIntake::end(EndedHow how) {
  if (const std::optional<SoundPart> gone = std::exchange(playing_, std::nullopt)) {
    ended_ = gone->sound;
    context_.notifier.tell(&Callbacks::on_sound_ended, "on_sound_ended", {gone->sound, how, 0, 0, 0});
  }
}

}  // namespace aibo_client
