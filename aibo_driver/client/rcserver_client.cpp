#include "aibo_driver/rcserver_client.h"

#include <array>
#include <exception>
#include <future>
#include <mutex>
#include <optional>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "client/client_options.h"
#include "client/counters.h"
#include "client/fault.h"
#include "client/notifier.h"
#include "client/picture_requests.h"
#include "client/reconnect_backoff.h"
#include "client/session.h"
#include "client/tcp_transport.h"
#include "protocol/version1.h"

namespace aibo_driver {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

constexpr int kProtocolVersion = 1;
constexpr milliseconds kLongestPictureTimeout{3600 * 1000};
// A connection closed this soon, before a single byte, was not meant for us.
constexpr milliseconds kTurnedAwayTime{1000};

bool operator==(const ConnectionStatus& a, const ConnectionStatus& b) {
  return a.state == b.state && a.protocol_version == b.protocol_version && a.reason == b.reason && a.advice == b.advice;
}

}  // namespace

class RcServerClient::Implementation {
 public:
  Implementation(const ClientOptions& options, Callbacks callbacks, std::unique_ptr<Transport> transport)
      : options_(options),
        address_(options.host + ":" + std::to_string(options.port)),
        notifier_(std::move(callbacks)),
        transport_(std::move(transport)),
        next_attempt_(steady_clock::now()),
        backoff_(options.reconnect_wait_min, options.reconnect_wait_max, std::random_device()()) {
    wish_.jpeg_quality = options.jpeg_quality;
    status_.reason = "the client has not been started";
  }

  void start() {
    const std::lock_guard<std::mutex> lifecycle_lock(lifecycle_mutex_);
    if (isStopped()) {
      throw Exception("a client that was stopped cannot be started again");
    }
    if (!thread_.joinable()) {
      thread_ = std::thread([this] { run(); });
    }
  }

