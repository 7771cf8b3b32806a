#ifndef AIBO_RCSERVER_RCSERVER_BODY_PRIMITIVES_H
#define AIBO_RCSERVER_RCSERVER_BODY_PRIMITIVES_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/RCRegion.h>
#include <string.h>

#include "rcserver/body/VectorPair.h"
#include "robot_model/robot_model.h"

/// Stands for a robot whose parts cannot be opened: without joints, sensors, LEDs and ears.
const robot_model::RobotModel EMPTY_ROBOT = {"", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};

/// Opens the primitives of a table and finds them again. OPEN-R calls the robot's joints, sensors, LEDs, ears and so on
/// its primitives, and each report and command names one by its id.
class Primitives {
 public:
  static const int MAX_ROWS = 32;

  /// Returned by Find() for a primitive that is not open here.
  static const int NOT_OPEN = -1;

  Primitives();
  ~Primitives() { Close(); }

  /// Opens a primitive. If it does not open, the console names it.
  /// @param row the row in the table, 0..MAX_ROWS - 1
  /// @param name the name for the console
  /// @return false if it does not open
  bool Open(int row, const char* name, const char* locator);

  void Close();

  bool IsOpen(int row) const { return ids_[row] != oprimitiveID_UNDEF; }
  OPrimitiveID Id(int row) const { return ids_[row]; }
  int Find(OPrimitiveID id) const;

 private:
  Primitives(const Primitives&);
  Primitives& operator=(const Primitives&);

  OPrimitiveID ids_[MAX_ROWS];
};

/// Iterates over the reports in a sensor vector that come from the primitives of one table.
class SensorReports {
 public:
  SensorReports(OSensorFrameVectorData* vector, const Primitives& primitives)
      : vector_(vector), primitives_(primitives), entry_(-1), row_(Primitives::NOT_OPEN) {}

  /// Goes to the next report, at the first call to the first one.
  /// @return false if there are no more
  bool Next();

  int Row() const { return row_; }
  longword Frame() const { return Info().frameNumber + LastIndex(); }

  /// The report's value for that frame.
  /// @param[out] value OJointValue of a joint, OSensorValue of a sensor
  template <typename Value>
  void Read(Value* value) const {
    memcpy(value, &vector_->GetData(entry_)->frame[LastIndex()], sizeof(*value));
  }

 private:
  const OSensorFrameInfo& Info() const { return *vector_->GetInfo(entry_); }
  longword LastIndex() const { return Info().numFrames - 1; }

  OSensorFrameVectorData* const vector_;
  const Primitives& primitives_;
  int entry_;  ///< index in the vector
  int row_;
};

/// Command vectors. Each covers FRAMES frames of 8 ms. OPEN-R takes up to 16 frames in a vector, but with fewer frames
/// a new command takes effect sooner.
class CommandVectors : public VectorPair {
 public:
  static const int FRAMES = 4;

  CommandVectors();

  /// @param most_entries the most entries in a vector, one for each commanded primitive
  /// @return false if OPEN-R refuses
  bool Create(int most_entries);

  /// Removes all entries.
  /// @param vector from Next()
  static void Clear(RCRegion* vector);

  /// Adds an entry.
  /// @param vector from Next()
  /// @param type such as odataJOINT_COMMAND2
  /// @param frames 1..FRAMES
  /// @return the memory for the commands, one for each frame
  static OCommandData* Add(RCRegion* vector, ODataType type, OPrimitiveID primitive, int frames);
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_PRIMITIVES_H
