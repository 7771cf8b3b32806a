/// @file ObjcommEvent.h
/// What the entry points of an object are called with.
#ifndef OPENR_OBJCOMMEVENT_H
#define OPENR_OBJCOMMEVENT_H

#include <OPENR/OPENR.h>
#include <OPENR/RCRegion.h>

/// Names one subject in the whole system.
struct SubjectID {
  OID object;
  int index;  ///< sbjNAME in its object
};

/// Names one observer in the whole system.
struct ObserverID {
  OID object;
  int index;  ///< obsNAME in its object
};

inline bool operator==(const SubjectID& a, const SubjectID& b) {
  return a.object == b.object && a.index == b.index;
}
inline bool operator==(const ObserverID& a, const ObserverID& b) {
  return a.object == b.object && a.index == b.index;
}

/// Passed to DoInit, DoStart, DoStop and DoDestroy.
class OSystemEvent {};

/// Data has come to an observer. The data is valid until the entry point returns; to keep it longer, add a reference.
class ONotifyEvent {
 public:
  ONotifyEvent(int obs_index, const SubjectID& sender, RCRegion* const* regions, int number_of_data)
      : obs_index_(obs_index), sender_(sender), regions_(regions), number_of_data_(number_of_data) {}

  int ObsIndex() const { return obs_index_; }
  const SubjectID& SenderID() const { return sender_; }
  int NumOfData() const { return number_of_data_; }
  /// @param index 0..NumOfData()-1
  const void* Data(int index) const { return regions_[index]->Base(); }
  /// @param index 0..NumOfData()-1
  RCRegion* RCData(int index) const { return regions_[index]; }

 private:
  int obs_index_;
  SubjectID sender_;
  RCRegion* const* regions_;
  int number_of_data_;
};

/// An observer has become ready for data, or is ready no more.
class OReadyEvent {
 public:
  OReadyEvent(int sbj_index, const ObserverID& sender, bool is_assert)
      : sbj_index_(sbj_index), sender_(sender), is_assert_(is_assert) {}

  int SbjIndex() const { return sbj_index_; }
  const ObserverID& SenderID() const { return sender_; }
  bool IsAssert() const { return is_assert_; }
  bool IsDeassert() const { return !is_assert_; }

 private:
  int sbj_index_;
  ObserverID sender_;
  bool is_assert_;
};

/// A subject has been connected to an observer. Told to the subject's object.
class OControlEvent {
 public:
  OControlEvent(int sbj_index, const ObserverID& sender) : sbj_index_(sbj_index), sender_(sender) {}

  int SbjIndex() const { return sbj_index_; }
  const ObserverID& SenderID() const { return sender_; }

 private:
  int sbj_index_;
  ObserverID sender_;
};

/// An observer has been connected to a subject. Told to the observer's object.
class OConnectEvent {
 public:
  OConnectEvent(int obs_index, const SubjectID& sender) : obs_index_(obs_index), sender_(sender) {}

  int ObsIndex() const { return obs_index_; }
  const SubjectID& SenderID() const { return sender_; }

 private:
  int obs_index_;
  SubjectID sender_;
};

#endif  // OPENR_OBJCOMMEVENT_H
