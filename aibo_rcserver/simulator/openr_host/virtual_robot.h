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

/// The command for one effector in one frame.
struct EffectorCommand {
  OPrimitiveID primitive;
  ODataType type;  ///< such as odataJOINT_COMMAND2; determines which value type of ODataFormats.h `value` holds
  OCommandValue value;
};

using EffectorCommands = std::vector<EffectorCommand>;

/// Most frames that are passed to the robot at once after the host has delayed the process: one second, which is longer
/// than any command vector and quickly made up.
constexpr longword kMostFramesCaughtUp = 125;

/// All calls come from the thread that runs the machine.
class VirtualRobot {
 public:
  virtual ~VirtualRobot() = default;

  /// The model's name as returned by OPENR::GetRobotDesign(), "ERS-7". Also selects the section of OBJECT.CFG.
  virtual std::string design() const = 0;

  /// @name The calls of OPENRAPI.h, which documents the results
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
  virtual OStatus getMemoryStickStatus(OMemoryStickStatus* status) = 0;
  virtual OStatus setCdtVectorData(const OCdtVectorData& tables) = 0;
  /// @}

  /// The machine is switched off, whether it boots again or not: motors and LEDs lose their power, and all primitives
  /// are closed. Called after the objects are destroyed. The next machine boots on the same robot.
  virtual void switchOff() = 0;

  /// Whether the primitive is open and accepts commands of this type. Called for every entry when a command vector
  /// arrives; the answer may be different when the commands are due.
  virtual bool takesCommand(OPrimitiveID id, ODataType type) const = 0;

  /// One frame of 8 ms passes; later calls see the body after it. Called for every frame in turn, even for those that
  /// the host delayed, so that no part of a motion is lost. While nobody could notice, several frames pass at once.
  /// After a delay of more than kMostFramesCaughtUp frames, only this many are passed, the latest ones, and the waiting
  /// commands are played in them.
  /// @param commands of OVirtualRobotComm.Effector for this frame; empty if no object has sent any
  virtual void passFrame(longword frame, const EffectorCommands& commands) = 0;

  /// Reads all sensors and joints into an OSensorFrameVectorData, whose entries contain the four frames up to this one.
  /// Called every fourth frame (32 ms): 3, 7, 11..., and only if an observer of OVirtualRobotComm.Sensor is ready.
  /// After a delay by the host, it is called only for the last of the vectors that were due, right after passFrame() of
  /// its frame. The region belongs to the robot, as with captureImage().
  virtual RCRegion* captureSensors(longword frame) = 0;

  /// Called once per frame, in ascending order, whether or not an observer is ready. After a delay by the host, frames
  /// are left out: an image that was due in one of them is due now.
  virtual bool cameraImageDue(longword frame) = 0;

  /// The earliest frame after this one in which an image may be due.
  virtual longword nextCameraImage(longword frame) const { return frame + 1; }

  /// Takes the image that is due: an OFbkImageVectorData with its pixels in one region. Called only if an observer of
  /// OVirtualRobotComm.FbkImageSensor is ready. The robot keeps its own reference to the region, and may reuse the
  /// region when RCRegion::NumberOfReference() is back to 1.
  virtual RCRegion* captureImage(longword frame) = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_VIRTUAL_ROBOT_H
