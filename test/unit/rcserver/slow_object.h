/// @file slow_object.h
/// Delays the jobs of PictureEncoder or FileKeeper.
#ifndef TEST_UNIT_RCSERVER_SLOW_OBJECT_H
#define TEST_UNIT_RCSERVER_SLOW_OBJECT_H

#include <OPENR/OObject.h>

#include <functional>
#include <optional>
#include <utility>

#include "simulator/openr_host/object_description.h"
#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/objects/system.h"

/// Intercepts the jobs of an object, which it gets through its first observer. While it is slow, it holds a job back;
/// all other objects go on.
class SlowObject {
 public:
  /// Call before the machine is constructed.
  void intercept(openr_host::ObjectDescription& description) {
    notify_ = std::exchange(description.observers.at(0).notify, [this](OObject& object, const ONotifyEvent& event) {
      job_ = Job{&openr_host::System::current(), &object, event.ObsIndex(), event.SenderID(),
                 openr_host::reference(event.RCData(0))};
      is_done_ = !is_slow_;
      obey();
    });
  }

  /// From now on a job takes until finish().
  void slowDown() { is_slow_ = true; }

  bool hasJob() const { return job_.has_value(); }

  /// The job is done in the next frame. The object stays slow.
  void finish() { is_done_ = true; }

  /// From now on a job takes no time; this one is done in the next frame.
  void speedUp() {
    is_slow_ = false;
    finish();
  }

  /// Carries the job out if its time is over. Call again and again.
  void obey() {
    if (!job_ || !is_done_) {
      return;
    }
    const Job job = *std::exchange(job_, std::nullopt);
    RCRegion* const region = job.region.get();
    const ONotifyEvent event(job.observer, job.sender, &region, 1);
    job.system->runAs(*job.object, [&] { notify_(*job.object, event); });
  }

 private:
  struct Job {
    openr_host::System* system;
    OObject* object;
    int observer;
    SubjectID sender;
    openr_host::RegionReference region;
  };

  std::function<void(OObject&, const ONotifyEvent&)> notify_;
  bool is_slow_ = false;
  bool is_done_ = false;
  std::optional<Job> job_;
};

#endif  // TEST_UNIT_RCSERVER_SLOW_OBJECT_H
