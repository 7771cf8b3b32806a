/// @file simulated_ers7.h
/// A simulated Sony Aibo ERS-7 for openr_host::Machine.
///
/// It has a camera, 18 joints (joint.h), sensors (sensors.h), LEDs, ears and a battery, but no microphones or
/// loudspeaker. It stands in a room and looks at a ball that rolls to and fro (scene.h), or shows photographs
/// (photographs.h). The head moves the camera; the legs lift and tilt the body and carry it through
/// the room (travel.h).
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SIMULATED_ERS7_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SIMULATED_ERS7_H

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "simulator/ers7/body/battery.h"
#include "simulator/ers7/body/joints.h"
#include "simulator/ers7/body/leds_and_ears.h"
#include "simulator/ers7/body/primitive_table.h"
#include "simulator/ers7/body/sensors.h"
#include "simulator/ers7/body/travel.h"
#include "simulator/ers7/camera/camera.h"
#include "simulator/ers7/region_pool.h"
#include "simulator/ers7/scene/scene.h"
#include "simulator/ers7/stick_slot.h"
#include "simulator/openr_host/virtual_robot.h"

namespace simulated_ers7 {

struct SimulatedErs7Options {
  /// Folder with photographs for the camera to show in turn. If empty, the camera sees the scene.
  std::string images_folder;

  /// How long each photograph is shown, in seconds, above 0.
  double seconds_per_image = 2;

  /// Time until a full battery is empty, above 0. Sony gives about one and a half hours of play.
  double battery_minutes = 90;

  /// Seed of the noise of camera, joints and sensors. The same seed gives the same images and readings.
  std::uint64_t seed = 1;
};

/// The button on the robot's back that switches it on. Objects see it as orsbPAUSE.
constexpr char kPauseButton[] = "pause";

/// Not thread-safe; all calls come from the machine's thread.
class SimulatedErs7 : public openr_host::VirtualRobot {
 public:
  using Options = SimulatedErs7Options;

  /// @throw PhotographError if the photographs cannot be shown; the text names folder or file and a remedy
  explicit SimulatedErs7(const Options& options = Options());

  std::string design() const override;
  OStatus openPrimitive(const char* locator, OPrimitiveID* id) override;
  OStatus closePrimitive(OPrimitiveID id) override;
  OStatus controlPrimitive(OPrimitiveID id, OPrimitiveRequest request, void* param, size_t param_size, void* result,
                           size_t result_size) override;

  /// @name Joints, as in joint.h. `id` may be oprimitiveID_UNDEF, which means all open joints; then one of several
  /// errors is returned. All return oINVALID_PRIMITIVE_ID if the primitive is not open or not a joint.
  /// @{
  OStatus setJointGain(OPrimitiveID id, word pg, word ig, word dg, word ps, word is, word ds) override;

  OStatus enableJointGain(OPrimitiveID id) override;
  OStatus disableJointGain(OPrimitiveID id) override;
  /// @}

  /// The joint's reading at the end of the last frame.
  /// @param id of one joint
  OStatus getJointValue(OPrimitiveID id, OJointValue* value) override;

  /// The sensor's reading at the end of the last frame.
  OStatus getSensorValue(OPrimitiveID id, OSensorValue* value) override;

  OStatus setMotorPower(OPower power) override;
  OStatus getPowerStatus(OPowerStatus* status) override;
  OStatus getMemoryStickStatus(OMemoryStickStatus* status) override;
  OStatus setCdtVectorData(const OCdtVectorData& tables) override;

  /// Joints stay where they are; LEDs go out, ears are let go, and the camera's settings are reset. Buttons, battery,
  /// memory stick, jammed joints and the robot's place do not change.
  void switchOff() override;

  /// Joints accept odataJOINT_COMMAND2, even while their gain is off (joint.h). LEDs accept odataLED_COMMAND2 or
  /// odataLED_COMMAND3, depending on their kind in robot_model.h, ears odataJOINT_COMMAND4.
  bool takesCommand(OPrimitiveID id, ODataType type) const override;

  /// Ignores commands that are no longer accepted.
  void passFrame(longword frame, const openr_host::EffectorCommands& commands) override;
  RCRegion* captureSensors(longword frame) override;

  bool cameraImageDue(longword frame) override;
  longword nextCameraImage(longword frame) const override { return imageAfter(frame); }

  /// The camera is where the head is after the last frame that passed.
  RCRegion* captureImage(longword frame) override;

  const CameraSettings& cameraSettings() const { return camera_.settings(); }

  /// The joints, with their true positions.
  const Joints& joints() const { return joints_; }

  /// Where the robot really is.
  const Place& pose() const { return travel_.place(); }

  /// The state of an LED.
  /// @param name as in robot_model.h, "face_1"
  /// @throw std::invalid_argument if there is no such LED
  const Led& led(const std::string& name) const;

  /// The state of an ear.
  /// @param name as in robot_model.h, "left_ear"
  /// @throw std::invalid_argument if there is no such ear
  const Ear& ear(const std::string& name) const;

  /// Presses or releases a button.
  /// @param button kPauseButton, or a sensor that can be pressed (Sensors::press())
  /// @throw std::invalid_argument if there is no such button
  void press(const std::string& button, bool pressed);

  /// Sets the battery's charge, 0..1.
  void setCharge(double charge) { battery_.setCharge(charge); }

  /// Lifts the robot from the floor or sets it down, makes it fall on a side or puts it back on its feet (travel.h).
  /// @{
  void lift(bool lifted) { travel_.lift(lifted); }
  void lie(Side side) { travel_.lie(side); }
  /// @}

  /// The memory stick in its slot.
  /// @{
  StickSlot& stick() { return stick_; }
  const StickSlot& stick() const { return stick_; }
  /// @}

  /// Blocks or unblocks a joint.
  /// @param joint name as in robot_model.h, "head_pan"
  /// @throw std::invalid_argument if there is no such joint
  void jam(const std::string& joint, bool jammed) { joints_.named(joint).jam(jammed); }

 private:
  OStatus forJoints(OPrimitiveID id, const std::function<OStatus(Joint&)>& action);
  Joint* openJoint(OPrimitiveID id);
  void obey(const openr_host::EffectorCommand& command);
  void passFrameOfEars();

  PrimitiveTable primitives_;
  Joints joints_;
  Scene scene_;
  Sensors sensors_;
  Battery battery_;
  std::vector<Led> leds_;
  std::vector<Ear> ears_;
  StickSlot stick_;
  bool motors_powered_ = false;
  bool pause_pressed_ = false;
  Travel travel_;
  RegionPool sensor_regions_;
  std::unique_ptr<PictureSource> pictures_;
  Camera camera_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SIMULATED_ERS7_H
