#include "client/connection_loop.h"

#include <cerrno>
#include <exception>
#include <random>
#include <utility>

#include "aibo_client/exceptions.h"
#include "client/version2_session.h"

namespace aibo_client {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

// If a connection is closed this soon, before a single byte has come, the client was turned away.
constexpr milliseconds kTurnedAwayTime{1000};

// A flood of datagrams must not keep the thread from its other work.
constexpr int kMostDatagramsAtOnce = 512;

// `fault` changes only together with `reason`, and `robot` only together with `state`, so they are not compared.
bool operator==(const ConnectionStatus& a, const ConnectionStatus& b) {
  return a.state == b.state && a.protocol_version == b.protocol_version && a.reason == b.reason &&
         a.advice == b.advice && a.robot_message == b.robot_message && a.transport == b.transport &&
         a.wanted_transport == b.wanted_transport && a.transport_problem == b.transport_problem;
}

}  // namespace

ConnectionLoop::ConnectionLoop(const ClientOptions& options, Callbacks callbacks,
                               std::unique_ptr<TcpTransport> transport)
    : options_(options),
      address_(addressText(options.host, options.port)),
      notifier_(std::move(callbacks)),
      transport_(std::move(transport)),
      next_attempt_(steady_clock::now()),
      backoff_(options.reconnect_wait_min, options.reconnect_wait_max, std::random_device()()) {
  shared_.wanted.jpeg_quality = options.jpeg_quality;
  shared_.wanted.transport = options.picture_transport;
  shared_.wanted.guard_walks = options.guard_walks;
  shared_.wanted.leave_out_missing_joints = options.leave_out_missing_joints;
  shared_.status.reason = "the client has not been started";
}

void ConnectionLoop::start() {
  const std::lock_guard<std::mutex> lifecycle_lock(lifecycle_mutex_);
  if (isStopped()) {
    throw Exception("a client that was stopped cannot be started again");
  }
  if (!thread_.joinable()) {
    thread_ = std::thread([this] { run(); });
  }
}

void ConnectionLoop::waitForConnection(milliseconds timeout) const {
  std::unique_lock<std::mutex> lock(mutex_);
  requireOtherThread(shared_);
  connected_or_stopped_.wait_for(
      lock, timeout, [this] { return shared_.stopped || shared_.status.state == ConnectionState::kConnected; });
  requireConnection(shared_);
}

void ConnectionLoop::stop() noexcept {
  const std::lock_guard<std::mutex> lifecycle_lock(lifecycle_mutex_);
  change([](Shared& shared) { shared.stopped = true; });
  connected_or_stopped_.notify_all();
  transport_->abort();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void ConnectionLoop::requireConnection(const Shared& shared) const {
  if (shared.stopped) {
    throw StoppedException("the client was stopped");
  }
  const ConnectionStatus& status = shared.status;
  if (status.state != ConnectionState::kConnected) {
    throw NetworkException(status.reason.empty()
                               ? "not connected to " + address_ + " yet; try again in a moment"
                               : "no connection to the robot: " + status.reason + ". " + status.advice,
                           status.fault);
  }
}

void ConnectionLoop::requireOtherThread(const Shared& shared) {
  if (std::this_thread::get_id() == shared.thread) {
    throw Exception("a function that waits for the robot cannot be called from a callback: it would wait for itself");
  }
}

bool ConnectionLoop::isStopped() const {
  return read([](const Shared& shared) { return shared.stopped; });
}

void ConnectionLoop::run() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    shared_.thread = std::this_thread::get_id();
    shared_.status.reason.clear();
  }
  while (!isStopped()) {
    try {
      connectAndServe();
    } catch (const StoppedException&) {
      break;
    } catch (const Fault& fault) {
      onFault(fault);
    } catch (const ProtocolException& error) {
      onFault(Fault::protocol(address_, error.what()));
    } catch (const std::exception& error) {
      onFault(Fault::internal(error.what()));
    }
  }
  endConnection("the client was stopped", "", FaultKind::kNone);
}

// Does not return: an exception ends it.
void ConnectionLoop::connectAndServe() {
  pauseUntil(next_attempt_);
  attempt_began_ = steady_clock::now();
  ConnectionStatus status = this->status();
  status.state = ConnectionState::kConnecting;
  publish(status);
  transport_->connect(options_.host, options_.port, attempt_began_ + options_.connect_timeout);
  ++counters_.connections;
  connected_ = steady_clock::now();
  heard_ = false;
  for (beginSession();;) {
    report();
    talk();
    listen();
  }
}

