/// @file OPENREvent.h
#ifndef OPENR_OPENREVENT_H
#define OPENR_OPENREVENT_H

#include <OPENR/OPENR.h>
#include <OPENR/ObjcommEvent.h>

/// The argument of DoInit, DoStart, DoStop and DoDestroy. It has no content.
class OSystemEvent {};

#endif  // OPENR_OPENREVENT_H
