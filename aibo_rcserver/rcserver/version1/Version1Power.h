/// @file Version1Power.h
/// Shutting down and rebooting, for a client of version 1.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_POWER_H
#define AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_POWER_H

#include "protocol/request_reader.h"
#include "rcserver/body/PowerOrder.h"
#include "rcserver/settings/Settings.h"
#include "rcserver/version1/Version1Replies.h"

/// Carries out `Q` and `R`, as far as that means to answer and to give the order. Pure logic: no OPEN-R.
class Version1Power {
 public:
  /// All must outlive this.
  Version1Power(PowerOrder& order, const Settings& settings, Version1Replies& replies)
      : order_(order), settings_(settings), replies_(replies) {}

  /// @return false: to be refused
  bool Execute(const protocol::Request& request);

 private:
  PowerOrder& order_;
  const Settings& settings_;
  Version1Replies& replies_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_POWER_H