// Finds out which version of the protocol the server speaks.
void ConnectionLoop::beginSession() {
  connection_.emplace(ConnectionContext{address_, options_.read_timeout, notifier_, counters_, counters_.connections},
                      connected_);
  connection_->status = status();
  Session::Bytes bytes;
  VersionAnswer answer = VersionAnswer::kNotAsked;
  if (options_.protocol_version != 1) {
    bytes = askForVersion2();
    answer = takeVersionAnswer(&bytes);
  }
  connection_->status.robot_message.clear();
  connection_->status.transport_problem.clear();
  if (answer == VersionAnswer::kVersion2) {
    session_ = std::make_unique<Version2Session>(*connection_, connected_);
  } else {
    session_ = std::make_unique<Version1Session>(*connection_, answer, connected_);
  }
  session_->bytesArrived(bytes.data(), bytes.size(), steady_clock::now());
}

/// @return what has come: the answer, if there is one, and perhaps more
Session::Bytes ConnectionLoop::askForVersion2() {
  const protocol::BasicGetCommand request = protocol::version2::versionRequest();
  send(version1Command(request.command, request.identifier));
  const TimePoint deadline = steady_clock::now() + kVersionPatience;
  Session::Bytes bytes;
  while (bytes.size() < protocol::VALUE_REPLY_SIZE && steady_clock::now() < deadline) {
    const bool is_readable = transport_->wait(deadline).connection;
    const std::size_t size = is_readable ? transport_->receive(buffer_.data(), buffer_.size()) : 0;
    bytes.insert(bytes.end(), buffer_.begin(), buffer_.begin() + size);
    heard_ = heard_ || size > 0;
    counters_.bytes_received += size;
  }
  return bytes;
}

void ConnectionLoop::pauseUntil(TimePoint end) {
  while (steady_clock::now() < end) {
    transport_->wait(end);
  }
}

void ConnectionLoop::talk() {
  const TimePoint now = steady_clock::now();
  if (has_news_.exchange(false)) {
    takeNews();
  }
  wanted_.datagram_port = datagramPort(wanted_);
  for (Session::Bytes bytes; !(bytes = session_->nextRequest(wanted_, now)).empty();) {
    send(bytes);
    update(&Shared::streaming, connection_->pictures.streaming(), &Callbacks::on_streaming, "on_streaming");
  }
}

/// Takes over the user's settings and new requests.
void ConnectionLoop::takeNews() {
  const PictureTransport transport = wanted_.transport;
  std::vector<std::function<void(Connection&)>> requests;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    requests.swap(shared_.requests);
    wanted_ = shared_.wanted;
  }
  connection_->status.wanted_transport = wanted_.transport;
  if (wanted_.transport != transport) {
    connection_->status.transport_problem.clear();
  }
  for (const auto& request : requests) {
    request(*connection_);
  }
}

/// The port for pictures by UDP. It is 0 if they should come by TCP.
int ConnectionLoop::datagramPort(const Settings& wanted) {
  Connection& connection = *connection_;
  if (wanted.transport == PictureTransport::kTcp) {
    transport_->datagrams().close();
  } else if (session_->ready() && !transport_->datagrams().isOpen() && !transport_->openDatagrams() &&
             errno != ENOTCONN) {  // ENOTCONN: the connection was reset, and the next read says so
    connection.giveUpDatagrams("this computer has no free socket");
  }
  return transport_->datagrams().port();
}

void ConnectionLoop::listen() {
  const TcpTransport::Readable readable = transport_->wait(session_->nextDeadline());
  const TimePoint begin = steady_clock::now();
  const std::size_t size = readable.connection ? transport_->receive(buffer_.data(), buffer_.size()) : 0;
  if (size > 0) {
    heard_ = true;
    counters_.bytes_received += size;
    connection_->pictures.bytesArrived(begin);
    session_->bytesArrived(buffer_.data(), size, begin);
  }
  if ((!readable.datagrams || takeDatagrams()) && size < buffer_.size()) {
    connection_->pictures.foundEmpty(begin);
  }
  const TimePoint now = steady_clock::now();  // the callbacks may have taken long
  session_->checkDeadlines(now);
  if (const Session::Bytes reply = session_->takeReply(now); !reply.empty()) {
    transport_->datagrams().reply(reply.data(), reply.size());
  }
}

