// Faults on the way from the server to the client.

#include <array>

#include "aibo_client/exceptions.h"
#include "campaign/client_experiment.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/version2_frames.h"

namespace fault_bench {
namespace {

// More bytes than any picture of the server has.
constexpr int kPictureSize = 5200;

/// way: everything comes late, slowly, in pieces of any size, or many pictures at once. Nothing is lost.
class WayExperiment : public ClientExperiment {
 public:
  explicit WayExperiment(unsigned remainder) : ClientExperiment(remainder, kSafetyNet) {}

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    const std::uint32_t before = connection();
    Conditions conditions;
    switch (trial / 2 % 5) {
      case 0:
        conditions.largest_piece = 1;
        break;
      case 1:
        conditions.largest_piece = static_cast<std::size_t>(uniform(random, 2, 3000));
        break;
      case 2:
        conditions.join = milliseconds(uniform(random, 2, 20));
        break;
      case 3:
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
    const bool changes = fault.action == Action::kFlip || fault.action == Action::kOverwrite;
    const int end = is_new ? (changes && streams ? greetingSize() : 150) : (changes ? headerSize() : kPictureSize);
    fault.place = is_new ? Place::kByte : Place::kPicture;
    fault.offset = static_cast<unsigned>(uniform(random, 0, end - 1));
    client_.setStreaming(streams);
    await([&] { return client_.streaming() == streams; }, "the stream was not switched");
    witness_.allowGaps(changes || fault.action == Action::kDrop || fault.action == Action::kInsert || !streams);
    if (is_new) {
      proxy_.endConnections(Action::kReset);
    }
    const std::size_t done = proxy_.faultsDone();
    proxy_.add(fault);
    if (moment_ == Moment::kCall) {
      takePicture();
      client_.setStreaming(true);
    }
    const auto done_at = proxy_.waitForFaults(done + 1, kSafetyNet);
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
    server_.setStopped(welcome == Welcome::kServe);
    proxy_.setWelcome(welcome);
    if (welcome != Welcome::kServe) {
      proxy_.endConnections(is_silent ? Action::kSilence : Action::kReset);
    }
    witness_.waitForDisconnection();
    std::this_thread::sleep_for(milliseconds(uniform(random, 0, 500)));
    server_.setStopped(false);
    proxy_.heal();
    return awaitReconnect(before, steady_clock::now());
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