  void stop() noexcept {
    const std::lock_guard<std::mutex> lifecycle_lock(lifecycle_mutex_);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopped_ = true;
    }
    transport_->abort();
    if (thread_.joinable()) {
      thread_.join();
    }
  }

  void setStreaming(bool on) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      wish_.streaming = on;
    }
    transport_->wakeUp();
  }

  void setJpegQuality(int quality) {
    checkRange("jpeg_quality", quality, 1, 100);
    const std::lock_guard<std::mutex> lock(mutex_);
    wish_.jpeg_quality = quality;
  }

  bool streaming() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return streaming_;
  }

  ConnectionStatus status() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return status_;
  }

  ClientStatistics statistics() const { return counters_.snapshot(); }

  PictureAnswer takePicture(int quality, milliseconds timeout) {
    checkRange("quality", quality, 0, 100);
    checkRange("timeout", timeout.count(), 1, kLongestPictureTimeout.count(), " ms");
    PictureRequest request;
    request.quality = quality;
    request.timeout = timeout;
    request.deadline = steady_clock::now() + timeout;
    std::future<PictureAnswer> answer = request.promise.get_future();
    submit(std::move(request));
    transport_->wakeUp();
    return answer.get();
  }

 private:
  void submit(PictureRequest request) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_) {
      throw StoppedException("the client was stopped");
    }
    if (std::this_thread::get_id() == client_thread_) {
      throw Exception("takePicture() cannot be called from a callback: it would wait for itself");
    }
    if (status_.state != ConnectionState::kConnected) {
      throw NetworkException(status_.reason.empty()
                                 ? "not connected to " + address_ + " yet; try again in a moment"
                                 : "no connection to the robot: " + status_.reason + ". " + status_.advice);
    }
    new_requests_.push_back(std::move(request));
  }

  bool isStopped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return stopped_;
  }

  // All that follows runs on the client's thread.

  void run() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      client_thread_ = std::this_thread::get_id();
      status_.reason.clear();
    }
    while (!isStopped()) {
      try {
        connectAndServe();
      } catch (const StoppedException&) {
        break;
      } catch (const Fault& fault) {
        onFault(fault);
      } catch (const std::exception& error) {
        onFault(Fault::internal(error.what()));
      }
    }
    endConnection("the client was stopped", "", PictureAnswer::Outcome::kStopped);
  }

  // Comes back only by an exception.
  void connectAndServe() {
    pauseUntil(next_attempt_);
    attempt_began_ = steady_clock::now();
    updateStatus([](ConnectionStatus& status) { status.state = ConnectionState::kConnecting; });
    transport_->connect(options_.host, options_.port, attempt_began_ + options_.connect_timeout);
    ++counters_.connections;
    connected_ = steady_clock::now();
    session_.emplace(address_, options_.read_timeout, notifier_, counters_, connected_);
    updateStatus([](ConnectionStatus& status) {
      status.state = ConnectionState::kConnected;
      status.protocol_version = kProtocolVersion;
    });
    while (!session_->settled()) {
      talk();
      listen();
    }
    onSettled();
    for (;;) {
      talk();
      listen();
    }
  }

  void pauseUntil(TimePoint end) {
    while (steady_clock::now() < end) {
      transport_->wait(end);
    }
  }

  void talk() {
    const TimePoint now = steady_clock::now();
    const StreamWish wish = takeNews(now);
    if (const auto command = session_->nextCommand(wish, now)) {
      std::array<unsigned char, protocol::BASIC_COMMAND_SIZE> bytes;
      protocol::encodeCommand(*command, bytes.data());
      transport_->send(bytes.data(), bytes.size());
      updateStreaming(session_->streaming());
    }
  }

  /// Hands new calls of takePicture() to the session.
  /// @return what is wanted of the stream now
  StreamWish takeNews(TimePoint now) {
    std::vector<PictureRequest> requests;
    StreamWish wish;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      requests.swap(new_requests_);
      wish = wish_;
    }
    for (PictureRequest& request : requests) {
      session_->add(std::move(request), now);
    }
    return wish;
  }

  void listen() {
    const bool readable = transport_->wait(session_->nextDeadline());
    const TimePoint now = steady_clock::now();
    const std::size_t size = readable ? transport_->receive(buffer_.data(), buffer_.size()) : 0;
    if (size > 0) {
      session_->bytesArrived(buffer_.data(), size, now);
    }
    if (size < buffer_.size()) {
      session_->foundEmpty(now);
    }
    session_->checkDeadlines(now);
  }

  // The connection works: what was wrong before is over.
  void onSettled() {
    backoff_.reset();
    logged_reason_.clear();
    notifier_.log(LogLevel::kInfo, "Connected to " + address_ + ".");
    updateStatus([](ConnectionStatus& status) {
      status.reason.clear();
      status.advice.clear();
    });
  }

  void onFault(const Fault& cause) {
    const Fault fault = wasTurnedAway(cause) ? Fault::turnedAway(address_) : cause;
    const bool silent = fault.kind() == FaultKind::kSilent;
    counters_.stalls += silent ? 1 : 0;
    counters_.protocol_errors += fault.kind() == FaultKind::kProtocol ? 1 : 0;
    counters_.failed_attempts += session_ ? 0 : 1;
    // An attempt that took its time needs no pause after it.
    next_attempt_ = (session_ ? steady_clock::now() : attempt_began_) + backoff_.next();
    if (fault.what() != logged_reason_) {
      logged_reason_ = fault.what();
      notifier_.log(LogLevel::kWarn, "No connection to the robot: " + logged_reason_ + ". " + fault.advice() +
                                         " Trying again until it works.");
    }
    endConnection(fault.what(), fault.advice(),
                  silent ? PictureAnswer::Outcome::kTimeout : PictureAnswer::Outcome::kConnectionLost);
  }

  bool wasTurnedAway(const Fault& fault) const {
    return fault.kind() == FaultKind::kClosed && session_ && session_->silentSoFar() &&
           steady_clock::now() - connected_ < kTurnedAwayTime;
  }

  // Calls of takePicture() that are in progress end with `outcome`; later ones are refused because of the status.
  void endConnection(const std::string& reason, const std::string& advice, PictureAnswer::Outcome outcome) {
    transport_->close();
    updateStreaming(false);
    updateStatus([&](ConnectionStatus& status) {
      status.state = ConnectionState::kDisconnected;
      status.protocol_version = 0;
      status.reason = reason;
      status.advice = advice;
    });
    if (session_) {
      takeNews(steady_clock::now());
      session_->failRequests(outcome, advice.empty() ? reason : reason + ". " + advice);
      session_.reset();
    }
  }

  template <typename Change>
  void updateStatus(const Change& change) {
    ConnectionStatus status;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      status = status_;
      change(status_);
      if (status == status_) {
        return;
      }
      status = status_;
    }
    notifier_.status(status);
  }

  void updateStreaming(bool streaming) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (streaming == std::exchange(streaming_, streaming)) {
        return;
      }
    }
    notifier_.streaming(streaming);
  }

  const ClientOptions options_;
  const std::string address_;
  const Notifier notifier_;
  const std::unique_ptr<Transport> transport_;
  Counters counters_;

  std::mutex lifecycle_mutex_;  // makes start() and stop() wait for each other
  std::thread thread_;          // guarded by lifecycle_mutex_

  mutable std::mutex mutex_;  // guards what follows
  bool stopped_ = false;
  bool streaming_ = false;
  StreamWish wish_;
  ConnectionStatus status_;
  std::vector<PictureRequest> new_requests_;  // calls of takePicture() that the session does not know yet
  std::thread::id client_thread_;

  // Used by the client's thread alone.
  std::optional<Session> session_;  // there while connected
  TimePoint connected_;             // since when
  TimePoint attempt_began_;         // the present or last one to connect
  TimePoint next_attempt_;
  ReconnectBackoff backoff_;
  std::string logged_reason_;  // the reason that was logged last; empty since a connection has worked
  std::array<std::uint8_t, 64 * 1024> buffer_;
};

