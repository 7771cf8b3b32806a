/// @file core_macro.h
/// Standard steps of the life cycle functions for subjects and observers. Use them in a class with the members
/// `subject` and `observer` that includes its def.h.
#ifndef OPENR_CORE_MACRO_H
#define OPENR_CORE_MACRO_H

// Sony's header includes the object's entry.h, and objects may rely on that.
#if __has_include("entry.h")
#include "entry.h"
#endif

#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#define OPENR_FOR_ALL(count, statement)    \
  do {                                     \
    for (int i_ = 0; i_ < (count); ++i_) { \
      statement;                           \
    }                                      \
  } while (false)

/// The first step of DoInit.
#define NEW_ALL_SUBJECT_AND_OBSERVER                         \
  OPENR_FOR_ALL(numOfSubject, subject[i_] = new OSubject()); \
  OPENR_FOR_ALL(numOfObserver, observer[i_] = new OObserver())

/// The second step of DoInit.
#define REGISTER_ALL_ENTRY                                        \
  OPENR_FOR_ALL(numOfSubject, subject[i_]->Register(myOID_, i_)); \
  OPENR_FOR_ALL(numOfObserver, observer[i_]->Register(myOID_, i_))

/// The third step of DoInit. It does nothing on Linux, where the machine knows the entry functions from the object's
/// description.
#define SET_ALL_READY_AND_NOTIFY_ENTRY static_cast<void>(0)

/// The first step of DoStart. It does nothing, as in the SDK: a subject may notify from DoInit() on.
#define ENABLE_ALL_SUBJECT static_cast<void>(0)

/// The second step of DoStart.
#define ASSERT_READY_TO_ALL_OBSERVER OPENR_FOR_ALL(numOfObserver, observer[i_]->AssertReady())

/// The first step of DoStop.
#define DISABLE_ALL_SUBJECT OPENR_FOR_ALL(numOfSubject, subject[i_]->ClearBuffer())

/// The second step of DoStop.
#define DEASSERT_READY_TO_ALL_OBSERVER OPENR_FOR_ALL(numOfObserver, observer[i_]->DeassertReady())

/// The only step of DoDestroy.
#define DELETE_ALL_SUBJECT_AND_OBSERVER            \
  OPENR_FOR_ALL(numOfSubject, delete subject[i_]); \
  OPENR_FOR_ALL(numOfObserver, delete observer[i_])

#endif  // OPENR_CORE_MACRO_H
