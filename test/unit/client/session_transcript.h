/// @file session_transcript.h
#ifndef TEST_UNIT_CLIENT_SESSION_TRANSCRIPT_H
#define TEST_UNIT_CLIENT_SESSION_TRANSCRIPT_H

#include <future>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "session_fixture.h"

namespace session_history {

using namespace aibo_client;
using std::chrono::milliseconds;
using test_pictures::Bytes;

inline const Bytes& jpegOf(unsigned number) {
  static const std::vector<Bytes> kJpegs = [] {
    std::vector<Bytes> jpegs;
    for (unsigned i = 0; i < 4; ++i) {
      test_pictures::PictureKind kind;
      kind.seed = i;
      kind.width = i % 2 == 0 ? 208 : 176;
      kind.height = i % 2 == 0 ? 160 : 144;
      kind.quality = i % 2 == 0 ? 92 : 94;  // it has six parts
      jpegs.push_back(test_pictures::make(kind));
    }
    return jpegs;
  }();
  return kJpegs.at(number % kJpegs.size());
}

/// Everything that a client sends and tells over a session is written down. Times, orders and sounds count from the
/// transcript's beginning, so that a later session can be compared with an earlier one.
class SessionTranscript : public SessionFixture {
 public:
  using SessionFixture::SessionFixture;
  void TestBody() override {}

 protected:
  /// @param sounds how many there have been
  void beginTranscript(std::uint64_t sounds = 0) {
    base_ = now_;
    notifier_.log(LogLevel::kInfo, "");  // the next line does not say how many were left out before
    log_.clear();
    counters_before_ = counters_;
    last_order_ = 0;
    dropped_orders_.clear();
    sounds_before_ = sounds;
    text_.str("");
  }

  /// Makes a call whose end will be told.
  void call(Call call, milliseconds timeout = milliseconds(2000));
  void write(const std::string& line) { text_ << (now_ - base_) / milliseconds(1) << " " << line << "\n"; }
  /// Writes down what the client has told since the last time.
  void tell();
  std::string counters() const;

  std::ostringstream text_;
  std::vector<std::pair<std::string, std::future<Answer>>> calls_;
  ClientStatistics counters_before_;
  TimePoint base_ = now_;
  unsigned base_frame_ = 0U - 2000;  // its numbers begin again during a history

 private:
  void tellPictures();
  void tellOrders();
  void tellSound();
  std::string describe(const Answer& answer) const;

