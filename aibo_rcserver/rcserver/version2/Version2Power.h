/// @file Version2Power.h
/// Shutting down and rebooting, for a client of version 2.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_POWER_H
#define AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_POWER_H

#include "rcserver/body/PowerOrder.h"
#include "rcserver/settings/Settings.h"
#include "rcserver/version2/Version2Replies.h"

/// Carries out `Q` and `R`, as far as that means to answer and to give the order. Pure logic: no OPEN-R.
class Version2Power {
 public:
  typedef Version2Replies::Request Request;

  /// All must outlive this.
  Version2Power(PowerOrder& order, const Settings& settings, Version2Replies& replies)
      : order_(order), settings_(settings), replies_(replies) {}

  void ShutDown(const Request& request);
  void Reboot(const Request& request);

 private:
  void Give(PowerOrder order, const Request& request, bool is_allowed, const char* setting);

  PowerOrder& order_;
  const Settings& settings_;
  Version2Replies& replies_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION2_VERSION2_POWER_H
