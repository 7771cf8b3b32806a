// F24: pictures by UDP, over a network that does anything with the datagrams.

#include <algorithm>
#include <array>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "aibo_client/rcserver_client.h"
#include "campaign/experiment.h"
#include "campaign/interposers.h"
#include "protocol/picture_datagram.h"
#include "robot_server.h"

namespace fault_bench {
namespace {

using aibo_client::PictureTransport;
using interposers::DatagramFault;

/// Makes one kind of fault, to about every third datagram.
class AnyDatagramFault final : public DatagramFault {
 public:
  enum Kind { kLost, kCut, kNonsense, kTwice, kSwapped, kLate, kForged, kSwallowed, kKinds, kImpersonated };

  AnyDatagramFault(Kind kind, unsigned seed) : kind_(kind), random_(seed) {}

  void arrived(Datagram datagram, std::deque<Datagram>* received) override {
    if (kind_ == kSwallowed) {
      return;
    }
    const Datagram original = datagram;
    if (uniform(random_, 0, 2) == 0 && !spoil(&datagram, received)) {
      return;
    }
    received->push_back(datagram);
    if (datagram.is_foreign) {
      received->push_back(original);
    }
    received->insert(received->end(), held_.begin(), held_.end());
    held_.clear();
  }

 private:
  /// @return false if the datagram does not come now
  bool spoil(Datagram* datagram, std::deque<Datagram>* received) {
    Bytes& bytes = datagram->bytes;
    switch (kind_) {
      case kCut:
        bytes.resize(static_cast<std::size_t>(uniform(random_, 0, static_cast<int>(bytes.size()) - 1)));
        return true;
      case kNonsense:
        bytes = randomBytes(random_, uniform(random_, 0, 1500), 0, 255);
        return true;
      case kTwice:
        received->push_back(*datagram);
        return true;
      case kImpersonated:
        received->push_back(*datagram);
        impersonate(&bytes);
        return true;
      case kForged:
        datagram->is_foreign = true;
        std::fill(bytes.begin() + std::min<std::ptrdiff_t>(32, static_cast<std::ptrdiff_t>(bytes.size())), bytes.end(),
                  std::uint8_t{0x55});
        return true;
      case kSwapped:
        held_.push_back(*datagram);
        return false;
      case kLate:
        if (held_.empty()) {
          late_.push_back(*datagram);
        }
        if (late_.size() > 20) {
          held_.assign(late_.begin(), late_.end());
          late_.clear();
        }
        return false;
      default:
        return false;
    }
  }

  // Part of a picture that the robot never sent, or the whole of it, somewhere ahead.
  void impersonate(Bytes* bytes) {
    namespace version2 = protocol::version2;
    version2::PictureDatagram header = {};
    if (version2::decodePictureDatagram(bytes->data(), bytes->size(), &header) != nullptr) {
      return;
    }
    const int ahead = std::array<int, 4>{40, 100, 10'000, 60'000}.at(static_cast<std::size_t>(uniform(random_, 0, 3)));
    header.sequence += static_cast<unsigned>(ahead + uniform(random_, 0, 1));
    header.picture += static_cast<unsigned>(ahead);
    if (uniform(random_, 0, 1) == 0) {
      header.is_parity = false;
      header.part = 0;
      header.jpeg_size = static_cast<unsigned>(bytes->size() - version2::DATAGRAM_HEADER_SIZE);
    }
    version2::encode(header, bytes->data());
    std::fill(bytes->begin() + version2::DATAGRAM_HEADER_SIZE, bytes->end(), std::uint8_t{0x55});
  }

  const Kind kind_;
  Random random_;
  std::vector<Datagram> held_;  // come behind the next one
  std::vector<Datagram> late_;
};

/// The driver's client, and the robot's own server.
class DatagramExperiment : public Experiment {
 public:
  explicit DatagramExperiment(unsigned remainder)
      : mark_(static_cast<int>(remainder) + 1), client_(options(robot_.port()), callbacks()) {
    client_.setStreaming(true);
    client_.start();
    await([this] { return pictures_ >= 3 && transport_ == PictureTransport::kUdp; }, "no picture comes by UDP");
  }
  ~DatagramExperiment() override { interposers::setDatagramFault(mark_, nullptr); }

  Outcome run(unsigned trial, Random& random) override {
    return tryOut(static_cast<AnyDatagramFault::Kind>(trial % AnyDatagramFault::kKinds), random);
  }

