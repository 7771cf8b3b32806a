/// @file virtual_robot_audio_comm.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_AUDIO_COMM_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_AUDIO_COMM_H

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "simulator/openr_host/object_description.h"
#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/virtual_robot.h"

namespace openr_host {

/// The system object OVirtualRobotAudioComm: the gates to microphones and speaker (Level2 Reference Guide, pages 44, 62
/// and 63).
///
/// Microphone vectors last 16 ms, as Sony's sample SoundRec says of the ERS-7; the guide says 32 ms for all robots. If
/// the host has delayed the process, several vectors come in one notification, so that no sound is lost.
///
/// The speaker plays vectors one after the other, each from the frame after it came, and asserts READY when a vector
/// has been output. To avoid gaps, an object should first send two vectors, and then one more for each READY.
class VirtualRobotAudioComm : public OObject {
 public:
  static constexpr longword kFramesPerMicrophoneVector = 2;

  static ObjectDescription describe(VirtualRobot& robot);

  explicit VirtualRobotAudioComm(VirtualRobot& robot) : robot_(robot) {}

  OStatus DoInit(const OSystemEvent& event) override;
  OStatus DoStop(const OSystemEvent& event) override;
  OStatus DoDestroy(const OSystemEvent& event) override;

  /// Called when a frame of 8 ms has begun. Frames since the last call are made up.
  void beginFrame(longword frame);

  /// True while each frame matters, because something is played or somebody listens.
  bool isActive() const;

 private:
  /// A vector that is being played, or waits.
  struct Sound {
    SubjectID sender;
    RegionReference region;
    std::vector<sword> samples;  ///< at 16 kHz
    std::size_t next = 0;
  };

  void takeSound(const ONotifyEvent& event);
  std::vector<sword> readSamples(const RCRegion& region) const;
  std::optional<SpeakerFrame> play();
  void hear(longword frame, const MicrophoneFrame& heard);
  bool isListenedTo() const;

  VirtualRobot& robot_;
  std::unique_ptr<SubjectService> microphone_;
  std::unique_ptr<OObserver> speaker_;
  std::deque<Sound> sounds_;
  std::vector<SubjectID> refused_;  ///< senders of a vector that was refused; they get READY in the next frame
  std::vector<OSoundSampleStereo16> heard_;
  std::optional<longword> last_frame_;
  bool is_listened_to_ = false;  ///< true from the moment at which an object is ready until no object wants more
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_OBJECTS_VIRTUAL_ROBOT_AUDIO_COMM_H
