/// @file object_memory.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBJECT_MEMORY_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBJECT_MEMORY_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace openr_host {

/// Memory for objects' vectors: OPENR::NewCommandVectorData() and similar calls.
class VectorMemory {
 public:
  /// The ERS-7 has about 40 effectors, so a larger number must be a mistake.
  static constexpr std::size_t kMostEntries = 65536;

  /// Creates an empty vector with room for `entries`: header, infos, data.
  /// @return null if `entries` is 0 or above kMostEntries
  OCommandVectorData* createCommands(std::size_t entries);

  /// Creates an empty vector with room for `sounds` sounds of `bytes` bytes each.
  /// @return null if that would be nothing, or more than kMostEntries or kMostSoundBytes
  OSoundVectorData* createSounds(std::size_t sounds, std::size_t bytes);

  /// The most bytes of sound: a minute. More must be a mistake.
  static constexpr std::size_t kMostSoundBytes = 60 * 32000;

  /// Creates memory for colour tables, without any.
  OCdtVectorData* createCdt();

  /// @return null if no colour tables have this id
  OCdtVectorData* findCdt(MemoryRegionID id) const;

  /// @param type odataCOMMAND_VECTOR, odataSOUND_VECTOR or odataCDT_VECTOR
  /// @return false if no memory of this type has this id
  bool destroy(MemoryRegionID id, ODataType type);

 private:
  struct Block {
    ODataType type;
    std::unique_ptr<byte[]> memory;
  };

  template <typename Vector>
  Vector* create(ODataType type, std::size_t entries, std::size_t info_size, std::size_t total_size);

  std::map<MemoryRegionID, Block> blocks_;
  MemoryRegionID last_id_ = 0;
};

/// Files of the memory stick in objects' memory: OPENR::FindDesignData().
class DesignData {
 public:
  /// @param memory_stick the folder of the memory stick
  /// @param design the robot's design
  DesignData(std::string memory_stick, std::string design)
      : memory_stick_(std::move(memory_stick)), design_(std::move(design)) {}

  /// Reads the file for a keyword in DESIGNDB.CFG.
  /// @return the result of OPENR::FindDesignData()
  /// @throw std::runtime_error DESIGNDB.CFG cannot be read; the text says why
  OStatus find(const std::string& keyword, ODesignDataID* id, byte** data, size_t* size);

  /// @return false if no file has this id
  bool release(ODesignDataID id) { return files_.erase(id) != 0; }

 private:
  const std::string memory_stick_;
  const std::string design_;
  std::map<ODesignDataID, std::vector<byte>> files_;
  ODesignDataID last_id_ = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBJECT_MEMORY_H
