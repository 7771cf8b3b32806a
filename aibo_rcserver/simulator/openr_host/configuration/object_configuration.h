/// @file object_configuration.h
/// OBJECT.CFG: which objects the memory stick has.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_OBJECT_CONFIGURATION_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_OBJECT_CONFIGURATION_H

#include <istream>
#include <string>
#include <vector>

namespace openr_host {

/// One line of OBJECT.CFG.
struct ObjectFile {
  std::string name;  ///< without folder, in capitals: "RCSERVER.BIN"
  int line;
};

/// Reads the text of an OBJECT.CFG: one object a line, `#` begins a comment. Lines after `[ERS-7]` are for that model
/// alone, up to the next such line.
/// @param file its name, for errors
/// @param design the robot's model
/// @throw ConfigurationError if a line is neither, or names an object a second time
std::vector<ObjectFile> readObjectConfiguration(std::istream& text, const std::string& file, const std::string& design);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_OBJECT_CONFIGURATION_H
