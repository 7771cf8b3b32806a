#include "simulator/openr_host/console.h"

#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <ostream>
#include <utility>

namespace openr_host {

std::uint16_t Console::takePort(const std::string& bind_address, std::uint16_t port) {
  return port_.emplace(bind_address, port).port();
}

void Console::print(const std::string& text) {
  if (output_ != nullptr) {
    *output_ << text << std::flush;
  }
  for (auto& listener : listeners_) {
    print(listener, text);
  }
}

void Console::print(Listener& listener, const std::string& text) {
  if (listener.unsent.size() + text.size() > kMostUnread) {
    ++listener.lost;
    return;
  }
  listener.unsent += text;
  flush(listener);
}

void Console::flush(Listener& listener) {
  while (!listener.unsent.empty()) {
    const ssize_t count =
        send(listener.socket.get(), listener.unsent.data(), listener.unsent.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) {
      if (errno != EAGAIN && errno != EINTR) {
        listener.socket.close();
        listener.unsent.clear();
      }
      return;
    }
    listener.unsent.erase(0, static_cast<std::size_t>(count));
    if (listener.unsent.empty() && listener.lost > 0) {
      listener.unsent = "[" + std::to_string(listener.lost) + " messages lost: this console was not read]\n";
      listener.lost = 0;
    }
  }
}

void Console::read(Listener& listener) {
  char typed[256];
  const ssize_t count = recv(listener.socket.get(), typed, sizeof(typed), MSG_DONTWAIT);
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) {
    listener.socket.close();
  }
  for (ssize_t i = 0; i < count && listener.socket.isOpen(); ++i) {
    take(listener, typed[i]);
  }
}

void Console::take(Listener& listener, char typed) {
  if (typed == '\n') {
    const std::string line = std::exchange(listener.typed, "");
    if (line.size() > kLongestLine) {
      refuse(listener, "a line has at most " + std::to_string(kLongestLine) + " characters");
    } else if (on_line_ && !line.empty()) {
      obey(listener, line);
    }
    return;
  }
  const bool is_plain = typed >= ' ' && typed <= '~';
  if (is_plain && listener.typed.size() <= kLongestLine) {
    listener.typed += typed;
  } else if (!is_plain && typed != '\r' && on_line_ && !listener.is_known) {
    refuse(listener, "only plain text is understood");
  }  // telnet's own bytes come later, if at all
}

void Console::obey(Listener& listener, const std::string& line) {
  const std::optional<std::string> answer = on_line_(line);
  if (answer) {
    listener.is_known = true;
    print(listener, *answer);
  } else {
    refuse(listener, "not understood: \"" + line + "\"; \"help\" shows the commands");
  }
}

/// Refuses a listener whose first line is not a command, because this line and later ones may come from a web page.
void Console::refuse(Listener& listener, const std::string& why) {
  print(listener, "error: " + why + "\n");
  if (!listener.is_known) {
    listener.socket.close();
  }
}

void Console::acceptListeners() {
  while (auto connection = port_->accept()) {
    Listener listener;
    listener.socket = std::move(connection->socket);
    // A terminal may be halted for longer than a client may be silent, and still answers the kernel's probes.
    const int unlimited = 0;
    setsockopt(listener.socket.get(), IPPROTO_TCP, TCP_USER_TIMEOUT, &unlimited, sizeof(unlimited));
    if (listeners_.size() < kMostListeners) {
      listeners_.push_back(std::move(listener));
    } else {
      print(listener,
            "This console has " + std::to_string(kMostListeners) + " listeners already. Close one of them.\n");
    }
  }
}

void Console::addTo(PollSet& poll_set) {
  listeners_.remove_if([](const Listener& listener) { return !listener.socket.isOpen(); });
  for (auto& listener : listeners_) {
    const int events = POLLIN | (listener.unsent.empty() ? 0 : POLLOUT);
    poll_set.add(listener.socket.get(), static_cast<short>(events), [this, &listener] {
      flush(listener);
      if (listener.socket.isOpen()) {
        read(listener);
      }
    });
  }
  if (port_) {
    poll_set.add(port_->fd(), POLLIN, [this] { acceptListeners(); });
  }
}

}  // namespace openr_host
