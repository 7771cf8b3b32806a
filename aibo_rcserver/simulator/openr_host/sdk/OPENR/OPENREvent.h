/// @file OPENREvent.h
/// What the four life cycle functions are called with.
#ifndef OPENR_OPENREVENT_H
#define OPENR_OPENREVENT_H

#include <OPENR/OPENR.h>
#include <OPENR/ObjcommEvent.h>

/// Passed to DoInit, DoStart, DoStop and DoDestroy. It tells nothing.
class OSystemEvent {};

#endif  // OPENR_OPENREVENT_H
