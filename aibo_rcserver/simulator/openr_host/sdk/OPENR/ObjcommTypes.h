/// @file ObjcommTypes.h
#ifndef OPENR_OBJCOMMTYPES_H
#define OPENR_OBJCOMMTYPES_H

#include <OPENR/OPENR.h>

#include <list>

/// Unique in the system. On Linux its selector is sbjNAME in its object.
typedef OServiceEntry SubjectID;

/// Unique in the system. On Linux its selector is obsNAME in its object.
typedef OServiceEntry ObserverID;

#endif  // OPENR_OBJCOMMTYPES_H
