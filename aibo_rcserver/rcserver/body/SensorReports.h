/// @file SensorReports.h
/// What a sensor vector of OPEN-R says.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_SENSOR_REPORTS_H
#define AIBO_RCSERVER_RCSERVER_BODY_SENSOR_REPORTS_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <string.h>

#include "rcserver/body/Primitives.h"

/// Goes through the reports of a vector that come from the primitives of a table, and passes over all others.
class SensorReports {
 public:
  /// Both must outlive this.
  SensorReports(OSensorFrameVectorData* vector, const Primitives& primitives)
      : vector_(vector), primitives_(primitives), entry_(-1), row_(Primitives::NOT_OPEN) {}

  /// Goes on to the next report, or at first to the first one.
  /// @return false if there is no more
  bool Next();

  /// Which primitive reports: its row in the table.
  int Row() const { return row_; }

  /// The last frame that it reports of.
  longword Frame() const { return Info().frameNumber + LastIndex(); }

  /// What it reports of that frame.
  /// @param[out] value OJointValue of a joint, OSensorValue of a sensor
  template <typename Value>
  void Read(Value* value) const {
    memcpy(value, &vector_->GetData(entry_)->frame[LastIndex()], sizeof(*value));
  }

 private:
  SensorReports(const SensorReports&);
  SensorReports& operator=(const SensorReports&);

  const OSensorFrameInfo& Info() const { return *vector_->GetInfo(entry_); }
  longword LastIndex() const { return Info().numFrames - 1; }

  OSensorFrameVectorData* const vector_;
  const Primitives& primitives_;
  int entry_;  ///< of the vector
  int row_;
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_SENSOR_REPORTS_H
