/// @file MCOOP.h
/// The time of the robot's operating system.
#ifndef OPENR_MCOOP_H
#define OPENR_MCOOP_H

#include <SystemTime.h>
#include <Types.h>

typedef slongword sError;
const sError sSUCCESS = 0;

/// A time that goes on while objects are held up, wherever it begins.
sError GetSystemTime(SystemTime* time);

#endif  // OPENR_MCOOP_H
