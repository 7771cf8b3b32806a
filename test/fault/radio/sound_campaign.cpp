/// @file sound_campaign.cpp
/// Sound both ways between the client and the real RCServer over an emulated 802.11b link: delay, loss, bandwidth, and
/// orders to stop meanwhile.

#include <algorithm>
#include <atomic>
#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "aibo_client/exceptions.h"
#include "aibo_client/rcserver_client.h"
#include "objects/HostSettings.h"
#include "radio/network_host.h"
#include "radio/radio_link.h"
#include "simulator/ers7/simulated_ers7.h"
#include "sound/player.h"
#include "support/memory_stick.h"
#include "support/program.h"
#include "support/robot_thread.h"

namespace fault_bench {
namespace {

using aibo_client::HeardSound;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr char kRobotAddress[] = "10.77.0.1";
constexpr char kComputerAddress[] = "10.77.0.2";
constexpr std::uint32_t kSamplesPerFrame = 128;
constexpr milliseconds kFrame{8};
constexpr milliseconds kBetweenStops{500};
constexpr milliseconds kAnswerTimeout{5000};

/// What the robot plays: no sample of it is 0, so silence is a gap.
std::int16_t playedSample(std::uint64_t position) {
  return static_cast<std::int16_t>(position % 32749 + 1);
}

class CodedSource : public aibo_driver::sound::Source {
 public:
  std::vector<std::int16_t> read(std::size_t most) override {
    std::vector<std::int16_t> samples(most);
    std::generate(samples.begin(), samples.end(), [this] { return playedSample(position_++); });
    return samples;
  }

 private:
  std::uint64_t position_ = 0;
};

/// Its microphones hear the number of each sample since the robot was started: the low half left, the high half right.
class CodedRobot : public simulated_ers7::SimulatedErs7 {
 public:
  struct Played {
    std::uint64_t samples = 0;  ///< since the first one that was not silence
    std::uint64_t silent = 0;
    std::uint64_t wrong = 0;
  };

  openr_host::MicrophoneFrame passSound(longword frame, const openr_host::SpeakerFrame* played) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    times_[frame] = steady_clock::now() - kFrame;
    times_.erase(times_.begin(), times_.lower_bound(frame - std::min<longword>(frame, kFramesRemembered)));
    if (played != nullptr) {
      check(*played);
    }
    openr_host::MicrophoneFrame heard{};
    for (std::uint32_t i = 0; i < kSamplesPerFrame; ++i) {
      const std::uint32_t number = frame * kSamplesPerFrame + i;
      heard[i].L = static_cast<sword>(number & 0xffff);
      heard[i].R = static_cast<sword>(number >> 16);
    }
    return heard;
  }

  /// When the first sample of this frame was heard.
  steady_clock::time_point timeOf(std::uint32_t frame) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = times_.find(frame);
    return found == times_.end() ? steady_clock::time_point() : found->second;
  }

  Played played() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return played_;
  }

 private:
  static constexpr longword kFramesRemembered = 125 * 30;

  void check(const openr_host::SpeakerFrame& frame) {
    for (const sword sample : frame) {
      if (played_.samples == 0 && sample == 0) {
        continue;
      }
      played_.silent += sample == 0 ? 1 : 0;
      played_.wrong += sample != 0 && sample != playedSample(played_.samples) ? 1 : 0;
      ++played_.samples;
    }
  }

  mutable std::mutex mutex_;  // guards what follows
  std::map<std::uint32_t, steady_clock::time_point> times_;
  Played played_;
};

struct Trial {
  std::string title;
  RadioOptions radio;
  milliseconds length{15000};
  aibo_client::MicrophoneSettings microphone{true, 2, 16000, false};
  bool speaker = false;
  bool pictures = false;
  milliseconds most_delay{0};  ///< for the median; 0 = any
  bool may_miss = false;       ///< sound may be missing
};

/// Checks what the client hears.
class Listener {
 public:
  Listener(const CodedRobot& robot, const aibo_client::MicrophoneSettings& settings)
      : robot_(robot), settings_(settings) {}

