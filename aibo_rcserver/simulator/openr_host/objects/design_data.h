/// @file design_data.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_DESIGN_DATA_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_DESIGN_DATA_H

#include <OPENR/OPENR.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace openr_host {

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

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_DESIGN_DATA_H
