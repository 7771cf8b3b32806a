/// @file core_macro.h
/// The standard steps of the four life cycle functions for an object's subjects and observers. For use in the member
/// functions of a class that has the members `subject` and `observer` and includes its def.h.
#ifndef OPENR_CORE_MACRO_H
#define OPENR_CORE_MACRO_H

#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#define OPENR_FOR_ALL(count, statement)    \
  do {                                     \
    for (int i_ = 0; i_ < (count); ++i_) { \
      statement;                           \
    }                                      \
  } while (false)

/// DoInit, first.
#define NEW_ALL_SUBJECT_AND_OBSERVER                         \
  OPENR_FOR_ALL(numOfSubject, subject[i_] = new OSubject()); \
  OPENR_FOR_ALL(numOfObserver, observer[i_] = new OObserver())

/// DoInit, second.
#define REGISTER_ALL_ENTRY                                        \
  OPENR_FOR_ALL(numOfSubject, subject[i_]->Register(myOID_, i_)); \
  OPENR_FOR_ALL(numOfObserver, observer[i_]->Register(myOID_, i_))

/// DoInit, third. Does nothing on Linux, where the machine knows the entry functions from the object's description.
#define SET_ALL_READY_AND_NOTIFY_ENTRY static_cast<void>(0)

/// DoStart, first.
#define ENABLE_ALL_SUBJECT OPENR_FOR_ALL(numOfSubject, subject[i_]->Enable(true))

/// DoStart, second.
#define ASSERT_READY_TO_ALL_OBSERVER OPENR_FOR_ALL(numOfObserver, observer[i_]->AssertReady())

/// DoStop, first.
#define DISABLE_ALL_SUBJECT OPENR_FOR_ALL(numOfSubject, subject[i_]->Enable(false))

/// DoStop, second.
#define DEASSERT_READY_TO_ALL_OBSERVER OPENR_FOR_ALL(numOfObserver, observer[i_]->DeassertReady())

/// DoDestroy.
#define DELETE_ALL_SUBJECT_AND_OBSERVER            \
  OPENR_FOR_ALL(numOfSubject, delete subject[i_]); \
  OPENR_FOR_ALL(numOfObserver, delete observer[i_])

#endif  // OPENR_CORE_MACRO_H
