#include "rcserver/version1/Version1Power.h"

bool Version1Power::Execute(const protocol::Request& request) {
  const bool is_reboot = request.basic.command == protocol::REQUEST_REBOOT;
  if (is_reboot ? !settings_.allow_reboot : !settings_.allow_shut_down) {
    return false;
  }
  order_ = is_reboot ? POWER_REBOOT : POWER_SHUT_DOWN;
  replies_.Answer(request.basic, 0);
  return true;
}
