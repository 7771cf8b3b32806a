/// @file ObjcommMessages.h
/// Limits of what objects send to each other.
#ifndef OPENR_OBJCOMMMESSAGES_H
#define OPENR_OBJCOMMMESSAGES_H

// What an object may use without including it: the SDK's header brings these in too.
#include <OPENR/ODataFormats.h>
#include <OPENR/OPENRMessages.h>
#include <OPENR/OPower.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OTime.h>

#include <OPENR/ObjcommTypes.h>
#include <OPENR/RCRegion.h>

/// Pieces of data that one notification carries at most.
#define MAX_NUM_DATA 13

/// Bytes of a message between objects.
#define MAX_MESSAGE_SIZE 256

#endif  // OPENR_OBJCOMMMESSAGES_H
