/// @file buffer_control.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_BUFFER_CONTROL_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_BUFFER_CONTROL_H

#include <cstddef>

namespace openr_host {

/// How a subject treats one observer's notifications: OObserver::SetBufCtrlParam() (Level2 Reference Guide, page 27).
struct BufferControl {
  std::size_t skip = 0;  ///< notifications left out after each one
  std::size_t min = 1;   ///< notifications that are sent together
  std::size_t max = 1;   ///< notifications kept while the observer is not ready; the oldest is lost first
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_BUFFER_CONTROL_H
