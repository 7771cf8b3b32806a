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

std::uint8_t stateConstant(ConnectionState state) {
  switch (state) {
    case ConnectionState::kConnected:
      return Connection::CONNECTED;
    case ConnectionState::kConnecting:
      return Connection::CONNECTING;
    case ConnectionState::kDisconnected:
      break;
  }
  return Connection::DISCONNECTED;
}

}  // namespace

std::string robotAddress(const ClientOptions& options) {
  return aibo_client::addressText(options.host, options.port);
}

std::string describeConnection(const ConnectionStatus& status, const ClientOptions& options) {
  std::string text;
  switch (status.state) {
    case ConnectionState::kConnected:
      return "connected to " + robotAddress(options) + ", protocol version " + std::to_string(status.protocol_version);
    case ConnectionState::kConnecting:
      text = "connecting to " + robotAddress(options);
      break;
    case ConnectionState::kDisconnected:
      text = "not connected to " + robotAddress(options);
      break;
  }
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
  message.state = stateConstant(status.state);
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
