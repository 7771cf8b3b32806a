#include "aibo_driver/rcserver_client.h"

#include <array>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <random>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "client/client_options.h"
#include "client/argument_checks.h"
#include "client/counters.h"
#include "client/fault.h"
#include "client/notifier.h"
#include "client/picture_requests.h"
#include "client/reconnect_backoff.h"
#include "client/session.h"
#include "client/tcp_transport.h"
#include "client/version1_session.h"
#include "client/version2_session.h"
#include "client/version_negotiation.h"
#include "protocol/version2.h"

namespace aibo_driver {

namespace version2 = protocol::version2;

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

constexpr milliseconds kLongestTimeout{3600 * 1000};
// A connection closed this soon, before a single byte, was not meant for us.
constexpr milliseconds kTurnedAwayTime{1000};

// Who is there changes only together with the state.
bool operator==(const ConnectionStatus& a, const ConnectionStatus& b) {
  return a.state == b.state && a.protocol_version == b.protocol_version && a.reason == b.reason &&
         a.advice == b.advice && a.robot_message == b.robot_message;
}

/// Calls that have come in and that the client's thread has not seen yet.
struct News {
  std::vector<PictureRequest> pictures;
  std::vector<RobotRequest> robot;
  Commands commands;
};

/// Throws what a call has failed with, if it has.
void throwUnlessDone(CallOutcome outcome, const std::string& problem) {
  switch (outcome) {
    case CallOutcome::kDone:
      break;
    case CallOutcome::kTimeout:
      throw TimeoutException(problem);
    case CallOutcome::kRefused:
      throw CommandException(problem);
    case CallOutcome::kConnectionLost:
      throw NetworkException(problem);
    case CallOutcome::kStopped:
      throw StoppedException(problem);
  }
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
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      wish_.jpeg_quality = quality;
    }
    transport_->wakeUp();
  }

  int jpegQuality() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return wish_.jpeg_quality;
  }

  void setTelemetryPeriod(int frames) {
    checkRange("telemetry period", frames, 0, 65535, " frames");
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      wish_.telemetry_period = frames;
    }
    transport_->wakeUp();
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
    PictureRequest request;
    request.quality = quality;
    return call(std::move(request), timeout, &News::pictures, "takePicture()");
  }

  RobotAnswer setMotors(bool on, milliseconds timeout) {
    return ask(version2::REQUEST_MOTORS, "", on ? 1 : 0, {}, timeout, "setMotors()");
  }

  void playMotion(const std::string& name, int repetitions, milliseconds timeout) {
    checkRange("repetitions", repetitions, 1, 65535);
    ask(version2::REQUEST_PLAY, checkedMotionName(name), repetitions, {}, timeout, "playMotion()");
  }

  void stopMotion(const std::string& name, milliseconds timeout) {
    ask(version2::REQUEST_PLAY, name.empty() ? name : checkedMotionName(name), 0, {}, timeout, "stopMotion()");
  }

  void uploadMotion(const std::string& name, const RobotRequest::Bytes& content, milliseconds timeout) {
    checkMotionContent(content);
    ask(version2::REQUEST_UPLOAD, checkedMotionName(name), 0, content, timeout, "uploadMotion()");
  }

  void deleteMotion(const std::string& name, milliseconds timeout) {
    ask(version2::REQUEST_DELETE, checkedMotionName(name), 0, {}, timeout, "deleteMotion()");
  }

  RobotAnswer listMotions(milliseconds timeout) {
    return ask(version2::REQUEST_LIST, "", 0, {}, timeout, "listMotions()");
  }

  void shutDownRobot(milliseconds timeout) { ask(version2::REQUEST_SHUT_DOWN, "", 0, {}, timeout, "shutDownRobot()"); }

  void rebootRobot(milliseconds timeout) { ask(version2::REQUEST_REBOOT, "", 0, {}, timeout, "rebootRobot()"); }

  void commandJoints(const std::vector<JointTarget>& targets, milliseconds duration) {
    checkJointTargets(targets, duration);
    tell(version2::REQUEST_JOINTS, "joints", JointCommand{duration, targets});
  }

  void setJointSpeedLimits(const std::vector<JointSpeedLimit>& limits) {
    checkJointSpeedLimits(limits);
    tell(version2::REQUEST_SPEED_LIMITS, "joints", limits);
  }

  void commandLeds(const std::vector<LedCommand>& leds) {
    checkLedCommands(leds);
    tell(version2::REQUEST_LEDS, "LEDs", leds);
  }

  void commandEars(bool left, bool right) {
    tell(version2::REQUEST_EARS, "ears",
         std::vector<EarCommand>{{EarCommand::kLeft, left}, {EarCommand::kRight, right}});
  }

 private:
  /// Has the robot do something.
  RobotAnswer ask(char letter, const std::string& name, int number, const RobotRequest::Bytes& content,
                  milliseconds timeout, const std::string& caller) {
    RobotRequest request;
    request.letter = letter;
    request.name = name;
    request.number = number;
    request.content = content;
    RobotAnswer answer = call(std::move(request), timeout, &News::robot, caller);
    throwUnlessDone(answer.outcome, answer.problem);
    return answer;
  }

  /// Hands a request to the client's thread, and waits for its answer.
  template <typename Request>
  typename Request::Answer call(Request request, milliseconds timeout, std::vector<Request> News::*queue,
                                const std::string& name) {
    checkRange("timeout", timeout.count(), 1, kLongestTimeout.count(), " ms");
    request.timeout = timeout;
    request.deadline = steady_clock::now() + timeout;
    std::future<typename Request::Answer> answer = request.promise.get_future();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      requireConnection();
      if (std::this_thread::get_id() == client_thread_) {
        throw Exception(name + " cannot be called from a callback: it would wait for itself");
      }
      (news_.*queue).push_back(std::move(request));
    }
    transport_->wakeUp();
    return answer.get();
  }

  /// Hands a command to the client's thread.
  /// @param parts of the body that it is for
  template <typename Command>
  void tell(char request, const std::string& parts, const Command& command) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      requireConnection();
      if (status_.protocol_version > 1 && !status_.robot.hasCapability(std::string(1, request))) {
        throw CommandException(address_ + " (" + status_.robot.server + ") does not take the request '" + request +
                               "': it has no " + parts + " that could be told anything");
      }
      news_.commands.add(command);
    }
    transport_->wakeUp();
  }

  // With mutex_ locked.
  void requireConnection() const {
    if (stopped_) {
      throw StoppedException("the client was stopped");
    }
    if (status_.state != ConnectionState::kConnected) {
      throw NetworkException(status_.reason.empty()
                                 ? "not connected to " + address_ + " yet; try again in a moment"
                                 : "no connection to the robot: " + status_.reason + ". " + status_.advice);
    }
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
    endConnection("the client was stopped", "", CallOutcome::kStopped);
  }

  // Comes back only by an exception.
  void connectAndServe() {
    pauseUntil(next_attempt_);
    attempt_began_ = steady_clock::now();
    updateStatus([](ConnectionStatus& status) { status.state = ConnectionState::kConnecting; });
    transport_->connect(options_.host, options_.port, attempt_began_ + options_.connect_timeout);
    ++counters_.connections;
    connected_ = steady_clock::now();
    heard_ = false;
    beginSession();
    while (!session_->ready()) {
      talk();
      listen();
    }
    onReady();
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

  // Finds out which version of the protocol the server speaks.
  void beginSession() {
    const SessionContext context = {address_, options_.read_timeout, notifier_, counters_, counters_.connections};
    if (options_.protocol_version == 1) {
      begin<Version1Session>(context, habits_, Version1Session::VersionAnswer::kNotAsked, connected_);
      return;
    }
    const VersionNegotiation negotiation = negotiate();
    switch (negotiation.result()) {
      case VersionNegotiation::Result::kVersion2:
        begin<Version2Session>(context, connected_);
        break;
      case VersionNegotiation::Result::kVersion1:
        begin<Version1Session>(context, habits_, Version1Session::VersionAnswer::kRefused, connected_);
        break;
      default:
        begin<Version1Session>(context, habits_, Version1Session::VersionAnswer::kOwed, connected_);
    }
    session_->bytesArrived(negotiation.rest().data(), negotiation.rest().size(), steady_clock::now());
  }

  VersionNegotiation negotiate() {
    send(VersionNegotiation::request());
    VersionNegotiation negotiation(steady_clock::now());
    while (negotiation.result() == VersionNegotiation::Result::kOpen) {
      const bool readable = transport_->wait(negotiation.deadline());
      negotiation.bytesArrived(buffer_.data(), readable ? receive() : 0);
      negotiation.checkDeadline(steady_clock::now());
    }
    return negotiation;
  }

  template <typename SomeSession, typename... Arguments>
  void begin(Arguments&&... arguments) {
    session_ = std::make_unique<SomeSession>(std::forward<Arguments>(arguments)...);
  }

  void pauseUntil(TimePoint end) {
    while (steady_clock::now() < end) {
      transport_->wait(end);
    }
  }

  void talk() {
    const TimePoint now = steady_clock::now();
    const Wish wish = takeNews(now);
    for (Session::Bytes bytes; !(bytes = session_->nextRequest(wish, now)).empty();) {
      send(bytes);
      updateStreaming(session_->streaming());
    }
  }

  void send(const Session::Bytes& bytes) { transport_->send(bytes.data(), bytes.size()); }

  /// Hands new calls to the session.
  /// @return what is wanted now
  Wish takeNews(TimePoint now) {
    News news;
    Wish wish;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      news = std::exchange(news_, News());
      wish = wish_;
    }
    for (PictureRequest& request : news.pictures) {
      session_->add(std::move(request), now);
    }
    for (RobotRequest& request : news.robot) {
      session_->add(std::move(request));
    }
    session_->add(news.commands, now);
    return wish;
  }

  void listen() {
    const bool readable = transport_->wait(session_->nextDeadline());
    const TimePoint now = steady_clock::now();
    const std::size_t size = readable ? receive() : 0;
    if (size > 0) {
      session_->bytesArrived(buffer_.data(), size, now);
      updateStatus([this](ConnectionStatus& status) { status.robot_message = session_->robotMessage(); });
    }
    if (size < buffer_.size()) {
      session_->foundEmpty(now);
    }
    session_->checkDeadlines(now);
  }

  std::size_t receive() {
    const std::size_t size = transport_->receive(buffer_.data(), buffer_.size());
    heard_ = heard_ || size > 0;
    return size;
  }

  void onReady() {
    updateStatus([this](ConnectionStatus& status) {
      status.state = ConnectionState::kConnected;
      status.protocol_version = session_->protocolVersion();
      status.robot = session_->robot();
    });
  }

  // The connection works: what was wrong before is over.
  void onSettled() {
    backoff_.reset();
    logged_faults_.clear();
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
    counters_.failed_attempts += established() ? 0 : 1;
    // An attempt that took its time needs no pause after it.
    next_attempt_ = (established() ? steady_clock::now() : attempt_began_) + backoff_.next();
    // Once each: of a robot that is off, the reasons alternate, attempt by attempt.
    if (logged_faults_.insert(fault.kind()).second) {
      notifier_.log(LogLevel::kWarn, std::string("No connection to the robot: ") + fault.what() + ". " +
                                         fault.advice() + " Trying again until it works.");
    }
    endConnection(fault.what(), fault.advice(), silent ? CallOutcome::kTimeout : CallOutcome::kConnectionLost);
  }

  bool wasTurnedAway(const Fault& fault) const {
    return fault.kind() == FaultKind::kClosed && established() && !heard_ &&
           steady_clock::now() - connected_ < kTurnedAwayTime;
  }

  /// True from the end of a successful attempt to connect to the end of the connection.
  bool established() const { return connected_ != TimePoint::max(); }

  // Calls that are in progress end with `outcome`, and commands to the joints that have not been sent never will be;
  // later ones are refused because of the status.
  void endConnection(const std::string& reason, const std::string& advice, CallOutcome outcome) {
    transport_->close();
    connected_ = TimePoint::max();
    updateStreaming(false);
    updateStatus([&](ConnectionStatus& status) {
      status.state = ConnectionState::kDisconnected;
      status.protocol_version = 0;
      status.robot = RobotInfo();
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
  Wish wish_;
  ConnectionStatus status_;
  News news_;
  std::thread::id client_thread_;

  // Used by the client's thread alone.
  std::unique_ptr<Session> session_;  // there once the version of the protocol is clear
  ServerHabits habits_;
  TimePoint connected_ = TimePoint::max();  // since when; max if not
  bool heard_ = false;                      // the server has sent something
  TimePoint attempt_began_;                 // the present or last one to connect
  TimePoint next_attempt_;
  ReconnectBackoff backoff_;
  std::set<FaultKind> logged_faults_;  // since a connection has worked
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

int RcServerClient::jpegQuality() const {
  return implementation_->jpegQuality();
}

bool RcServerClient::streaming() const {
  return implementation_->streaming();
}

PicturePtr RcServerClient::takePicture(int quality, milliseconds timeout, int* stream_quality) {
  const PictureAnswer answer = implementation_->takePicture(quality, timeout);
  throwUnlessDone(answer.outcome, answer.problem);
  if (stream_quality != nullptr) {
    *stream_quality = answer.stream_quality;
  }
  return answer.picture;
}

void RcServerClient::commandJoints(const std::vector<JointTarget>& targets, milliseconds duration) {
  implementation_->commandJoints(targets, duration);
}

void RcServerClient::setJointSpeedLimits(const std::vector<JointSpeedLimit>& limits) {
  implementation_->setJointSpeedLimits(limits);
}

bool RcServerClient::setMotors(bool on, milliseconds timeout) {
  return implementation_->setMotors(on, timeout).motors_on;
}

void RcServerClient::commandLeds(const std::vector<LedCommand>& leds) {
  implementation_->commandLeds(leds);
}

void RcServerClient::commandEars(bool left, bool right) {
  implementation_->commandEars(left, right);
}

void RcServerClient::playMotion(const std::string& name, int repetitions, milliseconds timeout) {
  implementation_->playMotion(name, repetitions, timeout);
}

void RcServerClient::stopMotion(const std::string& name, milliseconds timeout) {
  implementation_->stopMotion(name, timeout);
}

void RcServerClient::uploadMotion(const std::string& name, const std::vector<std::uint8_t>& content,
                                  milliseconds timeout) {
  implementation_->uploadMotion(name, content, timeout);
}

void RcServerClient::deleteMotion(const std::string& name, milliseconds timeout) {
  implementation_->deleteMotion(name, timeout);
}

std::vector<std::string> RcServerClient::listMotions(milliseconds timeout) {
  return implementation_->listMotions(timeout).names;
}

void RcServerClient::shutDownRobot(milliseconds timeout) {
  implementation_->shutDownRobot(timeout);
}

void RcServerClient::rebootRobot(milliseconds timeout) {
  implementation_->rebootRobot(timeout);
}

void RcServerClient::setTelemetryPeriod(int frames) {
  implementation_->setTelemetryPeriod(frames);
}

ConnectionStatus RcServerClient::status() const {
  return implementation_->status();
}

ClientStatistics RcServerClient::statistics() const {
  return implementation_->statistics();
}

}  // namespace aibo_driver
