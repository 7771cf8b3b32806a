#include "node/connection_message.h"

#include <cstddef>
#include <cstdint>

#include "camera/camera_options.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

using aibo_client::ClientOptions;
using aibo_client::ConnectionState;
using aibo_client::ConnectionStatus;

namespace {

// The longest reason. The robot may have chosen a part of it.
constexpr std::size_t kLongestReason = 1000;  // bytes

}  // namespace

std::string robotAddress(const ClientOptions& options) {
  return aibo_client::addressText(options.host, options.port);
}

std::string describeConnection(const ConnectionStatus& status, const ClientOptions& options) {
  const std::string address = robotAddress(options);
  if (status.state == ConnectionState::kConnected) {
    return "connected to " + address + ", protocol version " + std::to_string(status.protocol_version);
  }
  std::string text = (status.state == ConnectionState::kConnecting ? "connecting to " : "not connected to ") + address;
  if (!status.reason.empty()) {
    text += ": " + text::plainLine(status.reason, kLongestReason);
  }
  if (!status.advice.empty()) {
    text += " (" + status.advice + ")";
  }
  return text;
}

Connection toMessage(const ConnectionStatus& status, const ClientOptions& options, const std::string& settings) {
  Connection message;
  message.state = static_cast<std::uint8_t>(status.state);  // the constants have the same numbers
  message.text = describeConnection(status, options);
  message.host = options.host;
  message.port = static_cast<std::uint16_t>(options.port);
  message.robot = status.robot.design;
  message.protocol_version = static_cast<std::uint8_t>(status.protocol_version);
  if (status.state == ConnectionState::kConnected) {
    message.transport = camera::nameOf(status.transport);
    message.transport_reason = camera::transportReason(status);
  }
  message.reason = text::plainLine(status.reason, kLongestReason);
  message.advice = status.advice;
  message.settings = settings;
  return message;
}

}  // namespace aibo_driver::node
