// The client's side of a connection: a server that says anything, in any pieces, while users ask for everything.
//
// The first byte says how the connection begins. Then come events, a byte each (Event) and what belongs to them.
#include <deque>
#include <future>
#include <memory>
#include <vector>

#include "aibo_client/jpeg_inspector.h"
#include "client/calls.h"
#include "client/fault.h"
#include "client/version1_requests.h"
#include "client/version1_session.h"
#include "client/version2_session.h"
#include "fuzz_input.h"
#include "protocol/motion_requests.h"
#include "protocol/stick_pictures.h"

using namespace aibo_client;
using std::chrono::milliseconds;

namespace {

enum Event {
  BYTES_ARRIVE = 0,
  MANY_BYTES_ARRIVE = 3,
  TIME_PASSES,
  PICTURE_IS_WANTED,
  ROBOT_IS_ASKED,
  BODY_IS_COMMANDED,
  SETTINGS_CHANGE,
  COUNT
};

// More requests than there can be for what is waiting.
constexpr int kManyRequests = 10000;

class Client {
 public:
  explicit Client(FuzzInput& input) : input_(input) {}

  // A fault ends the connection, but every caller gets an answer.
  void run() {
    try {
      begin();
      while (!input_.empty()) {
        play();
      }
    } catch (const ProtocolException& error) {
      require(!std::string(error.what()).empty(), "a protocol error says why");
    } catch (const Fault& fault) {
      require(!std::string(fault.what()).empty() && !fault.advice().empty(), "a fault says why, and what to do");
    }
    connection_.calls.failAll("the connection ended", FaultKind::kClosed);
    for (const auto& answer : answers_) {
      require(answer.wait_for(milliseconds(0)) == std::future_status::ready, "every caller gets an answer");
    }
  }

 private:
  void begin() {
    switch (input_.takeByte() % 3) {
      case 0:
        beginVersion1(VersionAnswer::kNotAsked);
        break;
      case 1:
        session_ = std::make_unique<Version2Session>(connection_, now_);
        break;
      default:
        negotiate();
    }
  }

  void beginVersion1(VersionAnswer answer) { session_ = std::make_unique<Version1Session>(connection_, answer, now_); }

  void negotiate() {
    Bytes bytes = input_.takeBytes(input_.takeByte());
    now_ += kVersionPatience;
    const VersionAnswer answer = takeVersionAnswer(&bytes);
    if (answer == VersionAnswer::kVersion2) {
      session_ = std::make_unique<Version2Session>(connection_, now_);
    } else {
      beginVersion1(answer);
    }
    connection_.pictures.bytesArrived(now_);
    session_->bytesArrived(bytes.data(), bytes.size(), now_);
  }

  void play() {
    switch (const unsigned event = input_.takeByte() % COUNT) {
      case TIME_PASSES:
        passTime(milliseconds(4 * input_.takeByte()));
        break;
      case PICTURE_IS_WANTED:
        wantPicture();
        break;
      case ROBOT_IS_ASKED:
        add(takeCall());
        break;
      case BODY_IS_COMMANDED:
        commandBody();
        break;
      case SETTINGS_CHANGE:
        changeSettings();
        break;
      default:
        bytesArrive(input_.takeBytes(event == MANY_BYTES_ARRIVE ? input_.take16() : input_.takeByte()));
    }
  }

  void bytesArrive(const Bytes& bytes) {
    talk();
    connection_.pictures.bytesArrived(now_);
    session_->bytesArrived(bytes.data(), bytes.size(), now_);
    look();
  }

  // As in the client's loop: look at the socket when the session wants to, at the latest.
  void passTime(milliseconds time) {
    const auto end = now_ + time;
    while (now_ < end) {
      talk();
      look();  // a caller may have allowed no time at all
      talk();
      require(session_->nextDeadline() > now_, "the loop does not spin");
      now_ = std::min(end, session_->nextDeadline());
      look();
    }
  }

  void look() {
    connection_.pictures.foundEmpty(now_);
    session_->checkDeadlines(now_);
  }

  void talk() {
    for (int i = 0; !session_->nextRequest(wanted_, now_).empty(); ++i) {
      require(i < kManyRequests, "requests come to an end");
    }
  }

  void wantPicture() { add(callForPicture(static_cast<int>(input_.takeByte() % 101))); }

  Call takeCall() {
    const unsigned kind = input_.takeByte() % 13;
    const bool is_first = input_.takeByte() % 2 == 0;
    const Bytes content(1 + input_.takeByte());
    switch (kind) {
      case 0:
        return callForMotors(!is_first);
      case 1:
        return callToDelete("NOD.MTN");
      case 2:
        return is_first ? callToStop("NOD.MTN") : callToPlay("NOD.MTN");
      case 3:
        return callToStore("NOD.MTN", content);
      case 4:
        return makeCall(protocol::version2::LIST_MOTIONS);
      case 5:
        return makeCall(protocol::version2::SHUT_DOWN);
      case 6:
        return makeCall(protocol::version2::REBOOT);
      case 7:
        return callToHold(is_first ? std::vector<int>() : std::vector<int>{2, 52});
      case 8:
        return callForPosture(is_first ? Posture::kStand : Posture::kSit);
      case 9:
        return callToSavePicture(85);
      case 11:
        return callToPlaySamples({++sounds_, 0, 2, is_first}, {0, 0});
      case 12:
        return callToPlaySamples({sounds_, 2, is_first ? 2U : 0U, true}, std::vector<std::int16_t>(is_first ? 2 : 0));
      default:
        return callToFetchPicture("AIBO0001.JPG");
    }
  }

