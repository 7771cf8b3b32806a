/// @file PowerOrder.h
/// What a client has told the robot to do with its power.
#ifndef RCSERVER_BODY_POWER_ORDER_H
#define RCSERVER_BODY_POWER_ORDER_H

/// Waits to be carried out until the client has got its answer.
enum PowerOrder { POWER_STAYS_ON, POWER_SHUT_DOWN, POWER_REBOOT };

#endif  // RCSERVER_BODY_POWER_ORDER_H
