// F9 to F11, F13b, F20: faults on the way to the robot's server, and clients that misbehave.

#include <atomic>
#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <thread>

#include "aibo_client/rcserver_client.h"
#include "campaign/experiment.h"
#include "campaign/interposers.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "robot_server.h"
#include "support/raw_client.h"

using aibo_client::PicturePtr;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace version2 = protocol::version2;

namespace fault_bench {
namespace {

// Pictures that waited during a pause of 5 s are older than this. Those that a busy computer delays are not.
constexpr milliseconds kStale{3000};
const std::string kStream = "W\x55";
const std::string kPicture = "F\x55";
const std::string kVersion2 = {'X', 2};
const std::string kVersion2Stream = {'W', 85, 0, 1, 0, 0, 0, 4, 1, 0, 0, 1};
const std::string kVersion2Hello = {'H', 0, 0, 2, 0, 0, 0, 0};

void awaitCount(const std::atomic<int>& pictures, int count) {
  const TimePoint end = steady_clock::now() + kPatience;
  while (pictures < count) {
    if (steady_clock::now() > end) {
      throw std::runtime_error("no picture came any more");
    }
    std::this_thread::sleep_for(milliseconds(2));
  }
}

/// The robot's server, and clients that behave well or not.
class ServerExperiment : public Experiment {
 public:
  explicit ServerExperiment(unsigned remainder)
      : mark_(static_cast<int>(remainder) + 1), server_([this] { interposers::markThisThread(mark_); }) {}

  Outcome run(unsigned trial, Random& random) final {
    try {
      return attempt(trial, random);
    } catch (const std::exception& error) {
      return {{}, {error.what()}};
    }
  }

 protected:
  virtual Outcome attempt(unsigned trial, Random& random) = 0;

  /// Has a new client ask for one picture.
  /// @return false if it is turned away
  bool serves() {
    RawClient client(server_.port());
    client.send(kPicture);
    const Bytes header = client.read(protocol::PICTURE_HEADER_SIZE, milliseconds(2000));
    std::size_t size = 0;
    if (header.size() < protocol::PICTURE_HEADER_SIZE || !protocol::decodePictureHeader(header.data(), &size)) {
      return false;
    }
    const Bytes jpeg = client.read(size, milliseconds(2000));
    return jpeg.size() == size && jpeg[size - 1] == 0xD9;
  }

  /// Waits until a new client is served.
  /// @param since from when the server should accept a client
  Outcome awaitService(TimePoint since) {
    while (!serves()) {
      if (steady_clock::now() - since > kPatience) {
        throw std::runtime_error("the server does not serve anybody any more");
      }
      std::this_thread::sleep_for(milliseconds(10));
    }
    return {steady_clock::now() - since, {}};
  }

  const int mark_;
  RobotServer server_;
};

/// F9: a client asks for pictures and then does not read them. Soon the server serves the next client, and the camera
/// goes on meanwhile.
class HangingClientExperiment : public ServerExperiment {
 public:
  enum class Manner { kNeverReads, kDrips, kVanishes };

  HangingClientExperiment(unsigned remainder, Manner manner) : ServerExperiment(remainder), manner_(manner) {}

 private:
  Outcome attempt(unsigned trial, Random&) override {
    FaultProxy proxy(proxyTo(server_.port(), trial));
    RawClient client(manner_ == Manner::kVanishes ? proxy.port() : server_.port());
    client.send(trial % 2 == 0 ? kStream : kVersion2 + kVersion2Stream);
    client.read(4000, kPatience);
    if (manner_ == Manner::kVanishes) {
      proxy.endConnections(Action::kSilence);
    }
    const TimePoint stopped = steady_clock::now();
    server_.takeLongestImageGap();
    TimePoint next_byte = stopped;
    while (!serves()) {
      if (steady_clock::now() - stopped > kPatience) {
        throw std::runtime_error("the server keeps serving a client that does not read");
      }
      if (manner_ == Manner::kDrips && steady_clock::now() > next_byte) {
        client.receive(milliseconds(0), 1);
        next_byte += std::chrono::seconds(1);
      }
      std::this_thread::sleep_for(milliseconds(20));
    }
    Outcome outcome = {steady_clock::now() - stopped, {}};
    const milliseconds gap = server_.takeLongestImageGap();
    if (gap > kBlocked) {
      outcome.violations.push_back("M: no camera image for " + std::to_string(gap.count()) + " ms");
    }
    return outcome;
  }

