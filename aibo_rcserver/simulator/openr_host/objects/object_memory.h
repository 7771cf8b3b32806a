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

/// The memory for objects' vectors: OPENR::NewCommandVectorData() and similar calls.
class VectorMemory {
 public:
  /// The ERS-7 has about 40 effectors, so more entries than this must be an error.
  static constexpr std::size_t kMostEntries = 65536;

  /// Creates a vector without entries, laid out for `entries` of them: header, infos, data.
  /// @return null if `entries` is 0 or more than kMostEntries
  OCommandVectorData* createCommands(std::size_t entries);

  /// Creates memory for tables of the colour detection, without tables.
  OCdtVectorData* createCdt();

  /// @return null if no memory for colour tables has this id
  OCdtVectorData* findCdt(MemoryRegionID id) const;

  /// @param type odataCOMMAND_VECTOR or odataCDT_VECTOR
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

/// The files of the memory stick that objects have loaded into memory: OPENR::FindDesignData().
class DesignData {
 public:
  /// @param memory_stick folder with the content of the memory stick
  /// @param design the robot's model
  DesignData(std::string memory_stick, std::string design)
      : memory_stick_(std::move(memory_stick)), design_(std::move(design)) {}

  /// Finds the file for a keyword in DESIGNDB.CFG and reads it.
  /// @return like OPENR::FindDesignData()
  /// @throw std::runtime_error if DESIGNDB.CFG cannot be read; the text says why
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
