/// @file design_check.h
#ifndef AIBO_DRIVER_JOINTS_DESIGN_CHECK_H
#define AIBO_DRIVER_JOINTS_DESIGN_CHECK_H

#include <string>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver::joints {

/// To be called before a command is sent: the numbers in it mean other joints and LEDs to a robot of another design.
/// A version 1 server does not say which design its robot is, so everything passes. From any thread.
/// @param design that the commands are made for, such as "ERS-7"; empty: any
/// @throw CommandException the connected robot says that it is of another design
void requireDesign(const RcServerClient& client, const std::string& design);

}  // namespace aibo_driver::joints

#endif  // AIBO_DRIVER_JOINTS_DESIGN_CHECK_H
