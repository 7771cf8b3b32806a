#include "rcserver/version2/Version2Power.h"

#include <stdio.h>

using namespace protocol::version2;

void Version2Power::ShutDown(const Request& request) {
  Give(POWER_SHUT_DOWN, request, settings_.allow_shut_down, "ALLOW_SHUT_DOWN");
}

void Version2Power::Reboot(const Request& request) {
  Give(POWER_REBOOT, request, settings_.allow_reboot, "ALLOW_REBOOT");
}

void Version2Power::Give(PowerOrder order, const Request& request, bool is_allowed, const char* setting) {
  if (const char* problem = checkNoPayload(request.payload_size)) {
    replies_.RefuseBadRequest(request, problem);
    return;
  }
  if (!is_allowed) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "%s is not allowed; %s=yes in RCSERVER.CFG on the memory stick allows it",
            order == POWER_REBOOT ? "rebooting" : "shutting down", setting);
    replies_.Refuse(request, CODE_REFUSED, text);
    return;
  }
  order_ = order;
  replies_.Reply(request, 0);
}
