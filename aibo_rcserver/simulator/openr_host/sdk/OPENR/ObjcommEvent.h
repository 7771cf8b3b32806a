/// @file ObjcommEvent.h
#ifndef OPENR_OBJCOMMEVENT_H
#define OPENR_OBJCOMMEVENT_H

#include <OPENR/OPENR.h>
#include <OPENR/ObjcommMessages.h>
#include <OPENR/ObjcommTypes.h>
#include <OPENR/RCRegion.h>

/// Tells an observer that data has come. The data is valid until the entry point returns, unless you add a reference.
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

/// Tells a subject that an observer has become ready, or is no longer ready.
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

/// Tells an object that one of its subjects was connected.
class OControlEvent {
 public:
  OControlEvent(int sbj_index, const ObserverID& sender) : sbj_index_(sbj_index), sender_(sender) {}

  int SbjIndex() const { return sbj_index_; }
  const ObserverID& SenderID() const { return sender_; }

 private:
  int sbj_index_;
  ObserverID sender_;
};

/// Tells an object that one of its observers was connected.
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
