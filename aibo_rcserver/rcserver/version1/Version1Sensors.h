/// @file Version1Sensors.h
/// What the robot measures, for a client of version 1.
#ifndef AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_SENSORS_H
#define AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_SENSORS_H

#include "protocol/request_reader.h"
#include "rcserver/body/Sensors.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/version1/Version1Replies.h"

/// Carries out `S`. Pure logic: no OPEN-R. Joints are sensors, too, which measure an angle.
class Version1Sensors {
 public:
  /// All must outlive this.
  Version1Sensors(const JointControl& joints, const Sensors& sensors, Version1Replies& replies);

  /// A new client: the block holds everything.
  void Begin();

  /// @return false: to be refused
  bool Execute(const protocol::Request& request);

 private:
  // One that can be read: a joint or a sensor.
  struct Source {
    unsigned char identifier;
    bool is_joint;
    int index;  ///< in the robot's table
    bool is_in_block;

    bool operator<(const Source& other) const { return identifier < other.identifier; }
  };

  static const int MAX_SOURCES = robot_model::MAX_JOINTS + robot_model::MAX_SENSORS;

  void Add(unsigned char identifier, bool is_joint, int index);
  Source* Find(int identifier);
  short Value(const Source& source) const;
  void ReadBlock();

  const JointControl& joints_;
  const Sensors& sensors_;
  Version1Replies& replies_;
  Source sources_[MAX_SOURCES];  ///< in ascending order of the identifiers
  int number_of_sources_;
};

#endif  // AIBO_RCSERVER_RCSERVER_VERSION1_VERSION1_SENSORS_H
