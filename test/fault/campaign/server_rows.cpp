// F9 to F11, F20: what a client, or who is none, can do to the robot's server.

#include <atomic>
#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <thread>

#include "aibo_driver/rcserver_client.h"
#include "campaign/any_fault.h"
#include "campaign/experiment.h"
#include "campaign/robot_server.h"
#include "campaign/spin_check.h"
#include "campaign/syscalls.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/raw_client.h"

using aibo_driver::PicturePtr;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace version2 = protocol::version2;

namespace fault_bench {
namespace {

constexpr milliseconds kPatience{20000};
// What had waited through a pause of 5 s is older than that; what only comes over a busy computer is not.
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

/// The robot's server, and clients of any manners.
class ServerExperiment : public Experiment {
 public:
  explicit ServerExperiment(unsigned remainder) : mark_(static_cast<int>(remainder) + 1), server_(mark_) {}

  Outcome run(unsigned trial, Random& random) final {
    try {
      return attempt(trial, random);
    } catch (const std::exception& error) {
      return {{}, {error.what()}};
    }
  }

 protected:
  virtual Outcome attempt(unsigned trial, Random& random) = 0;

  /// A new client asks for a picture, once.
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
  /// @param since when the place should have become free
  Outcome awaitService(TimePoint since) {
    while (!serves()) {
      if (steady_clock::now() - since > kPatience) {
        throw std::runtime_error("the server serves nobody any more");
      }
      std::this_thread::sleep_for(milliseconds(10));
    }
    return {steady_clock::now() - since, {}};
  }

  const int mark_;
  RobotServer server_;
};

/// F9: a client takes pictures, and then does not read them. The place is free again soon, and the camera goes on.
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
        throw std::runtime_error("the server keeps a client that does not read");
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

  // Longer than a busy computer holds up a thread, shorter than the kernel would hold up a server that waits for it.
  static constexpr milliseconds kBlocked{1000};

  const Manner manner_;
};

/// F10: a client does not read for five seconds. What it gets then is new, but for a few pictures.
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
    version2::ImageHeader image = {};
    std::size_t size = 0;
    if (header.kind != version2::PICTURE || version2::decodePicture(payload.data(), payload.size(), &image, &size)) {
      return {header.kind, milliseconds(0)};
    }
    return {header.kind, 8 * milliseconds(server_.frame() - image.frame_number)};
  }
};

/// F10: the same with the driver's client, whose thread is held up for five seconds.
class HeldUpExperiment : public ServerExperiment {
 public:
  using ServerExperiment::ServerExperiment;

 private:
  Outcome attempt(unsigned, Random& random) override {
    std::atomic<int> pictures{0};
    std::atomic<int> stale{0};
    std::atomic<int> pause{0};
    aibo_driver::ClientOptions options;
    options.port = server_.port();
    aibo_driver::RcServerClient::Callbacks callbacks;
    callbacks.on_picture = [&](const PicturePtr& picture) {
      ++pictures;
      stale += 8 * milliseconds(server_.frame() - *picture->frame_number) > kStale ? 1 : 0;
      std::this_thread::sleep_for(milliseconds(pause.exchange(0)));
    };
    aibo_driver::RcServerClient client(options, callbacks);
    client.setStreaming(true);
    client.start();
    awaitCount(pictures, 3);
    stale = 0;
    pause = uniform(random, 4900, 5100);
    awaitCount(pictures, pictures + 1);  // the one that holds it up
    awaitCount(pictures, pictures + 5);
    Outcome outcome;
    if (stale > 1) {
      outcome.violations.push_back(std::to_string(stale) + " stale pictures were delivered");
    }
    return outcome;
  }
};

