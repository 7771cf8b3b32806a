#include "support/proxy/fault_proxy.h"

#include <sys/socket.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "support/sockets.h"

using host_files::FileDescriptor;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace test_support {
namespace {

constexpr milliseconds kLongestWait{1000};

timespec timeUntil(TimePoint end) {
  const auto left = std::clamp<steady_clock::duration>(end - steady_clock::now(), milliseconds(0), kLongestWait);
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  return {seconds.count(), std::chrono::nanoseconds(left - seconds).count()};
}

}  // namespace

FaultProxy::FaultProxy(const Options& options) : options_(options), listener_(bindTo("127.0.0.1", options.port)) {
  port_ = portOf(listener_);
  listener_ = bindTo("127.0.0.1", port_);  // only an explicitly bound port stays reserved while nobody listens
  check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
  thread_ = std::thread([this] { run(); });
}

FaultProxy::FaultProxy(int target_port) : FaultProxy(Options{"127.0.0.1", target_port}) {}

FaultProxy::~FaultProxy() {
  stopping_ = true;
  wake_up_.raise();
  thread_.join();
}

template <typename Change>
void FaultProxy::change(const Change& apply) {
  const std::lock_guard<std::mutex> lock(mutex_);
  apply();
  wake_up_.raise();
}

void FaultProxy::setConditions(const Conditions& conditions) {
  change([&] { conditions_ = conditions; });
}

void FaultProxy::setWelcome(Welcome welcome) {
  change([&] { receiveClientsBy(welcome); });
}

void FaultProxy::add(const Fault& fault) {
  change([&] { faults_.add(fault); });
}

void FaultProxy::endConnections(Action end) {
  change([&] {
    for (Link& link : links_) {
      link.end(end, Direction::kToClient);
    }
    held_.clear();
  });
}

void FaultProxy::heal() {
  change([&] {
    conditions_ = Conditions();
    faults_.clear();
    held_.clear();
    for (Link& link : links_) {
      if (link.isSilent()) {
        link.end(Action::kReset, Direction::kToClient);
      }
    }
    receiveClientsBy(Welcome::kServe);
  });
}

std::size_t FaultProxy::connections() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return connections_;
}

std::size_t FaultProxy::faultsDone() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return faults_done_;
}

std::optional<TimePoint> FaultProxy::waitForFaults(std::size_t count, milliseconds timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!fault_done_.wait_for(lock, timeout, [&] { return faults_done_ >= count; })) {
    return std::nullopt;
  }
  return last_fault_;
}

void FaultProxy::receiveClientsBy(Welcome welcome) {
  if (welcome == Welcome::kRefuse && welcome_ != Welcome::kRefuse) {
    ::shutdown(listener_.get(), SHUT_RDWR);  // stops listening, and the port stays reserved
  } else if (welcome != Welcome::kRefuse && welcome_ == Welcome::kRefuse) {
    check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
  }
  welcome_ = welcome;
}

void FaultProxy::run() {
  std::vector<pollfd> polled;
  while (!stopping_) {
    polled.clear();
    const TimePoint next = prepare(&polled);
    const timespec timeout = timeUntil(next);
    ::ppoll(polled.data(), polled.size(), &timeout, nullptr);
    if (polled[0].revents != 0) {
      wake_up_.clear();
    }
    serve(polled);
  }
}

TimePoint FaultProxy::prepare(std::vector<pollfd>* polled) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const TimePoint now = steady_clock::now();
  TimePoint next = TimePoint::max();
  polled->push_back({wake_up_.descriptor(), POLLIN, 0});
  polled->push_back({welcome_ == Welcome::kRefuse ? -1 : listener_.get(), POLLIN, 0});
  for (Link& link : links_) {
    const auto interests = link.interests(now, conditions_);
    polled->insert(polled->end(), interests.begin(), interests.end());
    next = std::min(next, link.nextDue());
  }
  polled_links_ = links_.size();
  return next == TimePoint::max() ? now + kLongestWait : next;
}

void FaultProxy::serve(const std::vector<pollfd>& polled) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const TimePoint now = steady_clock::now();
  std::size_t done = 0;
  std::size_t entry = 2;
  for (auto link = links_.begin(); link != links_.end() && entry < 2 + 2 * polled_links_; ++link, entry += 2) {
    if (!link->isOver()) {
      done += link->serve({{polled[entry], polled[entry + 1]}}, now, conditions_, &faults_, options_.tap);
    }
  }
  links_.remove_if([](const Link& link) { return link.isOver(); });
  if (done > 0) {
    faults_done_ += done;
    last_fault_ = now;
    fault_done_.notify_all();
  }
  acceptClients();
}

void FaultProxy::acceptClients() {
  while (welcome_ != Welcome::kRefuse) {
    FileDescriptor client = acceptFrom(listener_);
    if (!client.valid()) {
      return;
    }
    receiveClient(std::move(client));
  }
}

void FaultProxy::receiveClient(FileDescriptor client) {
  switch (welcome_) {
    case Welcome::kReset:
      resetWhenClosed(client);
      break;
    case Welcome::kSilence:
      held_.push_back(std::move(client));
      break;
    case Welcome::kServe:
      try {
        links_.emplace_back(connections_, std::move(client),
                            beginConnecting(options_.target_host, options_.target_port));
        ++connections_;
      } catch (const std::system_error&) {
        // The server is unreachable: the client is turned away.
      }
      break;
    default:
      break;
  }
}

}  // namespace test_support
