/// @file service_name.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_SERVICE_NAME_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_SERVICE_NAME_H

#include <optional>
#include <string>

namespace openr_host {

/// The name of one gate of one object, "RCServer.Image.OFbkImageVectorData.O" (report, section 2.1.1).
struct ServiceName {
  std::string object;
  std::string service;
  std::string data_type;
  bool is_subject;  ///< ends in S: data leaves here; else in O: data comes here

  /// @return nothing unless `text` is four words of letters, digits and underscores, joined by dots, the last S or O
  static std::optional<ServiceName> parse(const std::string& text);

  std::string text() const;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_SERVICE_NAME_H
