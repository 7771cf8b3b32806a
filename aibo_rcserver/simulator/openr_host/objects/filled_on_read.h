/// @file filled_on_read.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_FILLED_ON_READ_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_FILLED_ON_READ_H

#include <cstddef>
#include <functional>
#include <utility>

namespace openr_host {

/// Memory that is filled only if somebody reads it. This saves a robot the work for camera images that nobody reads:
/// the robot hands over images when they are due, and fills in pixels when OFbkImage gives them to an object.
///
/// An object reads in its machine's thread, which is also the robot's. Other threads may do the same with other robots.
class FilledOnRead {
 public:
  /// @param memory, size must outlive the object, and not overlap the memory of another one
  FilledOnRead(const void* memory, std::size_t size);
  ~FilledOnRead();
  FilledOnRead(const FilledOnRead&) = delete;
  FilledOnRead& operator=(const FilledOnRead&) = delete;

  /// Lets the next read() fill the memory.
  /// @param fill called at most once, in the thread of read(); replaces an earlier one
  void fillBy(std::function<void()> fill) { fill_ = std::move(fill); }

  /// Call this before an address is read. It fills the memory with the address, unless it is filled already.
  /// @param address any address, even outside all such memory
  static void read(const void* address);

 private:
  const char* const begin_;
  const char* const end_;
  std::function<void()> fill_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_FILLED_ON_READ_H
