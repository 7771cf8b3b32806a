/// @file CommandVectors.h
/// The memory in which commands go to the joints.
#ifndef RCSERVER_COMMAND_VECTORS_H
#define RCSERVER_COMMAND_VECTORS_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/RCRegion.h>

/// Two command vectors that are used in turn: one is filled while the other is played. Each has one entry a joint, of
/// FRAMES frames of 8 ms. OPEN-R would take 16 frames at once; the fewer, the sooner a new command counts.
class CommandVectors {
 public:
  static const int FRAMES = 4;

  CommandVectors();

  /// @param joints primitives, one an entry
  /// @return false if OPEN-R refuses
  bool Create(const OPrimitiveID* joints, int number_of_joints);
  void Destroy();

  /// The vector that nobody plays.
  /// @return NULL if both are being played
  RCRegion* FindFree();

  /// @param vector from FindFree()
  /// @param frame 0..FRAMES - 1
  /// @param position in microradian
  static void Set(RCRegion* vector, int joint, int frame, int position);

 private:
  static const int NUMBER_OF_VECTORS = 2;

  CommandVectors(const CommandVectors&);
  CommandVectors& operator=(const CommandVectors&);

  MemoryRegionID memories_[NUMBER_OF_VECTORS];
  RCRegion* regions_[NUMBER_OF_VECTORS];
};

#endif  // RCSERVER_COMMAND_VECTORS_H
