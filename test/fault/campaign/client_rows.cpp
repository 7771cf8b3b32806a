// Faults on the way from the server to the client.

#include <array>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "aibo_client/exceptions.h"
#include "aibo_client/rcserver_client.h"
#include "campaign/experiment.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/picture_server.h"
#include "support/test_pictures.h"
#include "support/version2_frames.h"

namespace fault_bench {
namespace {

/// Checks what a client delivers against what a PictureServer has sent. The witness must outlive the client, and the
/// server must outlive the witness.
///
/// It complains if a picture is not, byte for byte, one that the server has sent, if a picture comes twice or after a
/// newer one, and if a picture of a connection is missing. When a connection ends, the status must give reason and
/// advice.
class Witness {
 public:
  struct Sighting {
    test_pictures::Name name;
    TimePoint time;  ///< of its delivery
    TimePoint sent;  ///< according to the server
  };

  explicit Witness(const PictureServer& server) : server_(server) {}

  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [this](const aibo_client::PicturePtr& picture) { see(*picture); };
    callbacks.on_status = [this](const aibo_client::ConnectionStatus& status) { hear(status); };
    return callbacks;
  }

  /// While gaps are allowed, it does not complain about pictures that are left out over one connection.
  void allowGaps(bool allowed) {
    const std::lock_guard<std::mutex> lock(mutex_);
    gaps_allowed_ = allowed;
  }

  /// The last picture; its number is 0 if there was none.
  Sighting last() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_;
  }

  /// Waits for a picture that fulfils the condition.
  /// @throw std::runtime_error it did not come
  template <typename Condition>
  Sighting waitFor(const Condition& condition) const {
    Sighting found;
    const auto comes = [&] {
      found = last();
      return found.name.number > 0 && condition(found);
    };
    await(comes, "no picture came any more");
    return found;
  }

  /// The complaints since the last call.
  std::vector<std::string> takeViolations() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(violations_, {});
  }

 private:
  void hear(const aibo_client::ConnectionStatus& status) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const bool has_ended = status.state == aibo_client::ConnectionState::kDisconnected &&
                           status_.state != aibo_client::ConnectionState::kDisconnected;
    if (has_ended && (status.reason.empty() || status.advice.empty())) {
      violations_.push_back("a connection has ended without reason or advice: '" + status.reason + "'");
    }
    status_ = status;
  }

  void see(const aibo_client::Picture& picture) {
    const auto name = test_pictures::nameOf(picture.jpeg);
    const TimePoint sent = name ? server_.timeOf(name->number) : TimePoint();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!name) {
      violations_.emplace_back("a picture that the server never sent");
      return;
    }
    judge(picture, *name);
    last_ = {*name, steady_clock::now(), sent};
  }

  void judge(const aibo_client::Picture& picture, const test_pictures::Name& name) {
    const std::uint64_t before = last_.name.number;
    const std::string which = "picture " + std::to_string(name.number) + " after picture " + std::to_string(before);
    if (picture.jpeg != test_pictures::makeNamed(name) || name.number > server_.lastNumber()) {
      violations_.push_back(which + " is not as it was sent");
    }
    if (name.number <= before) {
      violations_.push_back(which);
    }
    if (name.connection == last_.name.connection && name.number > before + 1 && !gaps_allowed_) {
      violations_.push_back(which + " over one connection: some are lost");
    }
  }

  const PictureServer& server_;
  mutable std::mutex mutex_;  // guards what follows
  Sighting last_;
  bool gaps_allowed_ = false;
  aibo_client::ConnectionStatus status_;
  std::vector<std::string> violations_;
};

/// A client with the driver's own settings, a server, and a proxy between them.
class ClientExperiment : public Experiment {
 public:
  /// @param remainder even: the server speaks version 1 of the protocol; odd: version 2
  /// @param silence after which the client gives a connection up
  explicit ClientExperiment(unsigned remainder, milliseconds silence = aibo_client::ClientOptions().read_timeout)
      : version_(remainder % 2 == 0 ? 1 : 2),
        server_(version_, std::chrono::microseconds(1500)),
        proxy_(server_.port()),
        witness_(server_),
        client_(clientOptions(silence), witness_.callbacks()) {
    client_.setStreaming(true);
    client_.start();
    awaitPictures(3);
  }

