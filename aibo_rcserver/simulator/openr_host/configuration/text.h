/// @file text.h
/// Helpers shared by the readers of configuration files: those of a memory stick, and an object's stub.cfg.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_TEXT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_TEXT_H

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace openr_host {

/// A mistake in a configuration file. The text begins with "FILE:LINE: ", like a compiler's.
class ConfigurationError : public std::runtime_error {
 public:
  ConfigurationError(const std::string& file, int line, const std::string& what)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + what) {}
};

/// The name of a gate of an object, "RCServer.Image.OFbkImageVectorData.O" (report, section 2.1.1).
struct ServiceName {
  std::string object;
  std::string service;
  std::string data_type;
  bool is_subject;  ///< ends in S: the object sends data here; otherwise in O: it receives data

  /// @return nothing unless `text` is four words of letters, digits and underscores, joined by dots, the last S or O
  static std::optional<ServiceName> parse(const std::string& text);

  std::string text() const;
};

/// The text without blanks, tabs and carriage returns at its beginning and end. Files written on Windows end their
/// lines in a carriage return.
std::string withoutSpaceAround(const std::string& text);

/// The parts between the separators: one more than there are separators. Parts may be empty.
std::vector<std::string> splitAt(char separator, const std::string& text);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_TEXT_H
