/// @file ObjcommTypes.h
/// The two ends of a connection between objects.
#ifndef OPENR_OBJCOMMTYPES_H
#define OPENR_OBJCOMMTYPES_H

#include <OPENR/OPENR.h>

#include <list>

/// Identifies a subject in the whole system. On Linux its selector is sbjNAME in its object.
typedef OServiceEntry SubjectID;

/// Identifies an observer in the whole system. On Linux its selector is obsNAME in its object.
typedef OServiceEntry ObserverID;

#endif  // OPENR_OBJCOMMTYPES_H