  void hear(const HeardSound& sound) {
    const auto now = steady_clock::now();
    const std::lock_guard<std::mutex> lock(mutex_);
    delays_.push_back(Milliseconds(now - robot_.timeOf(sound.frame_number)).count());
    const std::size_t count = sound.samples.size() / static_cast<std::size_t>(sound.channels);
    missing_ += sound.missing;
    gaps_ += sound.missing > 0 ? 1 : 0;
    const std::uint32_t step = static_cast<std::uint32_t>(16000 / settings_.samples_per_second);
    const std::uint32_t number = sound.frame_number * kSamplesPerFrame;
    const bool is_same = sound.connection_number == std::exchange(connection_, sound.connection_number);
    if (samples_ > 0 && is_same && number != next_ + sound.missing * step) {
      violations_.insert("sound that is not in time, once its gap is filled");
    }
    if (settings_.channels == 2 && settings_.samples_per_second == 16000) {
      checkSamples(sound, number);
    }
    next_ = number + static_cast<std::uint32_t>(count) * step;
    samples_ += count;
    // A frame of the protocol has 8 bytes in front of the payload, which has 8 in front of the samples.
    bytes_ += 16 + 2 * sound.samples.size();
  }

  template <typename Use>
  auto read(const Use& use) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return use(*this);
  }

  std::vector<double> delays_;  ///< ms, from the first sample of a message to its delivery
  std::uint64_t samples_ = 0, missing_ = 0, gaps_ = 0, bytes_ = 0;
  std::set<std::string> violations_;

 private:
  void checkSamples(const HeardSound& sound, std::uint32_t number) {
    for (std::size_t i = 0; i + 1 < sound.samples.size(); i += 2, ++number) {
      if (sound.samples[i] != static_cast<std::int16_t>(number & 0xffff) ||
          sound.samples[i + 1] != static_cast<std::int16_t>(number >> 16)) {
        violations_.insert("a sample that was not heard then");
        return;
      }
    }
  }

  const CodedRobot& robot_;
  const aibo_client::MicrophoneSettings settings_;
  mutable std::mutex mutex_;  // guards what is above
  std::uint32_t next_ = 0;
  std::uint64_t connection_ = 0;
};

struct Result {
  std::vector<double> delays;
  double missing_percent = 0;
  std::uint64_t gaps = 0;
  double kilobits = 0;
  double pictures = 0;
  CodedRobot::Played played;
  std::vector<double> stops;  ///< ms, from hold() to the robot's answer
  std::uint64_t connections = 0;
  std::set<std::string> failed_stops;  ///< why
  std::set<std::string> violations;
};

double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  const auto index = static_cast<std::size_t>(part * static_cast<double>(values.size()));
  return values.empty() ? 0 : values[std::min(index, values.size() - 1)];
}

/// Tells the robot to hold, again and again.
void stopOften(aibo_client::RcServerClient& client, steady_clock::time_point end, Result* result) {
  for (auto next = steady_clock::now() + kBetweenStops; next < end; next += kBetweenStops) {
    std::this_thread::sleep_until(next);
    const auto asked = steady_clock::now();
    try {
      client.hold({}, kAnswerTimeout);
      result->stops.push_back(Milliseconds(steady_clock::now() - asked).count());
    } catch (const aibo_client::Exception& problem) {
      result->failed_stops.insert(problem.what());
    }
  }
}

void judge(const Trial& trial, Result* result) {
  if (trial.microphone.on && result->delays.empty()) {
    result->violations.insert("no sound at all");
  }
  if (trial.most_delay.count() > 0 && quantile(result->delays, 0.5) > static_cast<double>(trial.most_delay.count())) {
    result->violations.insert("sound is late");
  }
  if (result->connections == 1 && !result->failed_stops.empty()) {
    result->violations.insert("an order to stop failed: " + *result->failed_stops.begin());
  }
  if (!trial.may_miss && result->connections != 1) {
    result->violations.insert("the connection was lost");
  }
  if (!trial.may_miss && (result->missing_percent > 0 || result->played.silent > 0)) {
    result->violations.insert("sound is missing");
  }
  if (result->played.wrong > 0) {
    result->violations.insert("the robot plays wrong samples");
  }
}

