/// @file MCOOP.h
/// The time of the robot's operating system.
#ifndef OPENR_MCOOP_H
#define OPENR_MCOOP_H

#include <SystemTime.h>
#include <Types.h>

typedef slongword sError;
const sError sSUCCESS = 0;
const sError sFAIL = 2;

/// A clock that runs on while objects stall. It may begin anywhere.
sError GetSystemTime(SystemTime* time);

#endif  // OPENR_MCOOP_H
