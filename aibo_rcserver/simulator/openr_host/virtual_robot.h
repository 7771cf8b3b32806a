/// @file virtual_robot.h
/// The body behind the system object OVirtualRobotComm.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_VIRTUAL_ROBOT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_VIRTUAL_ROBOT_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/RCRegion.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace openr_host {

/// A command to one effector in one frame.
struct EffectorCommand {
  OPrimitiveID primitive;
  ODataType type;  ///< such as odataJOINT_COMMAND2; determines the type of `value` (ODataFormats.h)
  OCommandValue value;
};

using EffectorCommands = std::vector<EffectorCommand>;

/// The most frames that pass at once after the host has delayed the process. A second is longer than any command
/// vector, and quickly made up for.
constexpr longword kMostFramesCaughtUp = 125;

/// 8 ms of sound at 16 kHz, one channel or two.
constexpr std::size_t kSamplesPerFrame = 128;
using SpeakerFrame = std::array<sword, kSamplesPerFrame>;
using MicrophoneFrame = std::array<OSoundSampleStereo16, kSamplesPerFrame>;

/// A robot for the machine. The thread that runs the machine makes all calls.
class VirtualRobot {
 public:
  virtual ~VirtualRobot() = default;

  /// The result of OPENR::GetRobotDesign(): "ERS-7". It also selects lines of OBJECT.CFG.
  virtual std::string design() const = 0;

  /// The calls of OPENRAPI.h, where their results are documented.
  virtual OStatus openPrimitive(const char* locator, OPrimitiveID* id) = 0;
  virtual OStatus closePrimitive(OPrimitiveID id) = 0;
  virtual OStatus controlPrimitive(OPrimitiveID id, OPrimitiveRequest request, void* param, size_t param_size,
                                   void* result, size_t result_size) = 0;
  virtual OStatus setJointGain(OPrimitiveID id, word pg, word ig, word dg, word ps, word is, word ds) = 0;
  virtual OStatus setDefaultJointGain(OPrimitiveID /*id*/) { return oNOT_SUPPORTED; }
  virtual OStatus enableJointGain(OPrimitiveID id) = 0;
  virtual OStatus disableJointGain(OPrimitiveID id) = 0;
  virtual OStatus getJointValue(OPrimitiveID id, OJointValue* value) = 0;
  virtual OStatus getSensorValue(OPrimitiveID id, OSensorValue* value) = 0;
  virtual OStatus setMotorPower(OPower power) = 0;
  virtual OStatus getPowerStatus(OPowerStatus* status) = 0;
  virtual OStatus getMemoryStickStatus(OMemoryStickStatus* status) = 0;
  virtual OStatus setCdtVectorData(const OCdtVectorData& tables) = 0;

  /// What OPENR::GetVolumeSwitch() reads.
  virtual OVolumeSwitch volumeSwitch() const { return ovolumeSW3; }

  /// The kind of sound that the speaker takes; empty if the primitive is not an open speaker.
  virtual std::optional<OSpeakerSoundType> soundTypeOf(OPrimitiveID /*id*/) const { return std::nullopt; }

  /// Plays and hears for 8 ms. While something is played or somebody listens, this is called for each frame in turn.
  /// @param played null while nothing is played
  virtual MicrophoneFrame passSound(longword /*frame*/, const SpeakerFrame* /*played*/) { return {}; }

  /// Called when the machine is switched off, after the objects are destroyed. Motors and LEDs lose power, and all
  /// primitives are closed. The next machine boots on the same robot.
  virtual void switchOff() = 0;

  /// True if the primitive is open and accepts commands of this type. This is called for every entry when a command
  /// vector arrives. The answer may change until the commands are due.
  virtual bool takesCommand(OPrimitiveID id, ODataType type) const = 0;

  /// Called when a frame of 8 ms passes. Later calls see the body after that frame. Every frame passes in turn, even if
  /// the host was delayed, so no part of a motion is lost. Several pass at once while nobody could notice. After a
  /// delay of more than kMostFramesCaughtUp frames, only the latest ones pass, and waiting commands are played in them.
  /// @param commands the commands from OVirtualRobotComm.Effector for this frame; may be empty
  virtual void passFrame(longword frame, const EffectorCommands& commands) = 0;

  /// Reads all sensors and joints into an OSensorFrameVectorData, whose entries have the four frames up to this one.
  /// This is called in every fourth frame (3, 7, 11...) if an observer of OVirtualRobotComm.Sensor is ready. After a
  /// delay of the host, it is called only for the last vector that was due, right after passFrame() of its frame. The
  /// region belongs to the robot, as with captureImage().
  virtual RCRegion* captureSensors(longword frame) = 0;

  /// Called once per frame, in ascending order, even if no observer is ready. After a delay of the host, some frames
  /// are left out. An image that was due in one of them is due now.
  virtual bool cameraImageDue(longword frame) = 0;

  /// The earliest later frame in which an image may be due.
  virtual longword nextCameraImage(longword frame) const { return frame + 1; }

  /// Takes the image that is due: an OFbkImageVectorData with its pixels, in one region. This is called if an observer
  /// of OVirtualRobotComm.FbkImageSensor is ready. The robot keeps its own reference, and may reuse the region when
  /// RCRegion::NumberOfReference() is back to 1.
  virtual RCRegion* captureImage(longword frame) = 0;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_VIRTUAL_ROBOT_H
