/// @file session_fixture.h
#ifndef TEST_UNIT_CLIENT_SESSION_FIXTURE_H
#define TEST_UNIT_CLIENT_SESSION_FIXTURE_H

#include <gmock/gmock.h>

#include <chrono>
#include <exception>
#include <future>

#include "aibo_client/exceptions.h"
#include "client/calls.h"
#include "client/connection.h"
#include "client/session.h"
#include "support/refusal.h"
#include "support/test_pictures.h"

/// The robot's frame when it says hello: ten before its numbers begin again.
constexpr unsigned kFrame = 0xFFFFFFF6;

/// How a call has ended.
enum class CallOutcome { kDone, kTimeout, kRefused };
struct Answer {
  CallOutcome outcome = CallOutcome::kDone;
  std::string problem;
  bool was_sent = false;
  aibo_client::PicturePtr picture;
};

constexpr char kSilentStream[] = "robot:54321 sent nothing for 500 ms while a picture was due";

/// The robot's end of a session, in stepped time: no sockets, no waiting.
class SessionFixture : public testing::Test {
 public:
  SessionFixture() : notifier_(record(), [this] { return now_; }) {}

  using TimePoint = aibo_client::Session::TimePoint;
  using Bytes = test_pictures::Bytes;
  using milliseconds = std::chrono::milliseconds;

  virtual aibo_client::Session& session() = 0;

  void receive(const Bytes& bytes) {
    connection_.pictures.bytesArrived(now_);
    session().bytesArrived(bytes.data(), bytes.size(), now_);
    look();
  }

  void receiveDatagram(const Bytes& bytes) {
    connection_.pictures.bytesArrived(now_);
    session().datagramArrived(bytes.data(), bytes.size(), now_);
    look();
  }

  /// Lets time pass, with nothing to read, as the client's loop does: the session acts only when it asked to.
  void pass(TimePoint::duration time) {
    const TimePoint end = now_ + time;
    for (TimePoint next = session().nextDeadline(); now_ < end && next <= end; next = session().nextDeadline()) {
      ASSERT_GT(next, now_) << "the loop would spin";
      now_ = next;
      look();
    }
    now_ = end;
  }

  /// @return why the robot is given up while this is done; empty if it is not
  template <typename Act>
  static std::string whyGivenUp(const Act& act) {
    return test_support::refusalOf<aibo_client::Exception>(act);
  }
  std::string whyGivenUpWithin(TimePoint::duration time) {
    return whyGivenUp([this, time] { pass(time); });
  }

  std::future<Answer> takePicture(int quality, milliseconds timeout = milliseconds(2000),
                                  std::optional<aibo_client::Resolution> resolution = {}) {
    return add(aibo_client::callForPicture(quality, resolution), timeout);
  }

  /// Orders are numbered from kFirstOrder on.
  aibo_client::OrderTerms terms() { return {now_ + aibo_client::kLongestOrderWait, ++last_order_}; }

  void steer(const aibo_client::WalkVelocity& velocity) { connection_.commands.steer({velocity, terms()}); }

  std::future<Answer> add(aibo_client::Call call, milliseconds timeout = milliseconds(2000)) {
    const auto promise = std::make_shared<std::promise<Answer>>();
    call.timeout = timeout;
    call.deadline = now_ + timeout;
    call.answer = [promise](const unsigned char*, std::size_t) { return promise->set_value({}), nullptr; };
    call.answer_with_picture = [promise](const aibo_client::PicturePtr& picture) {
      promise->set_value({CallOutcome::kDone, "", true, picture});
    };
    call.fail = [promise](const std::exception_ptr& failure) {
      try {
        std::rethrow_exception(failure);
      } catch (const aibo_client::TimeoutException& late) {
        promise->set_value({CallOutcome::kTimeout, late.what(), late.wasSent(), nullptr});
      } catch (const aibo_client::CommandException& refusal) {
        promise->set_value({CallOutcome::kRefused, refusal.what(), false, nullptr});
      }
    };
    connection_.add(std::move(call));
    return promise->get_future();
  }

  /// An order, which has the next number.
  std::future<Answer> order(aibo_client::Call call, milliseconds timeout = milliseconds(2000)) {
    call.terms = terms();
    return add(std::move(call), timeout);
  }

  void commandJoints(const std::vector<aibo_client::JointTarget>& targets, milliseconds duration = milliseconds(0)) {
    connection_.commands.command({duration, targets, terms()});
  }

  void limitSpeed(const std::vector<aibo_client::JointSpeedLimit>& limits) { connection_.limitSpeeds(limits); }

  void commandLeds(const std::vector<aibo_client::LedCommand>& leds) { connection_.commands.leds.add(leds); }

  void commandEars(bool left, bool right) {
    connection_.commands.ears.add({{aibo_client::EarCommand::kLeft, left}, {aibo_client::EarCommand::kRight, right}});
  }

