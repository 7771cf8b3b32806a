// Faults on the way to the robot's server, and clients that hang.

#include "campaign/experiment.h"
#include "protocol/version1.h"
#include "robot_server.h"
#include "support/raw_client.h"

namespace fault_bench {
namespace {

const std::string kStream = "W\x55";
const std::string kPicture = "F\x55";
const std::string kVersion2Stream = {'X', 2, 'W', 85, 0, 1, 0, 0, 0, 4, 1, 0, 0, 1};

/// hanging: a client asks for pictures, and then reads nothing, reads very slowly, or vanishes. Soon the server serves
/// the next client.
class HangingClientExperiment : public Experiment {
 public:
  explicit HangingClientExperiment(unsigned /*remainder*/) {}

  Outcome run(unsigned trial, Random& /*random*/) override {
    const auto manner = static_cast<Manner>(trial / 4 % kManners);
    FaultProxy proxy(server_.port());
    RawClient client(manner == kVanishes ? proxy.port() : server_.port());
    client.send(trial / 2 % 2 == 0 ? kStream : kVersion2Stream);
    client.read(4000, kSafetyNet);
    if (manner == kVanishes) {
      proxy.endConnections(Action::kSilence);
    }
    const TimePoint begin = steady_clock::now();
    TimePoint next_byte = begin;
    await(
        [&] {
          if (manner == kDrips && steady_clock::now() > next_byte) {
            client.receive(milliseconds(0), 1);
            next_byte += std::chrono::seconds(1);
          }
          return serves();
        },
        "the server keeps serving a client that does not read");
    return {steady_clock::now() - begin, {}};
  }

 private:
  enum Manner { kNeverReads, kDrips, kVanishes, kManners };

  /// Has a new client ask for one picture.
  /// @return false if it is turned away
  bool serves() {
    RawClient client(server_.port());
    client.send(kPicture);
    const Bytes header = client.read(protocol::PICTURE_HEADER_SIZE, kSafetyNet);
    std::size_t size = 0;
    return header.size() == protocol::PICTURE_HEADER_SIZE && protocol::decodePictureHeader(header.data(), &size) &&
           client.read(size, kSafetyNet).size() == size;
  }

  RobotServer server_;
};

/// request: a fault of any kind in the requests of the driver's client, at the beginning of a connection or soon after.
class RequestExperiment : public Experiment {
 public:
  explicit RequestExperiment(unsigned remainder) : client_(proxy_.port(), remainder % 2 == 0 ? 1 : 0) {
    awaitPictures(3);
  }

  Outcome run(unsigned trial, Random& random) override {
    Fault fault = anyFault(trial / 2, random);
    fault.direction = Direction::kToServer;
    fault.place = Place::kByte;
    fault.offset = static_cast<unsigned>(uniform(random, 0, 39));  // later ones come once a second
    proxy_.endConnections(Action::kReset);
    proxy_.add(fault);
    const auto done_at = proxy_.waitForFaults();
    if (!done_at) {
      return {{}, {"the fault could not be made, because the client sent nothing"}};
    }
    awaitPictures(kManyPictures);
    const Milliseconds recovery = steady_clock::now() - *done_at;
    proxy_.heal();  // a connection that fell silent might last for ever
    return {recovery, {}};
  }

 private:
  // More bytes than can be under way.
  static constexpr unsigned kManyPictures = 10;

  void awaitPictures(unsigned count) {
    await([&, end = client_.pictures() + count] { return client_.pictures() >= end; }, "no picture came any more");
  }

  RobotServer server_;
  FaultProxy proxy_{server_.port()};
  CountingClient client_;
};

}  // namespace

std::vector<Row> serverRows() {
  return {
      {"request", "any fault on the way to the robot's server", 400, 4, maker<RequestExperiment>()},
      {"hanging", "a client never reads, hardly reads, or vanishes", 200, 4, maker<HangingClientExperiment>()},
  };
}

}  // namespace fault_bench