  // Longer than a busy computer holds up a thread, and shorter than a blocking send would hold up the server.
  static constexpr milliseconds kBlocked{1000};

  const Manner manner_;
};

/// F10: a client does not read for five seconds. Then it gets new pictures, except for a few.
class PauseExperiment : public ServerExperiment {
 public:
  using ServerExperiment::ServerExperiment;

 private:
  Outcome attempt(unsigned, Random& random) override {
    RawClient client(server_.port());
    client.send(kVersion2 + kVersion2Stream);
    client.read(protocol::VALUE_REPLY_SIZE, kPatience);
    for (int pictures = 0; pictures < 3;) {
      pictures += readFrame(&client).kind == version2::PICTURE ? 1 : 0;
    }
    std::this_thread::sleep_for(milliseconds(uniform(random, 4900, 5100)));
    int stale = 0;
    for (const TimePoint end = steady_clock::now() + milliseconds(300); steady_clock::now() < end;) {
      stale += readFrame(&client).age > kStale ? 1 : 0;
    }
    client.close();
    Outcome outcome = awaitService(steady_clock::now());
    if (stale > 7) {
      outcome.violations.push_back(std::to_string(stale) + " stale pictures were sent");
    }
    return outcome;
  }

  struct Received {
    char kind = '\0';
    milliseconds age{0};
  };

  Received readFrame(RawClient* client) {
    const Bytes bytes = client->read(version2::FRAME_HEADER_SIZE, milliseconds(100));
    if (bytes.size() < version2::FRAME_HEADER_SIZE) {
      return {};
    }
    const version2::FrameHeader header = version2::decodeFrameHeader(bytes.data());
    const Bytes payload = client->read(header.payload_size, milliseconds(1000));
    version2::PicturePayload picture = {};
    if (header.kind != version2::PICTURE || version2::decode(payload.data(), payload.size(), &picture)) {
      return {header.kind, milliseconds(0)};
    }
    return {header.kind, 8 * milliseconds(server_.frame() - picture.header.frame_number)};
  }
};

/// F10b: the same with the driver's client, whose thread is held up for five seconds.
class HeldUpExperiment : public ServerExperiment {
 public:
  using ServerExperiment::ServerExperiment;

 private:
  Outcome attempt(unsigned, Random& random) override {
    std::atomic<int> pictures{0};
    std::atomic<int> stale{0};
    std::atomic<int> pause{0};
    aibo_client::ClientOptions options;
    options.port = server_.port();
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [&](const PicturePtr& picture) {
      ++pictures;
      stale += 8 * milliseconds(server_.frame() - *picture->frame_number) > kStale ? 1 : 0;
      std::this_thread::sleep_for(milliseconds(pause.exchange(0)));
    };
    aibo_client::RcServerClient client(options, callbacks);
    client.setStreaming(true);
    client.start();
    awaitCount(pictures, 3);
    stale = 0;
    pause = uniform(random, 4900, 5100);
    awaitCount(pictures, pictures + 1);  // its callback takes five seconds
    awaitCount(pictures, pictures + 5);
    Outcome outcome;
    if (stale > 1) {
      outcome.violations.push_back(std::to_string(stale) + " stale pictures were delivered");
    }
    return outcome;
  }
};

/// F11: other clients connect while one is served. They are turned away, and the first one keeps its pictures.
class StrangerExperiment : public ServerExperiment {
 public:
  using ServerExperiment::ServerExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    // The server drops a client that reads nothing for 2 s, and the last trial may have been long ago.
    if (!first_ || steady_clock::now() - last_read_ > std::chrono::seconds(1)) {
      connectFirst();
    }
    connectOthers(trial % 3, random);
    if (!readPictures()) {
      first_.reset();
      return {{}, {"the first client gets no more pictures"}};
    }
    return {};
  }

  bool readPictures() {
    const bool read = first_->read(20000, kPatience).size() == 20000;
    last_read_ = steady_clock::now();
    return read;
  }

  void connectFirst() {
    first_.reset();
    awaitService(steady_clock::now());
    first_ = std::make_unique<RawClient>(server_.port());
    first_->send(kVersion2 + kVersion2Stream);
    readPictures();
  }