  static bool done(const std::future<Answer>& answer) {
    return answer.wait_for(milliseconds(0)) == std::future_status::ready;
  }

  /// Exactly these refusals were told since the last call.
  void expectRefusals(const std::vector<aibo_client::Refusal>& expected) {
    const auto text_of = [](const std::vector<aibo_client::Refusal>& refusals) {
      std::string text;
      for (const aibo_client::Refusal& each : refusals) {
        text += std::to_string(static_cast<int>(each.request)) + std::to_string(static_cast<int>(each.cause)) + " [";
        for (const int id : each.ids) {
          text += std::to_string(id) + " ";
        }
        text += "] " + each.reason + " #" + std::to_string(each.order) + "\n";
      }
      return text;
    };
    EXPECT_EQ(text_of(expected), text_of(std::exchange(refusals_, {})));
  }

  /// Lines logged that contain this text.
  long logged(const std::string& text) const {
    return std::count_if(log_.begin(), log_.end(),
                         [&text](const std::string& line) { return line.find(text) != std::string::npos; });
  }

  /// The context of the client's third connection.
  aibo_client::ConnectionContext context() { return {"robot:54321", milliseconds(500), notifier_, counters_, 3}; }

  std::vector<Bytes> replies_;  ///< datagrams that were sent back
  std::vector<aibo_client::PicturePtr> pictures_;
  std::vector<aibo_client::Telemetry> telemetry_;
  std::vector<std::string> accepted_;  ///< joints: "2=-0.500000 3=0.200000 "
  std::string leds_;                   ///< as accepted: "7=255A "
  std::vector<aibo_client::WalkVelocity> steered_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> steered_orders_;  ///< the order, and that of its walk
  std::vector<aibo_client::ActivityEnd> ended_;
  std::vector<aibo_client::Refusal> refusals_;
  std::vector<aibo_client::DetectedColors> colors_;
  std::vector<aibo_client::HeardSound> heard_;
  std::vector<aibo_client::SoundEnd> sound_ends_;
  std::vector<std::string> log_;  ///< lines; all but warnings begin with their level
  static constexpr std::uint64_t kFirstOrder = 0x4000000011;
  std::uint64_t last_order_ = kFirstOrder - 1;
  aibo_client::Notifier notifier_;
  aibo_client::ClientStatistics counters_;
  aibo_client::Settings wanted_{false, 73, 0};
  TimePoint now_ = TimePoint() + std::chrono::microseconds(100123456);
  aibo_client::Connection connection_{context(), now_};

 private:
  void look() {
    connection_.pictures.foundEmpty(now_);
    session().checkDeadlines(now_);
    if (const Bytes reply = session().takeReply(now_); !reply.empty()) {
      replies_.push_back(reply);
    }
  }

  aibo_client::Callbacks record() {
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [this](const aibo_client::PicturePtr& picture) { pictures_.push_back(picture); };
    callbacks.on_telemetry = [this](const aibo_client::Telemetry& telemetry) { telemetry_.push_back(telemetry); };
    callbacks.on_joints_accepted = [this](const std::vector<aibo_client::JointTarget>& targets) {
      accepted_.emplace_back();
      for (const aibo_client::JointTarget& target : targets) {
        accepted_.back() += std::to_string(target.id) + "=" + std::to_string(target.position) + " ";
      }
    };
    callbacks.on_leds_accepted = [this](const std::vector<aibo_client::LedCommand>& leds) {
      for (const aibo_client::LedCommand& led : leds) {
        leds_ += std::to_string(led.id) + "=" + std::to_string(led.intensity) +
                 (led.mode == aibo_client::LedMode::kB ? "B " : "A ");
      }
    };
    callbacks.on_steered = [this](const aibo_client::WalkVelocity& in_force, std::uint64_t order, std::uint64_t walk) {
      steered_.push_back(in_force);
      steered_orders_.emplace_back(order, walk);
    };
    callbacks.on_colors = [this](const aibo_client::DetectedColors& colors) { colors_.push_back(colors); };
    callbacks.on_heard = [this](const aibo_client::HeardSound& sound) { heard_.push_back(sound); };
    callbacks.on_sound_ended = [this](const aibo_client::SoundEnd& end) { sound_ends_.push_back(end); };
    callbacks.on_refused = [this](const aibo_client::Refusal& refusal) { refusals_.push_back(refusal); };
    callbacks.on_ended = [this](const aibo_client::ActivityEnd& end) { ended_.push_back(end); };
    callbacks.log = [this](aibo_client::LogLevel level, const std::string& line) {
      log_.push_back((level == aibo_client::LogLevel::kWarn   ? ""
                      : level == aibo_client::LogLevel::kInfo ? "info "
                                                              : "error ") +
                     line);
    };
    return callbacks;
  }
};

#endif  // TEST_UNIT_CLIENT_SESSION_FIXTURE_H
