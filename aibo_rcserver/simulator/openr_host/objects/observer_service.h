/// @file observer_service.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBSERVER_SERVICE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBSERVER_SERVICE_H

#include <OPENR/ObjcommEvent.h>

#include <vector>

#include "simulator/openr_host/objects/buffer_control.h"

namespace openr_host {

class System;

/// The inside of an OObserver: its subjects.
class ObserverService {
 public:
  ObserverService(System& system, const ObserverID& id) : system_(system), id_(id) {}
  ~ObserverService();
  ObserverService(const ObserverService&) = delete;
  ObserverService& operator=(const ObserverService&) = delete;

  const ObserverID& id() const { return id_; }

  /// Counts for connections that are made later.
  void setBufferControl(const BufferControl& control) { control_ = control; }
  const BufferControl& bufferControl() const { return control_; }

  void connect(const SubjectID& subject) { subjects_.push_back(subject); }
  int numberOfSubjects() const { return static_cast<int>(subjects_.size()); }

  void announceReady(bool ready);
  void announceReady(const SubjectID& subject, bool ready);

 private:
  System& system_;
  const ObserverID id_;
  BufferControl control_;
  std::vector<SubjectID> subjects_;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_OBSERVER_SERVICE_H
