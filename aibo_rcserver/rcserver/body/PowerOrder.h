/// @file PowerOrder.h
/// What is to become of the robot's power.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_POWER_ORDER_H
#define AIBO_RCSERVER_RCSERVER_BODY_POWER_ORDER_H

/// Waits to be carried out until the client has been told and has gone.
enum PowerOrder {
  POWER_STAYS_ON,
  POWER_SHUT_DOWN,
  POWER_REBOOT,
  POWER_LIE_DOWN  ///< lie down, then shut down
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_POWER_ORDER_H
