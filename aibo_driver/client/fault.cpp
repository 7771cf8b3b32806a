#include "client/fault.h"

#include <utility>

namespace aibo_client {

Fault::Fault(FaultKind kind, const std::string& reason, std::string advice)
    : NetworkException(reason, kind), advice_(std::move(advice)) {}

Fault Fault::sinceRobotWentOff(const std::string& said) const {
  return Fault(kind(), "the robot said: " + said + "; since then, " + what(),
               "Switch it on again, with a charged battery. If it is on: " + advice_);
}

Fault Fault::nameNotFound(const std::string& host, const std::string& detail) {
  return Fault(FaultKind::kNameNotFound, "the name '" + host + "' cannot be looked up: " + detail,
               "Check the robot's name, or give its IP address instead.");
}

Fault Fault::refused(const std::string& address) {
  return Fault(FaultKind::kRefused, address + " refused the connection",
               "Is the RCServer running there on this port, or is another client connected? It serves one at a time.");
}

Fault Fault::unreachable(const std::string& address, const std::string& detail) {
  return Fault(FaultKind::kUnreachable, address + " cannot be reached: " + detail,
               "Check the robot's address, its WLAN, and this computer's network.");
}

Fault Fault::noAnswer(const std::string& address, std::chrono::milliseconds limit) {
  return Fault(FaultKind::kNoAnswer, address + " did not answer within " + std::to_string(limit.count()) + " ms",
               "Is the robot switched on, is its WLAN up, and is this its address?");
}

Fault Fault::turnedAway(const std::string& address) {
  return Fault(FaultKind::kTurnedAway, address + " closed the connection as soon as it was made",
               "Is another client connected? The RCServer serves one at a time.");
}

Fault Fault::closed(const std::string& address) {
  return Fault(FaultKind::kClosed, address + " closed the connection",
               "Was the robot switched off, or its RCServer stopped?");
}

Fault Fault::silent(const std::string& address, std::chrono::milliseconds limit) {
  return Fault(FaultKind::kSilent,
               address + " sent nothing for " + std::to_string(limit.count()) + " ms while a picture was due",
               "Is the robot still on and within reach of its WLAN? If no picture has ever come, check that this is "
               "RCServer's port (54321), and not the console's (59000).");
}

Fault Fault::unanswered(const std::string& address, const std::string& request, std::chrono::milliseconds limit) {
  return Fault(FaultKind::kSilent,
               address + " did not answer " + request + " within " + std::to_string(limit.count()) + " ms",
               "Is the robot still on and within reach of its WLAN, and is the allowed time long enough?");
}

Fault Fault::protocol(const std::string& address, const std::string& detail) {
  return Fault(FaultKind::kProtocol, address + " does not speak the RCServer's protocol: " + detail,
               "Is the program that listens there really an RCServer?");
}

Fault Fault::internal(const std::string& detail) {
  return Fault(FaultKind::kInternal, "this computer failed: " + detail,
               "Check its memory and its limit of open files.");
}

}  // namespace aibo_client
