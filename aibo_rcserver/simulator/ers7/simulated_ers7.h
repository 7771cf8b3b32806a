/// @file simulated_ers7.h
/// A simulated Sony Aibo ERS-7 for openr_host::Machine.
///
/// This robot has a camera, 18 joints (joint.h), sensors (sensors.h), LEDs, ears, a battery, microphones and a speaker
/// (speaker_and_microphones.h). It stands in a room and looks at a ball that rolls back and forth (scene.h), or its
/// camera shows photographs (photographs.h). The legs lift and tilt the body, and carry it through the room (travel.h).
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SIMULATED_ERS7_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SIMULATED_ERS7_H

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
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
#include "simulator/ers7/sound/speaker_and_microphones.h"
#include "simulator/ers7/stick_slot.h"
#include "simulator/openr_host/virtual_robot.h"

namespace simulated_ers7 {

struct SimulatedErs7Options {
  /// The robot's model in robot_model.h. An ERS-210 has that robot's joints, sensors, LEDs and ears, but walks on the
  /// ERS-7's legs, and sees through its camera with the neck at rest.
  std::string design = "ERS-7";

  /// True: the robot begins on a table, and may fall off it (scene.h, travel.h).
  bool on_table = false;

  /// Photographs for the camera; if empty, the camera sees the scene.
  std::string images_folder;

  /// How long a full battery lasts, above 0. Sony says about one and a half hours of play.
  double battery_minutes = 90;

  /// WAV file for the sound that the speaker plays; empty for none.
  std::string speaker_file;

  /// Share of the speaker's sound that reaches the microphones, 0..1.
  double hears_itself = 0;

  /// Seed of the noise of camera, joints and sensors. The same seed gives the same images and readings.
  std::uint64_t seed = 1;
};

/// The power button on the back. Objects see it as orsbPAUSE.
constexpr char kPauseButton[] = "pause";

/// The class is not thread-safe; the machine's thread makes all calls.
class SimulatedErs7 : public openr_host::VirtualRobot {
 public:
  using Options = SimulatedErs7Options;

  /// @throw PhotographError, SoundError the text names the folder or file and a remedy
  /// @throw std::invalid_argument there is no such model
  explicit SimulatedErs7(const Options& options = Options());

  std::string design() const override;
  OStatus openPrimitive(const char* locator, OPrimitiveID* id) override;
  OStatus closePrimitive(OPrimitiveID id) override;
  OStatus controlPrimitive(OPrimitiveID id, OPrimitiveRequest request, void* param, size_t param_size, void* result,
                           size_t result_size) override;

  /// The following functions are for joints (joint.h). oprimitiveID_UNDEF means all open joints; if several joints
  /// fail, one of the errors is returned. A primitive that is not open or is not a joint gives oINVALID_PRIMITIVE_ID.
  OStatus setJointGain(OPrimitiveID id, word pg, word ig, word dg, word ps, word is, word ds) override;

  OStatus setDefaultJointGain(OPrimitiveID id) override;
  OStatus enableJointGain(OPrimitiveID id) override;
  OStatus disableJointGain(OPrimitiveID id) override;

  /// The reading at the end of the last frame.
  /// @param id the number of one joint
  OStatus getJointValue(OPrimitiveID id, OJointValue* value) override;

  /// The reading at the end of the last frame.
  OStatus getSensorValue(OPrimitiveID id, OSensorValue* value) override;

  OStatus setMotorPower(OPower power) override;
  OStatus getPowerStatus(OPowerStatus* status) override;
  OStatus getMemoryStickStatus(OMemoryStickStatus* status) override;
  OStatus setCdtVectorData(const OCdtVectorData& tables) override;

  /// Joints keep their positions, but forget their commands. LEDs go out, ears are released, and the camera's settings
  /// are reset. Buttons, battery, memory stick, jammed joints and the robot's place do not change.
  void switchOff() override;

  /// Joints accept odataJOINT_COMMAND2, even without gain (joint.h). LEDs accept odataLED_COMMAND2 or
  /// odataLED_COMMAND3, ears odataJOINT_COMMAND3 or odataJOINT_COMMAND4, depending on their kind in robot_model.h.
  bool takesCommand(OPrimitiveID id, ODataType type) const override;

  /// Lets a frame pass. Commands that are not accepted any more are ignored.
  void passFrame(longword frame, const openr_host::EffectorCommands& commands) override;
  RCRegion* captureSensors(longword frame) override;

  bool cameraImageDue(longword frame) override;
  longword nextCameraImage(longword frame) const override { return imageAfter(frame); }

  /// Takes an image, which shows the view after the last frame that passed.
  RCRegion* captureImage(longword frame) override;

  std::optional<OSpeakerSoundType> soundTypeOf(OPrimitiveID id) const override;
  openr_host::MicrophoneFrame passSound(longword frame, const openr_host::SpeakerFrame* played) override {
    return sound_.passFrame(frame, played);
  }

  /// From now on, the microphones hear this file once, or nothing if it is "silence".
  /// @throw SoundError the file cannot be used
  void hear(const std::string& file);

  const CameraSettings& cameraSettings() const { return camera_.settings(); }

  /// The joints, with their true positions.
  const Joints& joints() const { return joints_; }

  /// The robot's true pose.
  const Place& pose() const { return travel_.place(); }

  /// How the robot stands and moves in the room.
  const Travel& travel() const { return travel_; }
  const Scene& scene() const { return scene_; }

  /// @param name the name in robot_model.h, such as "face_1"
  /// @throw std::invalid_argument there is no such LED
  const Led& led(const std::string& name) const;

  /// @param name the name in robot_model.h, such as "left_ear"
  /// @throw std::invalid_argument there is no such ear
  const Ear& ear(const std::string& name) const;

  /// @param button kPauseButton, or a sensor that can be pressed (Sensors::press())
  /// @throw std::invalid_argument there is no such button
  void press(const std::string& button, bool pressed);

  /// @param charge 0..1
  void setCharge(double charge) { battery_.setCharge(charge); }

  /// These functions do what those of Travel do.
  void lift(bool lifted) { travel_.lift(lifted); }
  void lie(Side side) { travel_.lie(side); }

  StickSlot& stick() { return stick_; }
  const StickSlot& stick() const { return stick_; }

  /// @param joint the joint's name in robot_model.h, such as "head_pan"
  /// @throw std::invalid_argument there is no such joint
  void jam(const std::string& joint, bool jammed) { joints_.named(joint).jam(jammed); }

 private:
  OStatus forJoints(OPrimitiveID id, const std::function<OStatus(Joint&)>& action);
  Joint* openJoint(OPrimitiveID id);
  void obey(const openr_host::EffectorCommand& command);
  void passFrameOfEars();

  const robot_model::RobotModel& model_;
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
  SpeakerAndMicrophones sound_;
  RegionPool sensor_regions_;
  std::unique_ptr<PictureSource> pictures_;
  Camera camera_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SIMULATED_ERS7_H