  void add(Call call) {
    call.timeout = milliseconds(8 * input_.takeByte());
    call.deadline = now_ + call.timeout;
    const std::uint64_t wanted = input_.takeByte() % 2;
    if (call.has(protocol::version2::STARTS_MOVEMENT)) {
      call.terms = terms(wanted != 0);
    }
    if (session_->protocolVersion() == 1 && !isKnownToVersion1(call)) {
      return;
    }
    answers_.push_back(call.has(protocol::version2::FETCHES_FILE)
                           ? expectReply<protocol::version2::FetchedPicture>(&call, [](const auto&) {})
                           : expectReply<AnyReply>(&call, [](const auto&) {}));
    call.answer_with_picture = [answer = call.answer](const PicturePtr&) { answer(nullptr, 0); };
    connection_.add(std::move(call));
  }

  OrderTerms terms(bool is_numbered) {
    if (is_numbered) {
      is_over_.push_back(false);
    }
    return {now_ + kLongestOrderWait, is_numbered ? is_over_.size() : 0};
  }

  void ends(std::uint64_t order) {
    if (order != 0) {
      require(order <= is_over_.size() && !is_over_[order - 1], "an order ends once");
      is_over_[order - 1] = true;
    }
  }

  void commandBody() {
    const unsigned kind = input_.takeByte();
    const int id = 1 + static_cast<int>(input_.takeByte() % 255);
    const double value = (static_cast<int>(input_.takeByte()) - 128) / 20.4;  // radian: to 2 pi
    CommandOutbox& commands = connection_.commands;
    switch (kind % 5) {
      case 0:
        commands.command({milliseconds(8 * kind), {{id, value}}, terms(true)});
        break;
      case 1:
        connection_.limitSpeeds({{id, std::abs(value) + 0.01}});
        break;
      case 2:
        commands.leds.add({{id, static_cast<int>(kind), LedMode::kB}});
        break;
      case 3:
        commands.steer({{value, -value, value}, terms(true)});
        break;
      default:
        commands.ears.add({{id % 2 == 0 ? EarCommand::kLeft : EarCommand::kRight, value > 0}});
    }
  }

  void changeSettings() {
    const unsigned bits = input_.takeByte();
    wanted_.streaming = (bits & 1U) != 0;
    wanted_.telemetry_period = (bits & 2U) != 0 ? 4 : 0;
    wanted_.jpeg_quality = 1 + static_cast<int>(bits % 100);
    wanted_.format = {static_cast<Resolution>(bits / 4 % 4), 1 + static_cast<int>(bits % 7)};
    wanted_.microphone = {(bits & 16U) != 0, 1 + static_cast<int>(bits & 1U), (bits & 8U) != 0 ? 8000 : 16000};
    wanted_.camera.gain = 1 + static_cast<int>(bits % 3);
    wanted_.camera.auto_exposure = (bits & 16U) != 0;
    wanted_.colors = {(bits & 32U) != 0, 1, (bits & 64U) != 0};
    wanted_.color_tables[bits % wanted_.color_tables.size()] = (bits & 32U) != 0 ? table_ : nullptr;
  }

  Callbacks callbacks() {
    Callbacks callbacks;
    callbacks.on_picture = [](const PicturePtr& picture) {
      require(inspectJpeg(picture->jpeg.data(), picture->jpeg.size()).good(), "a damaged picture is not published");
    };
    callbacks.on_colors = [](const DetectedColors& colors) {
      for (const DetectedRegion& region : colors.regions) {
        require(region.left + region.width <= colors.width && region.top + region.height <= colors.height,
                "an impossible region is not published");
      }
      const auto pixels = static_cast<std::size_t>(colors.width) * static_cast<std::size_t>(colors.height);
      require(colors.mask.empty() || colors.mask.size() == pixels, "a mask is whole");
    };
    callbacks.on_heard = [](const HeardSound& sound) {
      require(sound.samples.size() <= 2 * 16000 && sound.samples.size() % static_cast<std::size_t>(sound.channels) == 0,
              "sound is whole, and no more than a second");
    };
    callbacks.on_ended = [this](const ActivityEnd& end) { ends(end.order); };
    callbacks.on_refused = [this](const Refusal& refusal) { ends(refusal.order); };
    callbacks.on_steered = [this](const WalkVelocity&, std::uint64_t order, std::uint64_t walk) {
      if (order != walk) {
        ends(order);
      }
    };
    callbacks.on_sound_ended = [this](const SoundEnd& end) {
      require(end.sound > ended_sound_ && end.sound <= sounds_, "a sound ends once");
      ended_sound_ = end.sound;
    };
    callbacks.log = [](LogLevel, const std::string& line) { require(!line.empty(), "a line says something"); };
    return callbacks;
  }

  FuzzInput& input_;
  std::uint64_t sounds_ = 1;  ///< the newest one
  std::uint64_t ended_sound_ = 0;
  std::vector<bool> is_over_;  ///< the index of an order is its number - 1
  Notifier notifier_{callbacks()};
  ClientStatistics counters_;
  Settings wanted_{false, 85, 0};
  ColorTablePtr table_ = std::make_shared<ColorTable>();
  Session::TimePoint now_ = Session::TimePoint() + milliseconds(100000);
  Connection connection_{{"robot:54321", milliseconds(500), notifier_, counters_, 1}, now_};
  std::deque<std::future<void>> answers_;
  std::unique_ptr<Session> session_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  Client(input).run();
  return 0;
}
