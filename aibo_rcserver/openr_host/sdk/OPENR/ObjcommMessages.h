/// @file ObjcommMessages.h
/// Limits of what objects send to each other.
#ifndef OPENR_OBJCOMMMESSAGES_H
#define OPENR_OBJCOMMMESSAGES_H

#include <OPENR/ObjcommTypes.h>
#include <OPENR/RCRegion.h>

/// Pieces of data that one notification carries at most.
#define MAX_NUM_DATA 13

/// Bytes of a message between objects.
#define MAX_MESSAGE_SIZE 256

#endif  // OPENR_OBJCOMMMESSAGES_H
