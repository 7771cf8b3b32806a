#include "support/proxy/fault_proxy.h"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "client/event.h"
#include "support/proxy/link.h"
#include "support/sockets.h"

using aibo_driver::Event;
using aibo_driver::FileDescriptor;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace fault_bench {
namespace {

constexpr milliseconds kLongestWait{1000};

timespec timeUntil(TimePoint end) {
  const auto left = std::clamp<steady_clock::duration>(end - steady_clock::now(), milliseconds(0), kLongestWait);
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  return {seconds.count(), std::chrono::nanoseconds(left - seconds).count()};
}

void reset(FileDescriptor socket) {
  const linger discard = {1, 0};
  ::setsockopt(socket.get(), SOL_SOCKET, SO_LINGER, &discard, sizeof discard);
}

}  // namespace

class FaultProxy::Implementation {
 public:
  explicit Implementation(const Options& options)
      : options_(options), address_(options.address), listener_(bindTo(address_, options.port)) {
    port_ = portOf(listener_);
    listener_ = bindTo(address_, port_);  // only a port that was asked for is kept while nobody listens
    check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
    thread_ = std::thread([this] { run(); });
  }

  ~Implementation() {
    stopping_ = true;
    wake_up_.raise();
    thread_.join();
  }

  int port() const { return port_; }

  /// Changes something, and lets the proxy's thread know.
  template <typename Change>
  void change(const Change& apply) {
    const std::lock_guard<std::mutex> lock(mutex_);
    apply();
    wake_up_.raise();
  }

  void setConditions(const Conditions& conditions) {
    change([&] { conditions_ = conditions; });
  }

  void setWelcome(Welcome welcome) {
    change([&] { receiveClientsBy(welcome); });
  }

  void add(const Fault& fault) {
    change([&] { faults_.add(fault); });
  }

  void clearFaults() {
    change([&] { faults_.clear(); });
  }

  void endConnections(Action end) {
    change([&] {
      for (Link& link : links_) {
        link.end(end, Direction::kToClient);
      }
      held_.clear();
    });
  }

  void heal() {
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

  void setTarget(const std::string& host, int port) {
    change([&] {
      options_.target_host = host;
      options_.target_port = port;
    });
  }

  void moveTo(const std::string& address) {
    change([&] {
      FileDescriptor there = bindTo(address, port_);
      check(::listen(there.get(), SOMAXCONN) == 0, "listen");
      listener_ = std::move(there);
      address_ = address;
      for (Link& link : links_) {
        link.end(Action::kSilence, Direction::kToClient);
      }
    });
  }

  std::size_t connections() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return connections_;
  }

  std::size_t faultsDone() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return faults_done_;
  }

  std::optional<FaultReport> waitForFaults(std::size_t count, milliseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!fault_done_.wait_for(lock, timeout, [&] { return faults_done_ >= count; })) {
      return std::nullopt;
    }
    return last_fault_;
  }

 private:
  // With mutex_ locked.
  void receiveClientsBy(Welcome welcome) {
    const auto listens = [](Welcome each) { return each != Welcome::kRefuse && each != Welcome::kUnreachable; };
    if (listens(welcome) != listens(welcome_) || !listens(welcome)) {
      fillers_.clear();
      if (welcome_ != Welcome::kRefuse) {
        ::shutdown(listener_.get(), SHUT_RDWR);  // nobody listens any more, though the port stays reserved
      }
      if (listens(welcome)) {
        check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
      } else if (welcome == Welcome::kUnreachable) {
        fillQueue();
      }
    }
    welcome_ = welcome;
  }

  // A full queue of clients makes the kernel leave further attempts without an answer.
  void fillQueue() {
    check(::listen(listener_.get(), 0) == 0, "listen");
    for (int i = 0; i < 2; ++i) {
      fillers_.push_back(beginConnecting(address_, port_));
    }
  }

  void run() {
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

  TimePoint prepare(std::vector<pollfd>* polled) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const TimePoint now = steady_clock::now();
    TimePoint next = TimePoint::max();
    const bool accepts = welcome_ != Welcome::kRefuse && welcome_ != Welcome::kUnreachable;
    polled->push_back({wake_up_.descriptor(), POLLIN, 0});
    polled->push_back({accepts ? listener_.get() : -1, POLLIN, 0});
    for (Link& link : links_) {
      const auto interests = link.interests(now, conditions_);
      polled->insert(polled->end(), interests.begin(), interests.end());
      next = std::min(next, link.nextDue());
    }
    polled_links_ = links_.size();
    return next == TimePoint::max() ? now + kLongestWait : next;
  }

  void serve(const std::vector<pollfd>& polled) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const TimePoint now = steady_clock::now();
    std::vector<FaultReport> reports;
    std::size_t entry = 2;
    for (auto link = links_.begin(); link != links_.end() && entry < 2 + 2 * polled_links_; ++link, entry += 2) {
      if (!link->isOver()) {
        link->serve({{polled[entry], polled[entry + 1]}}, now, conditions_, &faults_, options_.tap, &reports);
      }
    }
    links_.remove_if([](const Link& link) { return link.isOver(); });
    if (!reports.empty()) {
      faults_done_ += reports.size();
      last_fault_ = reports.back();
      fault_done_.notify_all();
    }
    acceptClients();
  }

  void acceptClients() {
    while (welcome_ != Welcome::kRefuse && welcome_ != Welcome::kUnreachable) {
      FileDescriptor client = acceptFrom(listener_);
      if (!client.valid()) {
        return;
      }
      receiveClient(std::move(client));
    }
  }

  void receiveClient(FileDescriptor client) {
    switch (welcome_) {
      case Welcome::kReset:
        reset(std::move(client));
        break;
      case Welcome::kSilence:
        held_.push_back(std::move(client));
        break;
      case Welcome::kServe:
        try {
          const auto seed = options_.seed + 2 * static_cast<unsigned>(connections_);
          links_.emplace_back(connections_, std::move(client),
                              beginConnecting(options_.target_host, options_.target_port), seed);
          ++connections_;
        } catch (const std::system_error&) {
          // No way to the server: the client is turned away.
        }
        break;
      default:
        break;
    }
  }

  mutable std::mutex mutex_;  // guards what follows, down to the thread
  Options options_;
  std::string address_;
  FileDescriptor listener_;
  int port_ = 0;
  Welcome welcome_ = Welcome::kServe;
  Conditions conditions_;
  FaultQueue faults_;
  std::list<Link> links_;
  std::size_t polled_links_ = 0;         // of links_, that are being waited for
  std::vector<FileDescriptor> held_;     // clients who hear nothing
  std::vector<FileDescriptor> fillers_;  // of the queue of clients
  std::size_t connections_ = 0;
  std::size_t faults_done_ = 0;
  std::optional<FaultReport> last_fault_;
  std::condition_variable fault_done_;
  Event wake_up_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