  /// Tries the fault, then collects what the witness complains about.
  Outcome run(unsigned trial, Random& random) final {
    const std::uint64_t stale_before = client_.statistics().stale_pictures;
    Outcome outcome;
    try {
      outcome = attempt(trial, random);
      awaitPictures(3);
    } catch (const std::exception& error) {
      outcome.violations.emplace_back(error.what());
    }
    const bool was_held_up = client_.statistics().stale_pictures > stale_before;
    for (const std::string& each : witness_.takeViolations()) {
      if (!was_held_up || each.find("are lost") == std::string::npos) {  // it rightly left stale pictures out
        outcome.violations.push_back(each);
      }
    }
    return outcome;
  }

 protected:
  virtual Outcome attempt(unsigned trial, Random& random) = 0;

  int version() const { return version_; }

  /// The connection over which the last picture came.
  std::uint32_t connection() const { return witness_.last().name.connection; }

  /// Waits for this many more pictures.
  void awaitPictures(unsigned count) {
    const std::uint64_t number = witness_.last().name.number + count;
    witness_.waitFor([number](const Witness::Sighting& each) { return each.name.number >= number; });
  }

 private:
  aibo_client::ClientOptions clientOptions(milliseconds silence) const {
    aibo_client::ClientOptions options;
    options.port = proxy_.port();
    options.read_timeout = silence;
    return options;
  }

  const int version_;

 protected:
  PictureServer server_;
  FaultProxy proxy_;
  Witness witness_;
  aibo_client::RcServerClient client_;
};

// Fewer bytes than any picture of the server has.
constexpr int kPictureSize = 4200;

/// way: everything comes late, slowly, in pieces of any size, or many pictures at once. Nothing is lost.
class WayExperiment : public ClientExperiment {
 public:
  explicit WayExperiment(unsigned remainder) : ClientExperiment(remainder, kSafetyNet) {}

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const std::uint32_t before = connection();
    Conditions conditions;
    switch (trial / 2 % 4) {
      case 0:
        conditions.largest_piece = 1;
        break;
      case 1:
        conditions.largest_piece = static_cast<std::size_t>(uniform(random, 2, 3000));
        break;
      case 2:
        conditions.delay = milliseconds(uniform(random, 1, 60));
        conditions.jitter = milliseconds(uniform(random, 0, 40));
        break;
      default:
        conditions.bytes_per_second = static_cast<std::size_t>(uniform(random, 100000, 1000000));
    }
    proxy_.setConditions(conditions);
    awaitPictures(8);
    proxy_.setConditions(Conditions());
    awaitPictures(1);
    return connection() == before ? Outcome() : Outcome{{}, {"the connection was given up"}};
  }
};

/// When a fault takes place.
enum class Moment {
  kPicture,    ///< within a picture of a stream
  kBeginning,  ///< within the first bytes of a connection: version, hello, replies, first picture
  kStill,      ///< the same on a connection without a stream: replies, values and heartbeats
  kCall        ///< within a picture, while takePicture() waits
};