Result runOn(const NetworkHost& robot_host, const NetworkHost& computer, const CodedRobot& robot, const Trial& trial) {
  computer.enter();
  const RadioLink link(robot_host, computer, trial.radio);
  Result result;
  Listener listener(robot, trial.microphone);
  std::atomic<std::uint64_t> pictures{0};
  std::unique_ptr<aibo_driver::sound::Player> player;
  std::atomic<bool> connected{false};
  aibo_client::ClientOptions options;
  options.host = kRobotAddress;
  aibo_client::Callbacks callbacks;
  callbacks.on_picture = [&](const aibo_client::PicturePtr&) { ++pictures; };
  callbacks.on_heard = [&](const HeardSound& sound) { listener.hear(sound); };
  callbacks.on_sound_ended = [&](const aibo_client::SoundEnd& end) { player->ended(end); };
  std::mutex refusals_mutex;
  std::set<std::string> refusals;
  callbacks.on_refused = [&](const aibo_client::Refusal& refusal) {
    const std::lock_guard<std::mutex> lock(refusals_mutex);
    refusals.insert("refused: " + refusal.reason);
  };
  callbacks.on_status = [&](const aibo_client::ConnectionStatus& status) {
    connected = status.state == aibo_client::ConnectionState::kConnected;
  };
  aibo_client::RcServerClient client(options, callbacks);
  player = std::make_unique<aibo_driver::sound::Player>(client);
  client.setMicrophone(trial.microphone);
  client.setStreaming(trial.pictures);
  client.start();
  while (!connected) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  if (trial.speaker) {
    player->play(std::make_unique<CodedSource>());
  }
  const auto begin = steady_clock::now();
  stopOften(client, begin + trial.length, &result);
  const double seconds = std::chrono::duration<double>(steady_clock::now() - begin).count();
  result.played = robot.played();
  player->finish();
  client.stop();
  listener.read([&](const Listener& heard) {
    result.delays = heard.delays_;
    result.gaps = heard.gaps_;
    result.missing_percent = heard.samples_ == 0 ? 100
                                                 : 100 * static_cast<double>(heard.missing_) /
                                                       static_cast<double>(heard.samples_ + heard.missing_);
    result.kilobits = 8e-3 * static_cast<double>(heard.bytes_) / seconds;
    result.violations.insert(heard.violations_.begin(), heard.violations_.end());
    return 0;
  });
  result.violations.insert(refusals.begin(), refusals.end());
  result.pictures = static_cast<double>(pictures) / seconds;
  result.connections = client.statistics().connections;
  judge(trial, &result);
  return result;
}

Result run(const Trial& trial) {
  const NetworkHost robot_host(kRobotAddress);
  const NetworkHost computer(kComputerAddress);
  const test_support::MemoryStick stick("ALLOW_MICROPHONE=yes\n");
  const std::string stick_path = stick.path().string();
  HostSettings host;
  host.memory_stick = stick_path.c_str();
  setHostSettings(host);
  CodedRobot robot;
  openr_host::MachineOptions options = test_support::RobotThread::defaultOptions();
  options.memory_stick = stick_path;
  options.bind_address = kRobotAddress;
  options.ports = {{test_support::RobotThread::kRobotPort, test_support::RobotThread::kRobotPort}};
  const test_support::RobotThread thread(robot, options, [&robot_host] { robot_host.enter(); });
  Result result;
  std::thread([&] { result = runOn(robot_host, computer, robot, trial); }).join();
  return result;
}

Trial trialOf(const std::string& title, double bits_per_second, double loss, std::uint32_t seed, milliseconds length) {
  Trial trial;
  trial.title = title;
  trial.radio.bits_per_second = bits_per_second;
  trial.radio.loss = loss;
  trial.radio.seed = seed;
  trial.length = length;
  trial.may_miss = loss > 0.01 || bits_per_second < 2e6;
  return trial;
}

