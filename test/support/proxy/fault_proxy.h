/// @file fault_proxy.h
#ifndef TEST_SUPPORT_PROXY_FAULT_PROXY_H
#define TEST_SUPPORT_PROXY_FAULT_PROXY_H

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <list>
#include <mutex>
#include <optional>
#include <random>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "host_files/file_descriptor.h"
#include "support/proxy/faults.h"
#include "support/proxy/scanner.h"
#include "support/safety_net.h"
#include "support/sockets.h"

namespace test_support {

/// A proxy between any number of clients and a server, which passes every byte on and makes the faults that it is asked
/// for. Each direction of a connection has a thread, which reads, waits as the conditions say, and sends.
///
/// Every function may be called from any thread.
class FaultProxy {
 public:
  using OnMessage = std::function<void(Direction direction, const Message& message)>;

  /// Begins to serve.
  /// @param target_port of the server, on 127.0.0.1
  /// @param on_message called on any thread with each request, reply and push, before it is passed on; it must not use
  ///   the proxy
  explicit FaultProxy(
      int target_port, OnMessage on_message = [](Direction, const Message&) {})
      : target_port_(target_port),
        on_message_(std::move(on_message)),
        port_(portOf(bindTo("127.0.0.1", 0))),
        listener_(bindTo("127.0.0.1", port_)) {  // only an explicitly bound port stays reserved while nobody listens
    check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
    thread_ = std::thread([this] { acceptClients(); });
  }

  ~FaultProxy() {
    change([&] {
      is_stopping_ = true;
      for (Link& link : links_) {
        link.is_over = true;
      }
    });
    thread_.join();
    links_.clear();  // waits for their threads, which use the rest
  }

  int port() const { return port_; }

  /// Sets the conditions for present and later connections.
  void setConditions(const Conditions& conditions) {
    change([&] { conditions_ = conditions; });
  }

  /// Sets what happens to clients that connect from now on.
  void setWelcome(Welcome welcome) {
    change([&] { receiveClientsBy(welcome); });
  }

  /// Adds a fault. Faults take place in the order in which they were added, each over the connection that first reaches
  /// its place.
  void add(const Fault& fault) {
    change([&] { faults_.push_back(fault); });
  }

  /// Ends all connections.
  /// @param how kClose, kReset or kSilence
  void endConnections(Action how) {
    change([&] {
      for (Link& link : links_) {
        end(how, link, link.client);
      }
    });
  }

  /// Ends all faults: resets silenced connections, removes conditions and faults, and serves clients.
  void heal() {
    change([&] {
      conditions_ = Conditions();
      faults_.clear();
      for (Link& link : links_) {
        if (link.is_silent) {
          end(Action::kReset, link, link.client);
        }
      }
      receiveClientsBy(Welcome::kServe);
    });
  }

  /// Connections to the server so far.
  std::size_t connections() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return connections_;
  }

  /// Waits until all faults have been made.
  /// @return when the last of them was made; nothing if they were not made in time
  std::optional<TimePoint> waitForFaults() {
    std::unique_lock<std::mutex> lock(mutex_);
    const bool are_made = changed_.wait_for(lock, kSafetyNet, [&] { return faults_.empty(); });
    return are_made ? std::optional(last_fault_) : std::nullopt;
  }

 private:
  using microseconds = std::chrono::microseconds;

  struct Link {
    host_files::FileDescriptor client;
    host_files::FileDescriptor server;  ///< none if the client is kept in silence from the beginning
    bool is_silent = false;
    bool is_over = false;
    std::future<void> carried{};  ///< both directions have ended
  };

  /// One direction of a connection. Only for its thread.
  struct Stream {
    Link& link;
    const Direction direction;
    Scanner scanner{direction};
    std::minstd_rand random{};
    std::uint64_t offset = 0;  ///< of the next byte
    std::size_t dropped = 0;   ///< bytes still to drop
    std::uint8_t mask = 0;     ///< for the next byte

    bool isToClient() const { return direction == Direction::kToClient; }
    const host_files::FileDescriptor& sender() const { return isToClient() ? link.server : link.client; }
    const host_files::FileDescriptor& receiver() const { return isToClient() ? link.client : link.server; }
    bool isAt(const Fault& fault) const {
      return fault.direction == direction &&
             (fault.place == Place::kByte ? offset >= fault.offset : scanner.indexInPicture() == fault.offset);
    }
  };