RcServerClient::RcServerClient(const ClientOptions& options, Callbacks callbacks)
    : RcServerClient(options, std::move(callbacks), std::make_unique<TcpTransport>()) {}

RcServerClient::RcServerClient(const ClientOptions& options, Callbacks callbacks,
                               std::unique_ptr<Transport> transport) {
  checkClientOptions(options);
  implementation_ = std::make_unique<Implementation>(options, std::move(callbacks), std::move(transport));
}

RcServerClient::~RcServerClient() {
  stop();
}

void RcServerClient::start() {
  implementation_->start();
}

void RcServerClient::stop() noexcept {
  implementation_->stop();
}

void RcServerClient::setStreaming(bool on) {
  implementation_->setStreaming(on);
}

void RcServerClient::setJpegQuality(int quality) {
  implementation_->setJpegQuality(quality);
}

bool RcServerClient::streaming() const {
  return implementation_->streaming();
}

PicturePtr RcServerClient::takePicture(int quality, milliseconds timeout, bool* from_stream) {
  const PictureAnswer answer = implementation_->takePicture(quality, timeout);
  switch (answer.outcome) {
    case PictureAnswer::Outcome::kTaken:
      break;
    case PictureAnswer::Outcome::kTimeout:
      throw TimeoutException(answer.problem);
    case PictureAnswer::Outcome::kRefused:
      throw CommandException(answer.problem);
    case PictureAnswer::Outcome::kConnectionLost:
      throw NetworkException(answer.problem);
    case PictureAnswer::Outcome::kStopped:
      throw StoppedException(answer.problem);
  }
  if (from_stream != nullptr) {
    *from_stream = answer.from_stream;
  }
  return answer.picture;
}

void RcServerClient::commandJoints(const std::vector<JointTarget>&, milliseconds) {
  throw CommandException("a server of version 1 of the protocol is not told to move joints yet");
}

void RcServerClient::setJointSpeedLimits(const std::vector<JointSpeedLimit>&) {
  throw CommandException("a server of version 1 of the protocol is not told speed limits yet");
}

bool RcServerClient::setMotors(bool, milliseconds) {
  throw CommandException("the robot's server speaks version 1 of the protocol, which cannot switch the motors");
}

void RcServerClient::setTelemetryPeriod(int frames) {
  checkRange("telemetry period", frames, 0, 65535, " frames");
}

ConnectionStatus RcServerClient::status() const {
  return implementation_->status();
}

ClientStatistics RcServerClient::statistics() const {
  return implementation_->statistics();
}

}  // namespace aibo_driver
