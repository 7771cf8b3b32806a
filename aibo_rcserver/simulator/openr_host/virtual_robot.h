/// @file virtual_robot.h
/// The body behind the system object OVirtualRobotComm.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_VIRTUAL_ROBOT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_VIRTUAL_ROBOT_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/RCRegion.h>

#include <string>
#include <vector>

namespace openr_host {

/// What one effector is told to do in one frame.
struct EffectorCommand {
  OPrimitiveID primitive;
  ODataType type;  ///< such as odataJOINT_COMMAND2; says which of the value types of ODataFormats.h lies over `value`
  OCommandValue value;
};

using EffectorCommands = std::vector<EffectorCommand>;

/// Frames that are passed to the robot at once after the host has held the process up: one second, which no command
/// vector outlasts and which costs little to make up for.
constexpr longword kMostFramesCaughtUp = 125;

/// All calls come from the thread that runs the machine.
class VirtualRobot {
 public:
  virtual ~VirtualRobot() = default;

  /// The model's name as OPENR::GetRobotDesign() gives it: "ERS-7". Also the section of OBJECT.CFG that is read.
  virtual std::string design() const = 0;

  /// @name What OPENR::OpenPrimitive() and its like do; their header says what is returned.
  /// @{
  virtual OStatus openPrimitive(const char* locator, OPrimitiveID* id) = 0;
  virtual OStatus closePrimitive(OPrimitiveID id) = 0;
  virtual OStatus controlPrimitive(OPrimitiveID id, OPrimitiveRequest request, void* param, size_t param_size,
                                   void* result, size_t result_size) = 0;
  virtual OStatus setJointGain(OPrimitiveID id, word pg, word ig, word dg, word ps, word is, word ds) = 0;
  virtual OStatus enableJointGain(OPrimitiveID id) = 0;
  virtual OStatus disableJointGain(OPrimitiveID id) = 0;
  virtual OStatus getJointValue(OPrimitiveID id, OJointValue* value) = 0;
  virtual OStatus getSensorValue(OPrimitiveID id, OSensorValue* value) = 0;
  virtual OStatus setMotorPower(OPower power) = 0;
  virtual OStatus getPowerStatus(OPowerStatus* status) = 0;
  /// @}

  /// The machine goes off, whether it boots again or not: motors and LEDs lose their power, all primitives are closed.
  /// Called after the objects are gone, also by Machine::shutdown(); the next machine boots on the same robot.
  virtual void switchOff() = 0;

  /// Whether the primitive is open and an effector that takes commands of this type. Asked of every entry of a command
  /// vector when the vector comes; may have changed when its commands are due.
  virtual bool takesCommand(OPrimitiveID id, ODataType type) const = 0;

  /// One frame of 8 ms passes, and what follows is of the body as it is then. Called for every frame in turn, also for
  /// those in which the host had held the process up, so that no part of a motion is lost. If that was for longer than
  /// kMostFramesCaughtUp frames, only so many are passed, the latest ones, and the commands that waited are played in
  /// these.
  /// @param commands of OVirtualRobotComm.Effector for this frame; none if no object has sent any
  virtual void passFrame(longword frame, const EffectorCommands& commands) = 0;

  /// Reads all sensors and joints: an OSensorFrameVectorData, each entry with the four frames that end with this one.
  /// Called every fourth frame (32 ms): 3, 7, 11..., and only if an observer of OVirtualRobotComm.Sensor is ready. When
  /// the host has held the process up, only the last of the vectors that were due is asked for, right after
  /// passFrame() of its frame. The region is the robot's as with captureImage().
  virtual RCRegion* captureSensors(longword frame) = 0;

  /// Asked once a frame, with growing numbers, whether anybody looks or not. When the host has held the process up,
  /// frames are left out: an image that was due in one of those is due now.
  virtual bool cameraImageDue(longword frame) = 0;

  /// Takes the image that is due: an OFbkImageVectorData and its pixels in one region. Called only if an observer of
  /// OVirtualRobotComm.FbkImageSensor is ready. The robot keeps its own reference to the region, and may draw in it
  /// again when RCRegion::NumberOfReference() is back to 1.
  virtual RCRegion* captureImage(longword frame) = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_VIRTUAL_ROBOT_H
