/// @file memory_stick.h
/// The files in OPEN-R/MW/CONF on a memory stick, and how files on it are found.
///
/// The configuration files share a form (OPEN-R SDK Programmer's Guide, 4.2): `#` begins a comment, and the lines after
/// `[ERS-7]` are for that model only, up to the next such line. All readers take the file's name, which goes into
/// errors, and the robot's design, which selects the lines. They throw ConfigurationError if a line is malformed, or
/// says something twice.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_MEMORY_STICK_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_MEMORY_STICK_H

#include <filesystem>
#include <istream>
#include <map>
#include <string>
#include <vector>

#include "simulator/openr_host/configuration/text.h"

namespace openr_host {

/// Finds a file on a memory stick or a copy of one, ignoring case: the stick's own file system does so, Linux does not.
/// @param folder the stick
/// @param name path on the stick, "OPEN-R/MW/CONF/OBJECT.CFG"
/// @throw std::runtime_error if there is no such file; the text names the folder that was searched
std::filesystem::path findOnMemoryStick(const std::filesystem::path& folder, const std::string& name);

/// Whether findOnMemoryStick() would find it.
bool isOnMemoryStick(const std::filesystem::path& folder, const std::string& name);

/// One line of OBJECT.CFG.
struct ObjectFile {
  std::string name;  ///< without folder, in capitals: "RCSERVER.BIN"
  int line;
};

/// Reads an OBJECT.CFG, which lists the objects on the stick, one per line.
std::vector<ObjectFile> readObjectConfiguration(std::istream& text, const std::string& file, const std::string& design);

/// One connection between two gates.
struct ServiceConnection {
  ServiceName subject;
  ServiceName observer;
  int line;  ///< of the subject
};

/// Reads a CONNECT.CFG, which lists the connections between gates: subject, white space, observer.
/// @param services all services of the objects on this stick; others are mistakes
std::vector<ServiceConnection> readConnectionConfiguration(std::istream& text, const std::string& file,
                                                           const std::string& design,
                                                           const std::vector<std::string>& services);

/// Reads a DESIGNDB.CFG, which lists the files that objects find by a keyword (Programmer's Guide, 4.2.3): keyword,
/// white space, path.
/// @return the path on the stick, "OPEN-R/MW/DATA/P/SOUND.WAV", for each keyword
std::map<std::string, std::string> readDesignDatabase(std::istream& text, const std::string& file,
                                                      const std::string& design);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_MEMORY_STICK_H