std::vector<Trial> allTrials(std::uint32_t seed, double minutes, const std::string& only) {
  const milliseconds length(static_cast<int>(minutes * 60000));
  const milliseconds shorter = std::min(length, milliseconds(60000));
  std::vector<Trial> trials;
  for (const double loss : {0.0, 0.01, 0.05}) {
    char title[64];
    std::snprintf(title, sizeof(title), "11 Mbit/s, loss %g %%, both ways", loss * 100);
    trials.push_back(trialOf(title, 11e6, loss, seed, length));
    trials.back().speaker = trials.back().pictures = true;
    trials.back().most_delay = milliseconds(loss == 0 ? 100 : 0);
  }
  for (const auto& [channels, rate] : std::vector<std::pair<int, int>>{{2, 16000}, {1, 16000}, {2, 8000}, {1, 8000}}) {
    char title[64];
    std::snprintf(title, sizeof(title), "11 Mbit/s, only microphone %d x %d", channels, rate);
    trials.push_back(trialOf(title, 11e6, 0, seed, shorter));
    trials.back().microphone = {true, channels, rate, false};
    trials.back().most_delay = milliseconds(100);
  }
  trials.push_back(trialOf("1 Mbit/s, pictures, no sound", 1e6, 0, seed, shorter));
  trials.back().microphone.on = false;
  trials.back().pictures = true;
  for (const auto& [pictures, first] :
       std::vector<std::pair<bool, bool>>{{false, false}, {true, false}, {true, true}}) {
    for (const auto& [channels, speaker] : std::vector<std::pair<int, bool>>{{1, false}, {2, false}, {1, true}}) {
      char title[64];
      std::snprintf(title, sizeof(title), "1 Mbit/s, microphone %d%s%s%s", channels, speaker ? ", speaker" : "",
                    pictures ? ", pictures" : "", first ? ", sound first" : "");
      trials.push_back(trialOf(title, 1e6, 0, seed, shorter));
      trials.back().microphone = {true, channels, 16000, first};
      trials.back().speaker = speaker;
      trials.back().pictures = pictures;
      // A sound for the speaker begins with gaps, because pictures are already on their way.
      trials.back().may_miss = pictures && (speaker || !first);
    }
  }
  trials.erase(std::remove_if(trials.begin(), trials.end(),
                              [&](const Trial& trial) { return trial.title.find(only) == std::string::npos; }),
               trials.end());
  return trials;
}

bool print(const Trial& trial, const Result& result) {
  std::printf("%-44s %6.1f %6.1f %7.1f %6.0f %5llu %7.3f %6.1f %8.3f %6.1f %7.1f %5llu\n", trial.title.c_str(),
              quantile(result.delays, 0.5), quantile(result.delays, 0.99), quantile(result.delays, 1), result.kilobits,
              static_cast<unsigned long long>(result.gaps), result.missing_percent, result.pictures,
              result.played.samples == 0
                  ? 0.0
                  : 100 * static_cast<double>(result.played.silent) / static_cast<double>(result.played.samples),
              quantile(result.stops, 0.5), quantile(result.stops, 1),
              static_cast<unsigned long long>(result.connections));
  for (const std::string& violation : result.violations) {
    std::printf("  VIOLATION: %s\n", violation.c_str());
  }
  std::fflush(stdout);
  return result.violations.empty();
}

int runAll(const std::vector<Trial>& trials) {
  std::printf("%-44s %6s %6s %7s %6s %5s %7s %6s %8s %6s %7s %5s\n", "", "p50 ms", "p99 ms", "max ms", "kbit/s", "gaps",
              "miss %", "fps", "silent %", "stop", "max ms", "conns");
  bool all_well = true;
  for (const Trial& trial : trials) {
    all_well = print(trial, run(trial)) && all_well;
  }
  return all_well ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace fault_bench

int main(int argc, char** argv) {
  namespace po = boost::program_options;
  std::uint32_t seed = 1;
  double minutes = 10;
  std::string only;
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("seed", po::value(&seed)->default_value(1), "seed of loss and jitter")
    ("minutes", po::value(&minutes)->default_value(10), "length of the trials both ways; the others take one at most")
    ("only", po::value(&only)->default_value(""), "only the trials with this text in their titles");
  // clang-format on
  return test_support::runProgram(
      argc, argv,
      "Sound between driver and robot over an emulated 802.11b link: its delay (from the first sample of a message to\n"
      "its delivery), what is missing, and how soon an order to stop is answered meanwhile. Needs root.",
      description, [&] { return fault_bench::runAll(fault_bench::allTrials(seed, minutes, only)); });
}
