/// @file ObjcommMessages.h
#ifndef OPENR_OBJCOMMMESSAGES_H
#define OPENR_OBJCOMMMESSAGES_H

// The SDK's header includes these, too, and objects may rely on that.
#include <OPENR/ODataFormats.h>
#include <OPENR/OPENRMessages.h>
#include <OPENR/OPower.h>
#include <OPENR/OSyslog.h>

#include <OPENR/ObjcommTypes.h>
#include <OPENR/RCRegion.h>

/// Pieces of data in a notification.
#define MAX_NUM_DATA 13

/// Bytes in a message between objects.
#define MAX_MESSAGE_SIZE 256

#endif  // OPENR_OBJCOMMMESSAGES_H
