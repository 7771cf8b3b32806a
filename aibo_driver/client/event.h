/// @file event.h
#ifndef AIBO_DRIVER_CLIENT_EVENT_H
#define AIBO_DRIVER_CLIENT_EVENT_H

#include "client/file_descriptor.h"

namespace aibo_driver {

/// Something that one thread raises and another waits for with poll(), among its sockets.
class Event {
 public:
  /// @throw std::system_error if the process has no file descriptor left
  Event();

  /// Makes descriptor() readable. Any thread.
  void raise() noexcept;

  /// Makes descriptor() unreadable again.
  void clear() noexcept;

  /// Readable from raise() until clear().
  int descriptor() const { return descriptor_.get(); }

 private:
  FileDescriptor descriptor_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_EVENT_H
