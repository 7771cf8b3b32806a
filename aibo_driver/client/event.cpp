#include "client/event.h"

#include <sys/eventfd.h>

#include <cerrno>
#include <system_error>

namespace aibo_driver {

Event::Event() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!descriptor_.valid()) {
    throw std::system_error(errno, std::generic_category(), "eventfd");
  }
}

// Neither call can fail in a way that matters: a full counter is readable, and an empty one is clear.
void Event::raise() noexcept {
  static_cast<void>(::eventfd_write(descriptor_.get(), 1));
}

void Event::clear() noexcept {
  eventfd_t ignored = 0;
  static_cast<void>(::eventfd_read(descriptor_.get(), &ignored));
}

}  // namespace aibo_driver