  std::string state_;
  std::set<std::uint64_t> dropped_orders_;
  std::uint64_t sounds_before_ = 0;
};

inline void SessionTranscript::call(Call call, milliseconds timeout) {
  call.order = ++last_order_;
  call.not_after = now_ + kLongestOrderWait;
  std::string name = aibo_client::describe(call);
  auto answer = add(std::move(call), timeout);
  calls_.emplace_back(name, std::move(answer));
  tell();
}

inline void SessionTranscript::tell() {
  tellPictures();
  tellOrders();
  tellSound();
  for (const Bytes& each : std::exchange(replies_, {})) {
    write("replies " + std::string(1, static_cast<char>(each[0])) + " of " + std::to_string(each.size()));
  }
  for (const std::string& line : std::exchange(log_, {})) {
    if (line.find("further ones are only counted") == std::string::npos) {
      write("logs " + line);
    }
  }
  std::string state = connection_.robot_message + "|" +
                      std::to_string(static_cast<int>(connection_.motors_and_posture.motors)) +
                      std::to_string(static_cast<int>(connection_.motors_and_posture.posture)) + "|" +
                      (connection_.transport == PictureTransport::kUdp ? "UDP|" : "TCP|") +
                      connection_.transport_problem + (connection_.pictures.streaming() ? "|streams" : "|");
  if (state != std::exchange(state_, state)) {
    write("is " + state);
  }
}

inline std::string describePicture(const Picture& picture) {
  const auto found = [&picture] {
    for (unsigned i = 0; i < 4; ++i) {
      if (jpegOf(i) == picture.jpeg) {
        return std::to_string(i);
      }
    }
    return std::string("damaged");
  };
  return found() + " " + std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

inline void SessionTranscript::tellPictures() {
  for (const PicturePtr& each : std::exchange(pictures_, {})) {
    write("picture " + describePicture(*each) + " frame " +
          std::to_string(each->frame_number.value_or(base_frame_) - base_frame_) + " began " +
          std::to_string((each->first_byte_time - base_) / milliseconds(1)));
  }
  for (const Telemetry& each : std::exchange(telemetry_, {})) {
    std::ostringstream line;
    line << "telemetry " << each.frame_number.value_or(base_frame_) - base_frame_;
    for (const JointReading& joint : each.joints) {
      line << " joint " << joint.id << "=" << joint.position << "/" << joint.duty.value_or(0);
    }
    for (const SensorReading& sensor : each.sensors) {
      line << " sensor " << sensor.id << "=" << sensor.value;
    }
    write(line.str() + (each.walk ? " walks " + std::to_string(each.walk->velocity.left) : ""));
  }
  for (const DetectedColors& each : std::exchange(colors_, {})) {
    std::string line = "colours " + std::to_string(each.frame_number - base_frame_);
    for (const DetectedRegion& region : each.regions) {
      line += " " + region.name + " " + std::to_string(region.pixels);
    }
    write(line);
  }
}

inline void SessionTranscript::tellOrders() {
  for (const std::string& each : std::exchange(accepted_, {})) {
    write("accepted " + each);
  }
  if (!leds_.empty()) {
    write("LEDs " + std::exchange(leds_, ""));
  }
  for (std::size_t i = 0; i < steered_.size(); ++i) {
    EXPECT_EQ(0U, dropped_orders_.count(steered_orders_[i])) << "it was told that the order is not sent";
    write("steered " + std::to_string(steered_[i].forward) + " by order " + std::to_string(steered_orders_[i]));
  }
  steered_.clear();
  steered_orders_.clear();
  for (const Refusal& each : std::exchange(refusals_, {})) {
    dropped_orders_.insert(each.order);
    std::string line = "refusal " + std::to_string(static_cast<int>(each.request)) + " " +
                       std::to_string(static_cast<int>(each.cause)) + " " + each.reason + " order " +
                       std::to_string(each.order) + " of";
    for (const int id : each.ids) {
      line += " " + std::to_string(id);
    }
    write(line);
  }
  for (const LateAnswer& each : std::exchange(late_answers_, {})) {
    write("late " + std::to_string(each.order) + (each.accepted ? " accepted " : " refused ") + each.reason +
          each.changes);
  }
  for (const MotionEnd& each : std::exchange(ended_, {})) {
    write("end " + std::to_string(static_cast<int>(each.kind)) + std::to_string(static_cast<int>(each.how)) +
          each.name + each.reason);
  }
  for (auto call = calls_.begin(); call != calls_.end();) {
    if (done(call->second)) {
      write("answer to " + call->first + ": " + describe(call->second.get()));
      call = calls_.erase(call);
    } else {
      ++call;
    }
  }
}

inline std::string SessionTranscript::describe(const Answer& answer) const {
  std::string text = std::to_string(static_cast<int>(answer.outcome)) + (answer.was_sent ? "s " : " ") + answer.problem;
  text += answer.picture ? " picture " + describePicture(*answer.picture) : "";
  text += " " + std::to_string(answer.stream_quality) + (answer.motors_on ? " on" : "") + answer.changes;
  for (const std::string& name : answer.names) {
    text += " " + name;
  }
  const std::uint64_t sound = answer.sound.sound == 0 ? 0 : answer.sound.sound - sounds_before_;
  return text + " " + std::to_string(answer.file.size()) + " " + std::to_string(sound) + " " +
         std::to_string(answer.sound.room) + " " + std::to_string(answer.volume);
}

inline void SessionTranscript::tellSound() {
  for (const HeardSound& each : std::exchange(heard_, {})) {
    write("heard " + std::to_string(each.frame_number - base_frame_) + " " + std::to_string(each.channels) + " at " +
          std::to_string(each.samples_per_second) + " missing " + std::to_string(each.missing) + " " +
          std::to_string(each.samples.back()));
  }
  for (const SoundEnd& each : std::exchange(sound_ends_, {})) {
    write("sound " + std::to_string(each.sound - sounds_before_) + " ended " +
          std::to_string(static_cast<int>(each.how)) + " " + std::to_string(each.samples));
  }
}

inline std::string SessionTranscript::counters() const {
  const std::vector<std::pair<const char*, Counter ClientStatistics::*>> kCounters = {
      {"pictures", &ClientStatistics::pictures},
      {"corrupt", &ClientStatistics::corrupt_pictures},
      {"unexpected", &ClientStatistics::unexpected_pictures},
      {"stale", &ClientStatistics::stale_pictures},
      {"telemetry", &ClientStatistics::telemetry},
      {"thinned telemetry", &ClientStatistics::thinned_telemetry},
      {"sounds", &ClientStatistics::sounds},
      {"gaps", &ClientStatistics::sound_gaps},
      {"impossible", &ClientStatistics::impossible_values},
      {"refusals", &ClientStatistics::refusals},
      {"datagrams", &ClientStatistics::datagrams},
      {"lost datagrams", &ClientStatistics::lost_datagrams},
      {"bad datagrams", &ClientStatistics::bad_datagrams},
      {"repaired", &ClientStatistics::repaired_datagrams},
      {"lost pictures", &ClientStatistics::lost_pictures},
  };
  std::string text;
  for (const auto& [name, counter] : kCounters) {
    text += std::string(name) + " " + std::to_string(counters_.*counter - counters_before_.*counter) + "\n";
  }
  return text;
}

/// The first lines that differ, and what comes before them.
inline std::string difference(const std::string& expected, const std::string& actual) {
  std::istringstream all_expected(expected);
  std::istringstream all_actual(actual);
  std::string before;
  for (std::string wanted, found; std::getline(all_expected, wanted);) {
    if (!std::getline(all_actual, found) || wanted != found) {
      return "after\n" + before.substr(before.size() < 600 ? 0 : before.size() - 600) + "not " + wanted + "\nbut " +
             found;
    }
    before += wanted + "\n";
  }
  return expected == actual ? "" : "there is more at the end";
}

}  // namespace session_history

#endif  // TEST_UNIT_CLIENT_SESSION_TRANSCRIPT_H
