/// @file CommandVectors.h
/// The memory in which commands go to the joints.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_COMMAND_VECTORS_H
#define AIBO_RCSERVER_RCSERVER_BODY_COMMAND_VECTORS_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/RCRegion.h>

/// Two command vectors that are used in turn: one is filled while the other is output. Each is for FRAMES frames of 8
/// ms. OPEN-R would take 16 frames at once; the fewer, the sooner a new command counts.
class CommandVectors {
 public:
  static const int FRAMES = 4;
  static const int NUMBER_OF_VECTORS = 2;

  CommandVectors();

  /// @param most_entries that a vector can have, one for each primitive that is commanded
  /// @return false if OPEN-R refuses
  bool Create(int most_entries);
  void Destroy();

  /// A vector that is not on its way.
  /// @return NULL if both are
  RCRegion* FindFree();

  /// Takes all entries out.
  /// @param vector from FindFree()
  static void Clear(RCRegion* vector);

  /// Adds an entry.
  /// @param vector from FindFree()
  /// @param type such as odataJOINT_COMMAND2
  /// @param frames 1..FRAMES
  /// @return where the commands go, one a frame
  static OCommandData* Add(RCRegion* vector, ODataType type, OPrimitiveID primitive, int frames);

 private:
  CommandVectors(const CommandVectors&);
  CommandVectors& operator=(const CommandVectors&);

  MemoryRegionID memories_[NUMBER_OF_VECTORS];
  RCRegion* regions_[NUMBER_OF_VECTORS];
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_COMMAND_VECTORS_H
