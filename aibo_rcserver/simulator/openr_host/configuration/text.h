/// @file text.h
/// Helper functions to read a memory stick's configuration and an object's stub.cfg.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_TEXT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_TEXT_H

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace openr_host {

/// The text begins with "FILE:LINE: ", like a compiler's.
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
  /// Ends in S: the object sends data here. Otherwise it ends in O: the object receives data.
  bool is_subject;

  /// @return empty unless `text` is four words of letters, digits and underscores, joined by dots, and ends in S or O
  static std::optional<ServiceName> parse(const std::string& text);

  std::string text() const;
};

/// Removes blanks, tabs and carriage returns at both ends. Lines written on Windows end in a carriage return.
std::string withoutSpaceAround(const std::string& text);

/// Parts may be empty. There is one more part than separators.
std::vector<std::string> splitAt(char separator, const std::string& text);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_TEXT_H