  void connectOthers(unsigned kind, Random& random) {
    for (int count = uniform(random, 1, 5); count > 0; --count) {
      first_->send(kVersion2Hello);  // a client that is silent for 0.6 s may lose its place to another one
      RawClient stranger(server_.port());
      if (kind == 0) {
        stranger.reset();
      } else if (kind == 1) {
        stranger.send(kStream);
        const auto answer = stranger.receive(kPatience);
        if (!answer || !answer->empty()) {
          throw std::runtime_error("a second client was not turned away at once");
        }
      }
      readPictures();
    }
  }

  std::unique_ptr<RawClient> first_;
  TimePoint last_read_;
};

/// F11b: a client sends arbitrary bytes in arbitrary pieces, and leaves. The next one is served at once.
class NonsenseExperiment : public ServerExperiment {
 public:
  using ServerExperiment::ServerExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    RawClient client(server_.port());
    std::string bytes = trial % 2 == 0 ? "" : kVersion2;
    for (int size = uniform(random, 1, trial % 8 < 6 ? 60 : 60000); size > 0; --size) {
      bytes += nextByte(trial, random);
    }
    for (std::size_t begin = 0; begin < bytes.size();) {
      const auto part = static_cast<std::size_t>(uniform(random, 1, trial % 3 == 0 ? 7 : 5000));
      if (!client.send(bytes.substr(begin, part))) {
        break;
      }
      begin += part;
      client.receive(milliseconds(0));
    }
    if (trial % 5 == 0) {
      client.reset();
    } else {
      client.close();
    }
    return awaitService(steady_clock::now());
  }

  // Arbitrary bytes, or bytes that look more like requests.
  static char nextByte(unsigned trial, Random& random) {
    static const std::string kLetters = "FWJSVAXHTOLKUDPNQRCY";
    const bool letter = trial % 4 < 2 && uniform(random, 0, 3) == 0;
    return letter ? kLetters[static_cast<std::size_t>(uniform(random, 0, static_cast<int>(kLetters.size()) - 1))]
                  : static_cast<char>(uniform(random, trial % 4 == 0 ? 0 : -128, trial % 4 == 0 ? 4 : 127));
  }
};

/// F11c: clients connect and leave, again and again.
class StormExperiment : public ServerExperiment {
 public:
  using ServerExperiment::ServerExperiment;

 private:
  Outcome attempt(unsigned, Random& random) override {
    for (int i = 0; i < 10; ++i) {
      RawClient client(server_.port());
      if (uniform(random, 0, 1) == 0) {
        client.send(uniform(random, 0, 1) == 0 ? kStream : std::string("J"));
      }
      if (uniform(random, 0, 1) == 0) {
        client.reset();
      }
    }
    return awaitService(steady_clock::now());
  }
};

/// F20: a fault of any kind in the requests of the driver's client, at the beginning of a connection or soon after.
class RequestExperiment : public ServerExperiment {
 public:
  explicit RequestExperiment(unsigned remainder)
      : ServerExperiment(remainder),
        proxy_(proxyTo(server_.port(), remainder)),
        client_(clientOptions(proxy_.port(), remainder), callbacks()) {
    client_.setStreaming(true);
    client_.setTelemetryPeriod(4);
    client_.start();
    awaitCount(pictures_, 3);
  }

 private:
  // More than can be under way.
  static constexpr int kManyPictures = 10;

  Outcome attempt(unsigned trial, Random& random) override {
    Fault fault = anyFault(trial / 2, random);
    fault.direction = Direction::kToServer;
    fault.place = Place::kByte;
    fault.offset = static_cast<unsigned>(uniform(random, 0, 80));
    const std::size_t done = proxy_.faultsDone();
    proxy_.endConnections(Action::kReset);
    proxy_.add(fault);
    const auto report = proxy_.waitForFaults(done + 1, kPatience);
    if (!report) {
      return {{}, {"the fault could not be made, because the client sent nothing"}};
    }
    awaitCount(pictures_, pictures_ + kManyPictures);
    const Milliseconds recovery = steady_clock::now() - report->time;
    proxy_.heal();  // a connection that fell silent might last for ever
    // A server that does not see the end of its connection serves nobody else until it notices by itself (F9c).
    return {fault.action == Action::kSilence ? std::nullopt : std::optional<Milliseconds>(recovery), {}};
  }