  /// Bytes to pass on, and the fault that follows them.
  struct Step {
    Bytes bytes{};
    std::optional<Fault> fault{};
    TimePoint due{};
  };

  // Threads that wait for sockets look this often whether they still have to.
  static constexpr std::chrono::milliseconds kTick{10};

  /// Changes something, and wakes who waits for it.
  template <typename Change>
  void change(const Change& apply) {
    const std::lock_guard<std::mutex> lock(mutex_);
    apply();
    changed_.notify_all();
  }

  Conditions conditions() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return conditions_;
  }

  void receiveClientsBy(Welcome welcome) {
    if (welcome == Welcome::kRefuse && welcome_ != Welcome::kRefuse) {
      ::shutdown(listener_.get(), SHUT_RDWR);  // stops listening, and the port stays reserved
    } else if (welcome != Welcome::kRefuse && welcome_ == Welcome::kRefuse) {
      check(::listen(listener_.get(), SOMAXCONN) == 0, "listen");
    }
    welcome_ = welcome;
  }

  void acceptClients() {
    for (std::unique_lock<std::mutex> lock(mutex_); !is_stopping_;) {
      const bool listens = welcome_ != Welcome::kRefuse;
      if (host_files::FileDescriptor client; listens && (client = acceptFrom(listener_)).valid()) {
        receiveClient(std::move(client));
        continue;
      }
      links_.remove_if(
          [](const Link& link) { return link.carried.wait_for(microseconds(0)) == std::future_status::ready; });
      if (listens) {
        lock.unlock();
        isReady(listener_, POLLIN, kTick);
        lock.lock();
      } else {
        changed_.wait_for(lock, kTick);
      }
    }
  }

  void receiveClient(host_files::FileDescriptor client) {
    if (welcome_ == Welcome::kReset) {
      resetWhenClosed(client);
      return;
    }
    try {
      const bool is_silent = welcome_ == Welcome::kSilence;
      host_files::FileDescriptor server =
          is_silent ? host_files::FileDescriptor() : beginConnecting("127.0.0.1", target_port_);
      Link& link = links_.emplace_back(Link{std::move(client), std::move(server), is_silent});
      link.carried = std::async(std::launch::async, [this, &link] { carry(link); });
      connections_ += is_silent ? 0 : 1;
    } catch (const std::system_error&) {
      // The server is unreachable: the client is turned away.
    }
  }

  void carry(Link& link) {
    Stream requests{link, Direction::kToServer};
    std::thread carrier([&] { carry(&requests); });
    Stream replies{link, Direction::kToClient};
    carry(&replies);
    carrier.join();
    change([&] {
      link.client.close();
      link.server.close();
    });
  }

  void carry(Stream* stream) {
    std::deque<Step> steps;
    bool goes_on = true;
    while ((goes_on || !steps.empty()) && pass(microseconds(0), *stream)) {
      const auto left = steps.empty() ? kTick : steps.front().due - std::chrono::steady_clock::now();
      if (left <= microseconds(0)) {
        take(steps.front(), stream);
        steps.pop_front();
      } else if (!goes_on) {
        pass(std::chrono::duration_cast<microseconds>(left), *stream);
      } else if (isReady(stream->sender(), POLLIN, std::min<TimePoint::duration>(left, kTick))) {
        goes_on = read(stream, &steps);
      }
    }
  }

  /// Reads what has come, and adds steps for it that are due after the delay.
  /// @return false at the end of the bytes
  bool read(Stream* stream, std::deque<Step>* steps) {
    constexpr std::size_t kMost = 16384;
    Bytes bytes(kMost);
    const ssize_t count = ::recv(stream->sender().get(), bytes.data(), bytes.size(), 0);
    bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    std::vector<Step> added = cut(bytes, stream);
    if (count <= 0) {
      added.back().fault = Fault{count == 0 ? Action::kHalfClose : Action::kReset};
    }
    const Conditions now = conditions();
    using Jitter = std::uniform_int_distribution<microseconds::rep>;
    const TimePoint due =
        std::chrono::steady_clock::now() + now.delay + microseconds(Jitter(0, now.jitter.count())(stream->random));
    for (Step& step : added) {
      step.due = steps->empty() ? due : std::max(due, steps->back().due);
      steps->push_back(std::move(step));
    }
    return count > 0;
  }

  void take(const Step& step, Stream* stream) {
    send(step.bytes, stream);
    if (step.fault && step.fault->action == Action::kPause) {
      pass(step.fault->time, *stream);
    } else if (step.fault) {
      change([&] { end(step.fault->action, stream->link, stream->receiver()); });
    }
  }

  /// Waits for this time, and then as long as nothing gets through.
  /// @return false if the connection is over
  bool pass(microseconds time, const Stream& stream) {
    std::unique_lock<std::mutex> lock(mutex_);
    const Link& link = stream.link;
    changed_.wait_for(lock, time, [&] { return link.is_over; });
    changed_.wait(lock,
                  [&] { return link.is_over || !(link.is_silent || (conditions_.paused && stream.isToClient())); });
    return !link.is_over;
  }

  /// Changes bytes where faults say so, and cuts them where other faults take place.
  std::vector<Step> cut(const Bytes& bytes, Stream* stream) {
    std::vector<Step> steps(1);
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto byte = bytes.begin(); byte != bytes.end() && !stream->link.is_over; ++byte, ++stream->offset) {
      if (const std::optional<Message> message = stream->scanner.take(*byte)) {
        on_message_(stream->direction, *message);
      }
      for (; !faults_.empty() && stream->isAt(faults_.front()); faults_.pop_front()) {
        make(faults_.front(), stream, &steps);
      }
      if (stream->dropped > 0) {
        --stream->dropped;
      } else {
        steps.back().bytes.push_back(*byte ^ std::exchange(stream->mask, std::uint8_t{0}));
      }
    }
    return steps;
  }

  void make(const Fault& fault, Stream* stream, std::vector<Step>* steps) {
    Bytes& before = steps->back().bytes;
    if (fault.action == Action::kDrop) {
      stream->dropped += fault.bytes.size();
    } else if (fault.action == Action::kInsert) {
      before.insert(before.end(), fault.bytes.begin(), fault.bytes.end());
    } else if (fault.action == Action::kFlip) {
      stream->mask = fault.bytes.front();
    } else {
      steps->back().fault = fault;
      steps->emplace_back();
    }
    last_fault_ = std::chrono::steady_clock::now();
    changed_.notify_all();
  }

  void send(const Bytes& bytes, Stream* stream) {
    constexpr std::size_t kPacket = 1460;  // the unit to which a rate applies
    const Conditions now = conditions();
    bool goes_on = true;
    for (std::size_t sent = 0, size = 0; goes_on && sent < bytes.size(); sent += size) {
      size = now.largest_piece > 0 ? std::uniform_int_distribution<std::size_t>(1, now.largest_piece)(stream->random)
             : now.bytes_per_second > 0 ? kPacket
                                        : bytes.size();
      size = std::min(size, bytes.size() - sent);
      goes_on = sendAll(stream->receiver(), &bytes[sent], size, [&] { return pass(microseconds(0), *stream); });
      if (!goes_on && errno != EPIPE) {  // what comes for a side that has got a FIN is lost
        change([&] { end(Action::kReset, stream->link, stream->receiver()); });
      }
      if (now.bytes_per_second > 0) {
        goes_on = goes_on && pass(microseconds(size * 1000000 / now.bytes_per_second), *stream);
      }
    }
  }

  static void end(Action how, Link& link, const host_files::FileDescriptor& receiver) {
    if (how == Action::kSilence) {
      link.is_silent = true;
    } else if (how == Action::kReset) {
      resetWhenClosed(link.client);
      resetWhenClosed(link.server);
      link.is_over = true;
    } else if (how == Action::kClose) {
      ::shutdown(link.client.get(), SHUT_WR);
      ::shutdown(link.server.get(), SHUT_WR);
    } else {
      ::shutdown(receiver.get(), SHUT_WR);
    }
  }

  const int target_port_;
  const OnMessage on_message_;
  const int port_;
  mutable std::mutex mutex_;  // guards what follows, down to the thread
  host_files::FileDescriptor listener_;
  Welcome welcome_ = Welcome::kServe;
  Conditions conditions_;
  std::deque<Fault> faults_;
  std::list<Link> links_;
  std::size_t connections_ = 0;
  TimePoint last_fault_;
  bool is_stopping_ = false;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_FAULT_PROXY_H
