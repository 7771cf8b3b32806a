/// @file OPENRMessages.h
#ifndef OPENR_OPENRMESSAGES_H
#define OPENR_OPENRMESSAGES_H

#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>

typedef longword OMessageType;
const OMessageType omsgPOWER_STATUS = 1030;

/// Tells an `Extra` entry of a change in the power status (OPENR::ObservePowerStatus()). The message is valid until the
/// entry returns.
struct OPowerStatusMessage {
  OMessageType msgType;
  OPowerStatus powerStatus;

  explicit OPowerStatusMessage(const OPowerStatus& status) : msgType(omsgPOWER_STATUS), powerStatus(status) {}
};

#endif  // OPENR_OPENRMESSAGES_H
