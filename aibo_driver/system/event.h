/// @file event.h
#ifndef AIBO_DRIVER_SYSTEM_EVENT_H
#define AIBO_DRIVER_SYSTEM_EVENT_H

#include <sys/eventfd.h>

#include <cerrno>
#include <system_error>

#include "host_files/file_descriptor.h"

namespace aibo_system {

/// One thread raises the event. Another thread waits for it with poll(), together with its sockets.
class Event {
 public:
  /// @throw std::system_error if the process has no file descriptor left
  Event() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (!descriptor_.valid()) {
      throw std::system_error(errno, std::generic_category(), "eventfd");
    }
  }

  // It does no harm if one of the calls below fails: a full counter is readable anyway, and an empty one is clear.

  /// Makes descriptor() readable. Any thread may call it.
  void raise() noexcept { static_cast<void>(::eventfd_write(descriptor_.get(), 1)); }

  /// Makes descriptor() unreadable again.
  void clear() noexcept {
    eventfd_t ignored = 0;
    static_cast<void>(::eventfd_read(descriptor_.get(), &ignored));
  }

  /// The descriptor. It is readable from raise() until clear().
  int descriptor() const { return descriptor_.get(); }

 private:
  host_files::FileDescriptor descriptor_;
};

}  // namespace aibo_system

#endif  // AIBO_DRIVER_SYSTEM_EVENT_H