/// @return true if no datagram is left
bool ConnectionLoop::takeDatagrams() {
  for (int i = 0; i < kMostDatagramsAtOnce; ++i) {
    std::size_t size = 0;
    const auto origin = transport_->datagrams().receive(buffer_.data(), buffer_.size(), &size);
    if (!origin) {
      return true;
    }
    counters_.bytes_received += size;
    if (*origin == DatagramSocket::Origin::kForeign) {
      ++counters_.foreign_datagrams;
      continue;
    }
    const TimePoint now = steady_clock::now();  // the callback for the datagram before may have taken long
    connection_->pictures.bytesArrived(now);
    if (session_->datagramArrived(buffer_.data(), size, now)) {
      transport_->datagrams().replyToLastSender();
    }
  }
  return false;
}

// Publishes what the session has found out, once the robot has answered.
void ConnectionLoop::report() {
  if (!session_->ready()) {
    return;
  }
  if (connection_->status.state != ConnectionState::kConnected) {
    onReady();
  }
  publish(connection_->status);
  update(&Shared::motors_and_posture, connection_->motors_and_posture, &Callbacks::on_motors_and_posture,
         "on_motors_and_posture");
}

// The connection works, so earlier faults are over.
void ConnectionLoop::onReady() {
  backoff_.reset();
  logged_faults_.clear();
  went_off_.clear();
  notifier_.log(LogLevel::kInfo, "Connected to " + address_ + ".");
  ConnectionStatus& status = connection_->status;
  status.state = ConnectionState::kConnected;
  status.protocol_version = session_->protocolVersion();
  status.fault = FaultKind::kNone;
  status.reason.clear();
  status.advice.clear();
}

void ConnectionLoop::onFault(const Fault& cause) {
  if (connection_ && !connection_->goes_off.empty()) {
    went_off_ = connection_->goes_off;
  }
  Fault fault = wasTurnedAway(cause) ? Fault::turnedAway(address_) : cause;
  if (!went_off_.empty()) {
    fault = fault.sinceRobotWentOff(went_off_);
  }
  const bool silent = fault.kind() == FaultKind::kSilent;
  counters_.stalls += silent ? 1 : 0;
  counters_.protocol_errors += fault.kind() == FaultKind::kProtocol ? 1 : 0;
  counters_.failed_attempts += established() ? 0 : 1;
  // If the attempt took long, the next one begins without a pause.
  next_attempt_ = (established() ? steady_clock::now() : attempt_began_) + backoff_.next();
  // Each kind of fault is logged once, because the reasons alternate from attempt to attempt while a robot is off.
  if (logged_faults_.insert(fault.kind()).second) {
    notifier_.log(LogLevel::kWarn, std::string("No connection to the robot: ") + fault.what() + ". " + fault.advice() +
                                       " Trying again until it works.");
  }
  endConnection(fault.what(), fault.advice(), fault.kind());
}

bool ConnectionLoop::wasTurnedAway(const Fault& fault) const {
  return fault.kind() == FaultKind::kClosed && established() && !heard_ &&
         steady_clock::now() - connected_ < kTurnedAwayTime;
}

// Calls in progress fail, and unsent commands are dropped. Later commands are refused because of the status.
void ConnectionLoop::endConnection(const std::string& reason, const std::string& advice, FaultKind kind) {
  transport_->close();
  connected_ = TimePoint::max();
  ConnectionStatus status = this->status();
  if (connection_) {
    connection_->status.state = ConnectionState::kDisconnected;
    status = connection_->status;
  }
  update(&Shared::streaming, false, &Callbacks::on_streaming, "on_streaming");
  update(&Shared::motors_and_posture, MotorsAndPosture(), &Callbacks::on_motors_and_posture, "on_motors_and_posture");
  status.state = ConnectionState::kDisconnected;
  status.protocol_version = 0;
  status.robot = RobotInfo();
  status.transport = PictureTransport::kTcp;
  status.fault = kind;
  status.reason = reason;
  status.advice = advice;
  publish(status);
  change([](Shared& shared) { shared.sound = SoundPart(); });
  if (session_) {
    takeNews();
    connection_->sound.connectionLost();
    connection_->calls.failAll(advice.empty() ? reason : reason + ". " + advice, kind);
  }
  session_.reset();
  connection_.reset();
}

void ConnectionLoop::publish(const ConnectionStatus& status) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (status == shared_.status) {
      return;
    }
    shared_.status = status;
  }
  connected_or_stopped_.notify_all();
  notifier_.tell(&Callbacks::on_status, "on_status", status);
}

/// Changes a value that the user can read, and reports it if it is another one.
/// @param name the callback's name
template <typename Value, typename Argument>
void ConnectionLoop::update(Value Shared::*member, const Value& value,
                            std::function<void(Argument)> Callbacks::*callback, const char* name) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (value == std::exchange(shared_.*member, value)) {
      return;
    }
  }
  notifier_.tell(callback, name, value);
}

}  // namespace aibo_client
