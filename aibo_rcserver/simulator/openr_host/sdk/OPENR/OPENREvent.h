/// @file OPENREvent.h
/// The argument of the four life cycle functions.
#ifndef OPENR_OPENREVENT_H
#define OPENR_OPENREVENT_H

#include <OPENR/OPENR.h>
#include <OPENR/ObjcommEvent.h>

/// Passed to DoInit, DoStart, DoStop and DoDestroy. Has no content.
class OSystemEvent {};

#endif  // OPENR_OPENREVENT_H
