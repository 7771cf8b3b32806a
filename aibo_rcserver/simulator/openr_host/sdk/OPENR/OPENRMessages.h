/// @file OPENRMessages.h
/// Messages from the system to an `Extra` entry of an object.
#ifndef OPENR_OPENRMESSAGES_H
#define OPENR_OPENRMESSAGES_H

#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>

typedef longword OMessageType;
const OMessageType omsgPOWER_STATUS = 1030;

/// The power status has changed in a way that the entry observes (OPENR::ObservePowerStatus()). The entry is called
/// with a pointer to one of these, which is valid until the entry returns.
struct OPowerStatusMessage {
  OMessageType msgType;
  OPowerStatus powerStatus;

  explicit OPowerStatusMessage(const OPowerStatus& status) : msgType(omsgPOWER_STATUS), powerStatus(status) {}
};

#endif  // OPENR_OPENRMESSAGES_H
