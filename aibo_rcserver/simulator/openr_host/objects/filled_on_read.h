/// @file filled_on_read.h
/// Memory whose content is made only if somebody reads it.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_FILLED_ON_READ_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_FILLED_ON_READ_H

#include <chrono>
#include <cstddef>
#include <functional>
#include <utility>

namespace openr_host {

/// Spares a robot the work for camera images that no object looks at: it hands them over as soon as they are due, and
/// fills in the pixels when OFbkImage gives them to an object.
///
/// An object reads in the thread of its machine, which is also the robot's. Robots in other threads may do the same at
/// the same time.
class FilledOnRead {
 public:
  /// @param memory, size where the content will be; must outlive this, and overlap no other one's
  FilledOnRead(const void* memory, std::size_t size);
  ~FilledOnRead();
  FilledOnRead(const FilledOnRead&) = delete;
  FilledOnRead& operator=(const FilledOnRead&) = delete;

  /// The next read fills the memory.
  /// @param fill called at most once, by read() in its thread; replaces one that has not been called
  void fillBy(std::function<void()> fill) { fill_ = std::move(fill); }

  /// Somebody is about to read at an address. Fills the memory that it belongs to, unless that has been done.
  /// @param address any; does nothing if it belongs to no such memory
  static void read(const void* address);

  /// The processor time that this thread has spent on filling.
  static std::chrono::nanoseconds processorTime();

 private:
  const char* const begin_;
  const char* const end_;
  std::function<void()> fill_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_FILLED_ON_READ_H
