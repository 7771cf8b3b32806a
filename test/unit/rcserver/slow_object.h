/// @file slow_object.h
/// Makes a helper object of the RCServer as slow as a test likes.
#ifndef TEST_UNIT_RCSERVER_SLOW_OBJECT_H
#define TEST_UNIT_RCSERVER_SLOW_OBJECT_H

#include <OPENR/OObject.h>

#include <functional>
#include <optional>
#include <utility>

#include "simulator/openr_host/object_description.h"
#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/objects/system.h"

/// Stands between the machine and an object that gets jobs through its first observer. As long as it is slow, it keeps
/// the job that comes; all other objects go on.
class SlowObject {
 public:
  /// To be called before the machine is made.
  void standBefore(openr_host::ObjectDescription& description) {
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

  /// The memory of the job that has come.
  template <typename Content>
  Content& job() {
    void* const base = job_->region->Base();
    return *static_cast<Content*>(base);
  }

  /// The job is done by the time of the next camera image. The object stays slow.
  void finish() { is_done_ = true; }

  /// From now on a job takes no time; this one is done by the time of the next camera image.
  void speedUp() {
    is_slow_ = false;
    finish();
  }

  /// Carries out the job if it is done. To be called again and again, or when a job is to be done now.
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
