/// @file command_vector_memory.h
#ifndef OPENR_HOST_OBJECTS_COMMAND_VECTOR_MEMORY_H
#define OPENR_HOST_OBJECTS_COMMAND_VECTOR_MEMORY_H

#include <OPENR/ODataFormats.h>

#include <map>
#include <memory>

namespace openr_host {

/// The memory that objects get from OPENR::NewCommandVectorData().
class CommandVectorMemory {
 public:
  /// The ERS-7 has some 40 effectors: more than this is a mistake in reckoning, not a wish.
  static constexpr std::size_t kMostEntries = 65536;

  /// A vector of no entry yet, laid out for `entries`: header, infos, data.
  /// @return null if that is none or more than kMostEntries
  OCommandVectorData* create(std::size_t entries);

  /// @return false if there is no memory with this id
  bool destroy(MemoryRegionID id) { return vectors_.erase(id) != 0; }

 private:
  std::map<MemoryRegionID, std::unique_ptr<byte[]>> vectors_;
  MemoryRegionID last_id_ = 0;
};

}  // namespace openr_host

#endif  // OPENR_HOST_OBJECTS_COMMAND_VECTOR_MEMORY_H