FaultProxy::FaultProxy(const Options& options) : implementation_(std::make_unique<Implementation>(options)) {}

FaultProxy::~FaultProxy() = default;

int FaultProxy::port() const {
  return implementation_->port();
}

void FaultProxy::setConditions(const Conditions& conditions) {
  implementation_->setConditions(conditions);
}

void FaultProxy::setWelcome(Welcome welcome) {
  implementation_->setWelcome(welcome);
}

void FaultProxy::add(const Fault& fault) {
  implementation_->add(fault);
}

void FaultProxy::clearFaults() {
  implementation_->clearFaults();
}

void FaultProxy::endConnections(Action end) {
  implementation_->endConnections(end);
}

void FaultProxy::heal() {
  implementation_->heal();
}

void FaultProxy::setTarget(const std::string& host, int port) {
  implementation_->setTarget(host, port);
}

void FaultProxy::moveTo(const std::string& address) {
  implementation_->moveTo(address);
}

std::size_t FaultProxy::connections() const {
  return implementation_->connections();
}

std::size_t FaultProxy::faultsDone() const {
  return implementation_->faultsDone();
}

std::optional<FaultReport> FaultProxy::waitForFaults(std::size_t count, milliseconds timeout) {
  return implementation_->waitForFaults(count, timeout);
}

}  // namespace fault_bench