/// A fault of any kind at any byte. The client comes back, and delivers no picture that was not sent.
class FaultExperiment : public ClientExperiment {
 public:
  FaultExperiment(unsigned remainder, Moment moment) : ClientExperiment(remainder), moment_(moment) {
    client_.setTelemetryPeriod(moment == Moment::kStill ? 4 : 0);  // a version 1 server sends nothing unasked
  }

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const bool streams = moment_ != Moment::kStill && (moment_ != Moment::kCall || trial / 20 % 2 == 0);
    const bool is_new = moment_ == Moment::kBeginning || moment_ == Moment::kStill;
    Fault fault = anyFault(trial / 2, random);
    // No client can notice a changed byte inside a picture.
    const bool changes = fault.action == Action::kFlip;
    const int end = is_new ? (changes && streams ? greetingSize() : 150) : (changes ? headerSize() : kPictureSize);
    fault.place = is_new ? Place::kByte : Place::kPicture;
    fault.offset = static_cast<unsigned>(uniform(random, 0, end - 1));
    client_.setStreaming(streams);
    await([&] { return client_.streaming() == streams; }, "the stream was not switched");
    witness_.allowGaps(changes || fault.action == Action::kDrop || fault.action == Action::kInsert || !streams);
    if (is_new) {
      proxy_.endConnections(Action::kReset);
    }
    proxy_.add(fault);
    if (moment_ == Moment::kCall) {
      takePicture();
      client_.setStreaming(true);
    }
    const auto done_at = proxy_.waitForFaults();
    if (!done_at) {
      return {{}, {"the fault could not be made, because nothing came"}};
    }
    client_.setStreaming(true);
    const auto back = witness_.waitFor([&](const Witness::Sighting& each) { return each.sent > *done_at; });
    proxy_.heal();  // a connection that fell silent would last for ever
    awaitPictures(1);
    witness_.allowGaps(false);
    return {back.time - *done_at, {}};
  }

  int headerSize() const {
    return static_cast<int>(version() == 1 ? protocol::PICTURE_HEADER_SIZE : protocol::version2::FRAME_HEADER_SIZE);
  }

  /// Bytes before the first JPEG.
  int greetingSize() const {
    const int hello = version() == 1 ? 0 : static_cast<int>(version2_frames::makeHello().size());
    return static_cast<int>(protocol::VALUE_REPLY_SIZE) + headerSize() + hello;
  }

  // The witness sees the picture. Every error is good, even a refusal, because the fault may turn a header into one.
  void takePicture() {
    try {
      client_.takePicture(0, std::chrono::seconds(1));
    } catch (const aibo_client::Exception& error) {
      if (std::string(error.what()).empty()) {
        throw std::runtime_error("takePicture() failed without a reason");
      }
    }
  }

  const Moment moment_;
};

/// absence: the server hangs, cannot be reached, or turns the client away, and recovers after some time.
class AbsenceExperiment : public ClientExperiment {
 public:
  using ClientExperiment::ClientExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    constexpr std::array<Welcome, 4> kWelcomes = {Welcome::kServe, Welcome::kSilence, Welcome::kRefuse,
                                                  Welcome::kReset};
    const Welcome welcome = kWelcomes[trial / 2 % kWelcomes.size()];
    const std::uint32_t before = connection();
    const bool is_silent = welcome == Welcome::kServe || welcome == Welcome::kSilence;
    Conditions conditions;
    conditions.paused = welcome == Welcome::kServe;
    proxy_.setConditions(conditions);
    proxy_.setWelcome(welcome);
    if (welcome != Welcome::kServe) {
      proxy_.endConnections(is_silent ? Action::kSilence : Action::kReset);
    }
    await([&] { return client_.status().state == aibo_client::ConnectionState::kDisconnected; },
          "the client did not notice the end of its connection");
    std::this_thread::sleep_for(milliseconds(uniform(random, 0, 500)));
    proxy_.heal();
    const TimePoint healthy = steady_clock::now();
    const auto back = witness_.waitFor([&](const Witness::Sighting& each) { return each.name.connection > before; });
    return {back.time - healthy, {}};
  }
};

}  // namespace

std::vector<Row> clientRows() {
  return {
      {"way", "late, slow, in pieces, joined: nothing is lost", 400, 4, maker<WayExperiment>()},
      {"picture", "any fault at any byte of a picture", 4000, 4, maker<FaultExperiment>(Moment::kPicture)},
      {"beginning", "any fault in the first 150 bytes of a connection", 800, 4,
       maker<FaultExperiment>(Moment::kBeginning)},
      {"still", "the same without a stream", 400, 4, maker<FaultExperiment>(Moment::kStill)},
      {"call", "any fault while takePicture() waits", 800, 4, maker<FaultExperiment>(Moment::kCall)},
      {"absence", "server hangs, is silent, refuses, turns away", 400, 4, maker<AbsenceExperiment>()},
  };
}

}  // namespace fault_bench