  static aibo_client::ClientOptions clientOptions(int port, unsigned remainder) {
    aibo_client::ClientOptions options;
    options.port = port;
    options.protocol_version = remainder % 2 == 0 ? 1 : 0;
    return options;
  }

  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_picture = [this](const PicturePtr&) { ++pictures_; };
    return callbacks;
  }

  std::atomic<int> pictures_{0};
  FaultProxy proxy_;
  aibo_client::RcServerClient client_;
};

/// F13b: a system call of the server fails.
class ServerSyscallExperiment : public ServerExperiment {
 public:
  using ServerExperiment::ServerExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    using interposers::Call;
    struct Failure {
      Call call;
      int error;
    };
    static const std::vector<Failure> kFailures = {
        {Call::kAccept, EMFILE}, {Call::kAccept, ENFILE},     {Call::kAccept, ENOMEM}, {Call::kAccept, ECONNABORTED},
        {Call::kAccept, EINTR},  {Call::kRecv, EINTR},        {Call::kRecv, EAGAIN},   {Call::kRecv, ECONNRESET},
        {Call::kRecv, ENOMEM},   {Call::kSend, EINTR},        {Call::kSend, EAGAIN},   {Call::kSend, 0},
        {Call::kSend, EPIPE},    {Call::kSetsockopt, ENOMEM}, {Call::kPpoll, EINTR},   {Call::kPpoll, ENOMEM}};
    const Failure& failure = kFailures[trial % kFailures.size()];
    const auto skip = static_cast<unsigned>(failure.call == Call::kSetsockopt ? uniform(random, 0, 6) : 0);
    const SpinCheck spin_check(mark_);
    // A shortage of memory lasts for a while.
    const bool lasts = failure.call == Call::kAccept && failure.error == ENOMEM;
    interposers::setPlan(mark_, {failure.call, failure.error, skip, lasts ? std::numeric_limits<unsigned>::max() : 3});
    for (int i = 0; i < (lasts ? 2 : 10); ++i) {
      RawClient client(server_.port());
      client.send(kPicture);
      client.read(protocol::PICTURE_HEADER_SIZE, milliseconds(200));
    }
    const bool happened = interposers::failed(mark_) > 0;
    interposers::setPlan(mark_, {});
    Outcome outcome = awaitService(steady_clock::now());
    if (!happened) {
      outcome.violations.push_back(std::string(interposers::kNames[static_cast<std::size_t>(failure.call)]) +
                                   "() was never called");
    }
    spin_check.conclude(&outcome);
    return outcome;
  }
};

}  // namespace

std::vector<Row> serverRows() {
  using Manner = HangingClientExperiment::Manner;
  // 2 s from when the kernel's buffers are full, some 0.4 s after the client has stopped reading.
  constexpr Milliseconds kFreeAgain{3000};
  // The proxy's buffers have to fill, too.
  constexpr Milliseconds kFreeBehindProxy{3500};
  return {
      {"F9", "server: a client never reads", 300, 8, kFreeAgain, maker<HangingClientExperiment>(Manner::kNeverReads)},
      {"F9b", "server: a client reads a byte a second", 200, 8, kFreeAgain,
       maker<HangingClientExperiment>(Manner::kDrips)},
      {"F9c", "server: a client vanishes", 100, 8, kFreeBehindProxy, maker<HangingClientExperiment>(Manner::kVanishes)},
      {"F10", "server: a client pauses for 5 s", 100, 10, {}, maker<PauseExperiment>()},
      {"F10b", "driver's client is held up for 5 s", 100, 10, {}, maker<HeldUpExperiment>()},
      {"F11", "server: other clients beside one that is served", 1000, 4, {}, maker<StrangerExperiment>()},
      {"F11b", "server: nonsense, floods and half commands", 2000, 8, {}, maker<NonsenseExperiment>()},
      {"F11c", "server: 10 connections that end at once, each", 1000, 4, {}, maker<StormExperiment>()},
      {"F20", "server: any fault on the way to it", 400, 8, Milliseconds(2000), maker<RequestExperiment>()},
      {"F13b", "server: its system calls fail", 1600, 8, {}, maker<ServerSyscallExperiment>()},
  };
}

}  // namespace fault_bench
