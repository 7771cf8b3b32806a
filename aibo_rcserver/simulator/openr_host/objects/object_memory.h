/// @file object_memory.h
/// The memory that objects get from OPENR:: calls.
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

/// The memory that objects get for vectors of their own: OPENR::NewCommandVectorData() and its like.
class VectorMemory {
 public:
  /// The ERS-7 has some 40 effectors: more than this is a mistake in reckoning, not a wish.
  static constexpr std::size_t kMostEntries = 65536;

  /// A vector of no entry yet, laid out for `entries`: header, infos, data.
  /// @return null if that is 0 or more than kMostEntries
  OCommandVectorData* createCommands(std::size_t entries);

  /// Tables of the colour detection, none yet.
  OCdtVectorData* createCdt();

  /// @return null if there is no memory of colour tables with this id
  OCdtVectorData* findCdt(MemoryRegionID id) const;

  /// @param type odataCOMMAND_VECTOR or odataCDT_VECTOR
  /// @return false if there is no memory of this type with this id
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

/// The files of the memory stick that objects have in memory: OPENR::FindDesignData().
class DesignData {
 public:
  /// @param memory_stick folder that holds what the robot has on its memory stick
  /// @param design the robot's model
  DesignData(std::string memory_stick, std::string design)
      : memory_stick_(std::move(memory_stick)), design_(std::move(design)) {}

  /// Reads DESIGNDB.CFG, and the file that it has for a keyword.
  /// @return as OPENR::FindDesignData()
  /// @throw std::runtime_error if DESIGNDB.CFG cannot be read; the text says why
  OStatus find(const std::string& keyword, ODesignDataID* id, byte** data, size_t* size);

  /// @return false if there is none with this id
  bool release(ODesignDataID id) { return files_.erase(id) != 0; }

 private:
  const std::string memory_stick_;
  const std::string design_;
  std::map<ODesignDataID, std::vector<byte>> files_;
  ODesignDataID last_id_ = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBJECT_MEMORY_H