/// F11: strangers come while a client is served. They are turned away, and it gets its pictures.
class StrangerExperiment : public ServerExperiment {
 public:
  using ServerExperiment::ServerExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    // Who reads nothing for 2 s loses its place, and it may be long since the trial before.
    if (!first_ || steady_clock::now() - last_read_ > std::chrono::seconds(1)) {
      takeThePlace();
    }
    pestThem(trial % 3, random);
    first_->send(kVersion2Hello);
    if (!readPictures()) {
      first_.reset();
      return {{}, {"the first client has lost its pictures"}};
    }
    return {};
  }

  bool readPictures() {
    const bool read = first_->read(20000, kPatience).size() == 20000;
    last_read_ = steady_clock::now();
    return read;
  }

  void takeThePlace() {
    first_.reset();
    awaitService(steady_clock::now());
    first_ = std::make_unique<RawClient>(server_.port());
    first_->send(kVersion2 + kVersion2Stream);
    readPictures();
  }

  void pestThem(unsigned kind, Random& random) {
    for (int count = uniform(random, 1, 5); count > 0; --count) {
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

/// F11: a client sends anything at all, in any pieces, and leaves. The next one is served at once.
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

  // Bytes of all kinds, or what looks more like requests.
  static char nextByte(unsigned trial, Random& random) {
    static const std::string kLetters = "FWJSVAXHTOLKUDPNQRCY";
    const bool letter = trial % 4 < 2 && uniform(random, 0, 3) == 0;
    return letter ? kLetters[static_cast<std::size_t>(uniform(random, 0, static_cast<int>(kLetters.size()) - 1))]
                  : static_cast<char>(uniform(random, trial % 4 == 0 ? 0 : -128, trial % 4 == 0 ? 4 : 127));
  }
};

/// F11: who connects and goes, again and again.
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

/// F20: anything goes wrong with what the driver's client asks for, on the way to the server, at the beginning of a
/// connection or soon after.
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
  // More than there can be under way.
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
      return {{}, {"the fault could not be made: the client asked for nothing"}};
    }
    awaitCount(pictures_, pictures_ + kManyPictures);
    const Milliseconds recovery = steady_clock::now() - report->time;
    proxy_.heal();  // a connection that fell silent might stand for ever
    // A server that is not told of its client's end serves nobody else until it has found out by itself (F9c).
    return {fault.action == Action::kSilence ? std::nullopt : std::optional<Milliseconds>(recovery), {}};
  }

  static aibo_driver::ClientOptions clientOptions(int port, unsigned remainder) {
    aibo_driver::ClientOptions options;
    options.port = port;
    options.protocol_version = remainder % 2 == 0 ? 1 : 0;
    return options;
  }

  aibo_driver::RcServerClient::Callbacks callbacks() {
    aibo_driver::RcServerClient::Callbacks callbacks;
    callbacks.on_picture = [this](const PicturePtr&) { ++pictures_; };
    return callbacks;
  }

  std::atomic<int> pictures_{0};
  FaultProxy proxy_;
  aibo_driver::RcServerClient client_;
};

/// F13: a system call of the server fails.
class ServerSyscallExperiment : public ServerExperiment {
 public:
  using ServerExperiment::ServerExperiment;

 private:
  Outcome attempt(unsigned trial, Random& random) override {
    using syscalls::Call;
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
    // Memory that is short stays so for a while.
    const bool lasts = failure.call == Call::kAccept && failure.error == ENOMEM;
    syscalls::setPlan(mark_, {failure.call, failure.error, skip, lasts ? std::numeric_limits<unsigned>::max() : 3});
    for (int i = 0; i < (lasts ? 2 : 10); ++i) {
      RawClient client(server_.port());
      client.send(kPicture);
      client.read(protocol::PICTURE_HEADER_SIZE, milliseconds(200));
    }
    const bool happened = syscalls::failed(mark_) > 0;
    syscalls::setPlan(mark_, {});
    Outcome outcome = awaitService(steady_clock::now());
    if (!happened) {
      outcome.violations.push_back(std::string(syscalls::kNames[static_cast<std::size_t>(failure.call)]) +
                                   "() was never called");
    }
    spin_check.conclude(&outcome);
    return outcome;
  }
};

}  // namespace

std::vector<Row> serverRows() {
  using Manner = HangingClientExperiment::Manner;
  // Of these, 2 s begin when the kernel holds no more for the client, some 0.4 s after it has stopped to read.
  constexpr Milliseconds kFreeAgain{3000};
  // What the proxy holds has to be filled, too.
  constexpr Milliseconds kFreeBehindProxy{3500};
  return {
      {"F9", "server: a client never reads", 300, 8, kFreeAgain, maker<HangingClientExperiment>(Manner::kNeverReads)},
      {"F9b", "server: a client reads a byte a second", 200, 8, kFreeAgain,
       maker<HangingClientExperiment>(Manner::kDrips)},
      {"F9c", "server: a client vanishes", 100, 8, kFreeBehindProxy, maker<HangingClientExperiment>(Manner::kVanishes)},
      {"F10", "server: a client pauses for 5 s", 100, 10, {}, maker<PauseExperiment>()},
      {"F10b", "driver's client held up for 5 s", 100, 10, {}, maker<HeldUpExperiment>()},
      {"F11", "server: strangers beside a client", 1000, 4, {}, maker<StrangerExperiment>()},
      {"F11b", "server: nonsense, floods and half commands", 2000, 8, {}, maker<NonsenseExperiment>()},
      {"F11c", "server: 10 connections that end at once, each", 1000, 4, {}, maker<StormExperiment>()},
      {"F20", "server: anything on the way to it", 400, 8, Milliseconds(2000), maker<RequestExperiment>()},
      {"F13b", "server: its system calls fail", 1600, 8, {}, maker<ServerSyscallExperiment>()},
  };
}

}  // namespace fault_bench
