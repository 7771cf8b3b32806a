/// @file memory_stick.h
/// The files in OPEN-R/MW/CONF on a memory stick, and how to find files on it.
///
/// All configuration files have the same form (OPEN-R SDK Programmer's Guide, 4.2). `#` begins a comment. Lines between
/// `[ERS-7]` and the next such line are only for that model. All readers take the file's name, for errors, and the
/// robot's design. They throw ConfigurationError if a line is malformed or repeats something.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MEMORY_STICK_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MEMORY_STICK_H

#include <filesystem>
#include <istream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace openr_host {

/// Thrown if a configuration file has a fault. The text begins with "FILE:LINE: ", like a compiler's.
class ConfigurationError : public std::runtime_error {
 public:
  ConfigurationError(const std::string& file, int line, const std::string& what)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + what) {}
};

/// An object's gate: "RCServer.Image.OFbkImageVectorData.O" (report, section 2.1.1).
struct ServiceName {
  std::string object;
  std::string service;
  std::string data_type;
  /// True if the name ends in S: the object sends data here. Otherwise it ends in O, and the object receives data.
  bool is_subject;

  /// @return empty unless `text` is four words of letters, digits and underscores, joined by dots, and ends in S or O
  static std::optional<ServiceName> parse(const std::string& text);

  std::string text() const;
};

/// Finds a file on a memory stick or a copy of one. It ignores case, as the stick's own file system does.
/// @param folder the folder of the stick
/// @param name the name on the stick: "OPEN-R/MW/CONF/OBJECT.CFG"
/// @throw std::runtime_error there is no such file; the text names the searched folder
std::filesystem::path findOnMemoryStick(const std::filesystem::path& folder, const std::string& name);

/// True if findOnMemoryStick() would find the file.
bool isOnMemoryStick(const std::filesystem::path& folder, const std::string& name);

/// The text of a configuration file, whatever editor wrote it (protocol::textInFile()).
/// @throw std::runtime_error the file is not a regular one, is too long, or cannot be read; the text names it
std::istringstream openConfiguration(const std::string& path);

/// A line of OBJECT.CFG.
struct ObjectFile {
  std::string name;  ///< in capitals, without folder: "RCSERVER.BIN"
  int line;
};

/// OBJECT.CFG lists the objects on the stick, one per line.
std::vector<ObjectFile> readObjectConfiguration(std::istream& text, const std::string& file, const std::string& design);

struct ServiceConnection {
  ServiceName subject;
  ServiceName observer;
  int line;  ///< the line of the subject
};

/// CONNECT.CFG lists connections between gates: subject, white space, observer.
/// @param services all services of the objects on this stick; others are mistakes
std::vector<ServiceConnection> readConnectionConfiguration(std::istream& text, const std::string& file,
                                                           const std::string& design,
                                                           const std::vector<std::string>& services);

/// DESIGNDB.CFG lists files that objects find by a keyword (Programmer's Guide, 4.2.3): keyword, white space, path.
/// @return for each keyword, the path on the stick: "OPEN-R/MW/DATA/P/SOUND.WAV"
std::map<std::string, std::string> readDesignDatabase(std::istream& text, const std::string& file,
                                                      const std::string& design);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_MEMORY_STICK_H
