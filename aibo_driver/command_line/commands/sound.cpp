#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "aibo_client/exceptions.h"
#include "command_line/commands/commands.h"
#include "command_line/interruption.h"
#include "command_line/quantities.h"
#include "sound/level.h"
#include "sound/player.h"
#include "sound/recording.h"
#include "sound/source.h"
#include "text/sentence.h"

namespace aibo_driver::command_line {
namespace {

using std::chrono::seconds;

constexpr double kLongest = 24 * 3600;  // s
constexpr seconds kFirstSoundTimeout{3};
constexpr seconds kLongestSilence{5};

/// Prints the level once a second.
void showLevel(const aibo_client::HeardSound& sound, sound::Level* level, Output& output) {
  level->add(sound.samples);
  if (level->count() >= static_cast<std::size_t>(sound.channels) * static_cast<std::size_t>(sound.samples_per_second)) {
    output.note("level " + std::to_string(std::lround(level->take())) + " dB");
  }
}

void requireSound(const Robot& robot) {
  if (!robot.received().status.robot.hasCapability("A")) {
    throw aibo_client::CommandException("the robot's server speaks version 1 of the protocol, which has no sound");
  }
}

ExitStatus listen(const Arguments& arguments, Output& output) {
  const double longest = arguments.has("seconds") ? arguments.number("seconds", 0.1, kLongest) : kLongest;
  const aibo_client::MicrophoneSettings settings = {true, arguments.has("mono") ? 1 : 2, aibo_client::kSoundRate};
  Robot robot(arguments.robot, output);
  robot.connect();
  requireSound(robot);
  robot.client().setMicrophone(settings);
  const auto hears = [](const Received& received) { return !received.sounds.empty(); };
  if (!robot.waitUnlessRefused(hears, kFirstSoundTimeout)) {
    throw FailedException("the robot has sent no sound");
  }
  std::optional<sound::Recording> recording;
  if (!arguments.words.empty()) {
    recording.emplace(arguments.words.front(), settings);
  }
  sound::Level level;
  double heard = 0;
  std::uint64_t gaps = 0;
  try {
    while (heard < longest && robot.waitUntil(hears, kLongestSilence)) {
      for (const aibo_client::HeardSound& sound : robot.takeSounds()) {
        gaps += sound.missing > 0 ? 1 : 0;
        heard += static_cast<double>(sound.samples.size()) / sound.channels / sound.samples_per_second;
        if (recording) {
          recording->add(sound);
        } else {
          showLevel(sound, &level, output);
        }
      }
    }
  } catch (const Interrupted&) {
    // The time is over, which is the normal end.
  }
  output.result((recording ? arguments.words.front() + " has " : "Heard ") + text::decimal(heard, 1) + " s of sound" +
                    (gaps > 0 ? ", with " + counted(gaps, "gap") + "." : "."),
                Json::object({{"seconds", heard}, {"gaps", gaps}}));
  return kDone;
}

std::optional<int> volumeIn(const Arguments& arguments) {
  return arguments.has("volume") ? std::make_optional(arguments.wholeNumber("volume", 0, aibo_client::kLoudestVolume))
                                 : std::nullopt;
}

/// Plays a sound to its end. Ctrl-C stops it.
ExitStatus play(const Arguments& arguments, Output& output, std::optional<int> volume, sound::Source source) {
  std::unique_ptr<sound::Player> player;
  Robot robot(arguments.robot, output, {}, [&player](const aibo_client::SoundEnd& end) { player->ended(end); });
  player = std::make_unique<sound::Player>(robot.client());
  // The client ends before the player, and no samples may be sent after that, however this function ends.
  const std::shared_ptr<void> finish(nullptr, [&player](void*) { player->finish(); });
  robot.connect();
  if (volume) {
    robot.client().setVolume(*volume, Robot::kTimeout);
  }
  const auto playback = player->play(std::move(source));
  try {
    robot.waitUntil([&playback](const Received&) { return playback->end().has_value(); }, nanosecondsOf(kLongest),
                    Robot::Loss::kIsTolerated);
  } catch (const Interrupted&) {
    player->stop();
    throw;
  }
  const std::optional<sound::PlayedSound> end = playback->end();
  if (!end || end->how != aibo_client::EndedHow::kDone) {
    throw FailedException(end ? end->message : "the robot does not say that the sound has ended");
  }
  output.result(end->message, Json::object({{"to_its_end", true}, {"message", end->message}}));
  return kDone;
}

ExitStatus playSound(const Arguments& arguments, Output& output) {
  const std::optional<int> volume = volumeIn(arguments);
  return play(arguments, output, volume, sound::openSoundFile(arguments.words.front()));
}

ExitStatus say(const Arguments& arguments, Output& output) {
  const std::optional<int> volume = volumeIn(arguments);
  std::string text;
  for (const std::string& word : arguments.words) {
    text += (text.empty() ? "" : " ") + word;
  }
  return play(arguments, output, volume, sound::speak(text, arguments.get("voice")));
}

}  // namespace

std::vector<Command> soundCommands() {
  const Option volume = {"volume", "N", "", "0 (silent) to 3; the default is that of the robot's own switch"};
  return {
      {"listen",
       "[FILE]",
       "shows how loud it is around the robot, or records it",
       "The robot's RCSERVER.CFG has to allow it (ALLOW_MICROPHONE). FILE becomes a WAV file of 16 kHz; it must not "
       "exist yet. Sound that is missing because the link was too slow becomes silence. Ctrl-C ends it.",
       {{"listen", "a line a second with the level in dB"}, {"listen room.wav --seconds 10", "records ten seconds"}},
       listen,
       {{"seconds", "S", "", "how long to listen; the default is until Ctrl-C"},
        {"mono", "", "", "the mean of both microphones, with half the data"}}},
      {"play-sound",
       "FILE",
       "plays a sound file on the robot",
       "The file can be WAV, FLAC or Ogg, with any sample rate. The command stays connected until the sound has ended, "
       "because the robot ends its sounds when its client goes; Ctrl-C stops it.",
       {{"play-sound bark.wav", "to its end"}},
       playSound,
       {volume}},
      {"say",
       "TEXT...",
       "says a text through the robot's speaker",
       "It needs the program espeak-ng on this computer (sudo apt install espeak-ng).",
       {{"say hello", "in English"}, {"say --voice de Guten Morgen", "in German"}},
       say,
       {volume, {"voice", "NAME", "", "a voice of espeak-ng, such as de or en-us; the default is English"}}}};
}

}  // namespace aibo_driver::command_line