 protected:
  Outcome tryOut(AnyDatagramFault::Kind kind, Random& random) {
    AnyDatagramFault fault(kind, static_cast<unsigned>(random()));
    Outcome outcome;
    try {
      interposers::setDatagramFault(mark_, &fault);
      awaitMore(10, "during the fault");
      interposers::setDatagramFault(mark_, nullptr);
      const TimePoint healthy = std::chrono::steady_clock::now();
      client_.setPictureTransport(PictureTransport::kTcp);  // and back, if the client has given UDP up
      await([this] { return transport_ == PictureTransport::kTcp; }, "the client does not go back to TCP");
      client_.setPictureTransport(PictureTransport::kUdp);
      await([this] { return transport_ == PictureTransport::kUdp; }, "the client does not come back to UDP");
      awaitMore(1, "after the fault");
      outcome.recovery = std::chrono::steady_clock::now() - healthy;
    } catch (const std::exception& error) {
      outcome.violations.emplace_back(error.what());
    }
    interposers::setDatagramFault(mark_, nullptr);
    const std::lock_guard<std::mutex> lock(mutex_);
    outcome.violations.insert(outcome.violations.end(), violations_.begin(), violations_.end());
    violations_.clear();
    return outcome;
  }

 private:
  static aibo_client::ClientOptions options(int port) {
    aibo_client::ClientOptions options;
    options.port = port;
    options.picture_transport = PictureTransport::kUdp;
    return options;
  }

  aibo_client::Callbacks callbacks() {
    aibo_client::Callbacks callbacks;
    callbacks.on_status = [this](const aibo_client::ConnectionStatus& status) {
      interposers::markThisThread(mark_);
      change([&] { transport_ = status.transport; });
    };
    callbacks.on_picture = [this](const aibo_client::PicturePtr& picture) { change([&] { judge(*picture); }); };
    return callbacks;
  }

  void judge(const aibo_client::Picture& picture) {
    ++pictures_;
    if (!robot_.find(picture.jpeg)) {
      violations_.emplace_back("I2: a picture that the robot has not sent");
    }
    if (last_frame_ && picture.connection_number == last_connection_ &&
        static_cast<std::int32_t>(picture.frame_number.value_or(0) - *last_frame_) <= 0) {
      violations_.emplace_back("I3: a picture that is not newer than the one before");
    }
    last_frame_ = picture.frame_number;
    last_connection_ = picture.connection_number;
  }

  template <typename Change>
  void change(const Change& apply) {
    const std::lock_guard<std::mutex> lock(mutex_);
    apply();
    changed_.notify_all();
  }

  template <typename Condition>
  void await(const Condition& condition, const std::string& problem) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!changed_.wait_for(lock, kPatience, condition)) {
      throw std::runtime_error("M: " + problem + " for " + std::to_string(kPatience.count()) + " s");
    }
  }

  void awaitMore(unsigned count, const std::string& when) {
    std::uint64_t wanted = 0;
    change([&] { wanted = pictures_ + count; });
    await([&] { return pictures_ >= wanted; }, "too few pictures come " + when);
  }

  const int mark_;
  RobotServer robot_{nullptr};
  std::mutex mutex_;  // guards what follows, down to the client
  std::condition_variable changed_;
  std::uint64_t pictures_ = 0;
  PictureTransport transport_ = PictureTransport::kTcp;
  std::optional<std::uint32_t> last_frame_;
  std::uint64_t last_connection_ = 0;
  std::vector<std::string> violations_;
  aibo_client::RcServerClient client_;
};

/// hostile-datagrams: somebody sends others in the robot's name.
class ImpersonationExperiment final : public DatagramExperiment {
 public:
  using DatagramExperiment::DatagramExperiment;

  Outcome run(unsigned /*trial*/, Random& random) override { return tryOut(AnyDatagramFault::kImpersonated, random); }
};

}  // namespace

std::vector<Row> datagramRows() {
  return {{"F24", "datagrams lost, cut, nonsense, twice, swapped, late, forged, swallowed", 400, 8, Milliseconds(500),
           maker<DatagramExperiment>()},
          {"hostile-datagrams", "datagrams in the robot's name", 20, 1, Milliseconds(500),
           maker<ImpersonationExperiment>()}};
}

}  // namespace fault_bench
