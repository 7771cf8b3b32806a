// The whole server without its sockets: a client sends any bytes in any pieces, while the robot runs.
//
// The first byte says what RCSERVER.CFG allows. Then follow events: a byte for the Event, and its arguments.
#include "rcserver/Session.h"

#include <OPENR/ODataFormats.h>
#include <OPENR/OObserver.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSubject.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <filesystem>
#include <iterator>
#include <optional>

#include "file_keeper/StickFiles.h"
#include "fuzz_input.h"
#include "robot_model/robot_model.h"
#include "simulator/openr_host/objects/object_memory.h"
#include "support/temporary_folder.h"

namespace fs = std::filesystem;
namespace version2 = protocol::version2;

namespace {

openr_host::VectorMemory sound_memory;
std::deque<RCRegion*> played_sound;  // vectors that the speaker has not output yet
bool is_microphone_read = false;

}  // namespace

// OPEN-R's calls need a machine, which this server does not have: its camera takes every setting and every table, and
// its speaker everything. See the link options in CMakeLists.txt.
extern "C" {
OStatus __wrap__ZN8OSubject7SetDataEP8RCRegion(OSubject* /*gate*/, RCRegion* region) {
  region->AddReference();
  played_sound.push_back(region);
  return oSUCCESS;
}
OStatus __wrap__ZN8OSubject15NotifyObserversEv(OSubject* /*gate*/) {
  return oSUCCESS;
}
int __wrap__ZNK8OSubject7IsReadyEv(const OSubject* /*gate*/) {
  return 1;
}
OStatus __wrap__ZN9OObserver11AssertReadyEv(OObserver* /*gate*/) {
  is_microphone_read = true;
  return oSUCCESS;
}
OStatus __wrap__ZN9OObserver13DeassertReadyEv(OObserver* /*gate*/) {
  is_microphone_read = false;
  return oSUCCESS;
}
OStatus __wrap__ZN5OPENR14GetRobotDesignEPc(char* design) {
  std::strcpy(design, "ERS-7");
  return oSUCCESS;
}
OStatus __wrap__ZN5OPENR15GetVolumeSwitchEPh(OVolumeSwitch* volume) {
  *volume = ovolumeSW2;
  return oSUCCESS;
}
OStatus __wrap__ZN5OPENR18NewSoundVectorDataEmmPjPP16OSoundVectorData(std::size_t count, std::size_t size,
                                                                      MemoryRegionID* id, OSoundVectorData** vector) {
  *vector = sound_memory.createSounds(count, size);
  *id = (*vector)->vectorInfo.memRegionID;
  return oSUCCESS;
}
OStatus __wrap__ZN5OPENR21DeleteSoundVectorDataEj(MemoryRegionID id) {
  return sound_memory.destroy(id, odataSOUND_VECTOR) ? oSUCCESS : oINVALID_ARG;
}
OStatus __wrap__ZN5OPENR13OpenPrimitiveEPKcPj(const char* /*locator*/, OPrimitiveID* id) {
  *id = 1;
  return oSUCCESS;
}
OStatus __wrap__ZN5OPENR14ClosePrimitiveEj(OPrimitiveID /*id*/) {
  return oSUCCESS;
}
OStatus __wrap__ZN5OPENR16ControlPrimitiveEjjPvmS0_m(OPrimitiveID /*id*/, OPrimitiveRequest /*request*/,
                                                     void* /*param*/, std::size_t /*param_size*/, void* /*result*/,
                                                     std::size_t /*result_size*/) {
  return oSUCCESS;
}
OStatus __wrap__ZN5OPENR16NewCdtVectorDataEPjPP14OCdtVectorData(MemoryRegionID* id, OCdtVectorData** vector) {
  static OCdtVectorData tables;
  *id = 1;
  *vector = &tables;
  return oSUCCESS;
}
OStatus __wrap__ZN5OPENR16SetCdtVectorDataEj(MemoryRegionID /*id*/) {
  return oSUCCESS;
}
OStatus __wrap__ZN5OPENR19DeleteCdtVectorDataEj(MemoryRegionID /*id*/) {
  return oSUCCESS;
}
}

namespace {

const robot_model::RobotModel& kRobot = *robot_model::findRobotModel("ERS-7");

enum Event {
  BYTES_ARRIVE = 0,
  MANY_BYTES_ARRIVE = 4,
  FRAMES_PASS,
  CAMERA_HAS_IMAGE,
  JOINT_IS_JAMMED,
  CLIENT_GOES,
  COUNT
};

// A memory stick with one motion and one picture.
class SmallMemoryStick : public test_support::TemporaryFolder {
 public:
  SmallMemoryStick() { restore(); }

  void restore() {
    fs::remove_all(path(DATA_FOLDER));
    fs::create_directories(path(DATA_FOLDER));
    fs::copy(MEMORY_STICK "/OPEN-R/MW/DATA/P/NOD.MTN", path(DATA_FOLDER));
    write(std::string(DATA_FOLDER) + "/MINE.JPG", "of mine");
  }
};

class ObedientMotors final : public MotorSwitch {
 public:
  bool AreOn() const override { return on_; }
  bool Switch(bool on) override {
    on_ = on;
    return true;
  }

 private:
  bool on_ = true;
};

// An IPStack that always has an endpoint, and sends nothing.
class FreePorts final : public DatagramSwitch {
 public:
  bool SendTo(const version2::DatagramOrder&) override { return true; }
  void Stop() override {}
  void HandOver() override {}
};

// The system's end of microphone and speaker. It forgets what it has not output when it goes.
class SoundGates {
 public:
  SoundGates() : heard_(1024 + sizeof(OSoundVectorData)) {}
  ~SoundGates() {
    while (outputVector()) {
    }
  }
  SoundGates(const SoundGates&) = delete;
  SoundGates& operator=(const SoundGates&) = delete;

  // False if there is none.
  static bool outputVector() {
    if (played_sound.empty()) {
      return false;
    }
    played_sound.front()->RemoveReference();
    played_sound.pop_front();
    return true;
  }

  // The microphone's next vector, 16 ms. Its values do not matter.
  OSoundVectorData* heardVector(unsigned frame) {
    void* const base = heard_.data();
    auto* const vector = static_cast<OSoundVectorData*>(base);
    vector->info[0].frameNumber = frame;
    vector->info[0].dataOffset = sizeof(OSoundVectorData);
    vector->info[0].dataSize = 1024;
    return vector;
  }

  OSubject speaker;
  OObserver microphone;

 private:
  Bytes heard_;
};

// Does a job on the memory stick only when doJob() is called.
class SlowFiles final : public FileJobs {
 public:
  explicit SlowFiles(const HostSettings& host) : files_(host) {}

  bool IsThere() const override { return true; }
  bool isFree() const { return !has_job_; }
  unsigned Post(FileJob::Operation operation, FileKind kind, const protocol::FileName& name,
                const unsigned char* content, std::size_t size) override {
    require(isFree() || is_for_earlier_client_, "there is only one job at a time");
    if (has_job_) {
      doJob();
    }
    require(size <= sizeof(job_.content), "the content fits");
    has_job_ = true;
    is_for_earlier_client_ = false;
    job_.ticket = ++last_ticket_;
    job_.operation = operation;
    job_.kind = kind;
    std::copy(std::begin(name), std::end(name), job_.name);
    job_.size = size;
    std::copy(content, content + size, job_.content);
    return last_ticket_;
  }
  void ClientGone() override { is_for_earlier_client_ = true; }

  const FileResult& doJob() {
    result_.ticket = job_.ticket;
    result_.outcome = files_.CarryOut(job_, &result_);
    has_job_ = false;
    return result_;
  }

 private:
  StickFiles files_;
  FileJob job_{};
  FileResult result_{};
  bool has_job_ = false;
  bool is_for_earlier_client_ = false;
  unsigned last_ticket_ = 0;
};

Settings settingsOf(unsigned bits) {
  Settings settings;
  settings.allow_upload = (bits & 1U) != 0;
  settings.allow_delete = (bits & 2U) != 0;
  settings.allow_shut_down = (bits & 4U) != 0;
  settings.allow_reboot = (bits & 8U) != 0;
  settings.allow_pictures = (bits & 16U) != 0;
  settings.allow_microphone = (bits & 32U) != 0;
  settings.allow_sound = (bits & 64U) == 0;
  return settings;
}

class Server {
 public:
  Server(const SmallMemoryStick& stick, unsigned setting_bits) : settings_(settingsOf(setting_bits)) {
    host_.memory_stick = stick.path().c_str();
    std::array<int, robot_model::MAX_JOINTS> posture{};
    robot_model::clampPosture(kRobot, posture.data());
    for (int joint = 0; joint < joints_.NumberOfJoints(); ++joint) {
      joints_.Hold(joint, posture[static_cast<std::size_t>(joint)], 0);
    }
    microphone_.Start(&gates_.microphone);
    speaker_.Start(&gates_.speaker);
    session_.Begin();
  }

  void play(FuzzInput& input) {
    switch (const unsigned event = input.takeByte() % COUNT) {
      case FRAMES_PASS:
        passFrames(input.takeByte() % 64);
        break;
      case CAMERA_HAS_IMAGE:
        imageArrives();
        break;
      case JOINT_IS_JAMMED:
        jammed_joint_ = static_cast<int>(input.takeByte()) % (2 * joints_.NumberOfJoints());
        break;
      case CLIENT_GOES:
        clientGoes();
        break;
      default:
        bytesArrive(input.takeBytes(event == MANY_BYTES_ARRIVE ? input.take16() : input.takeByte()));
    }
    answer();
  }

 private:
  // As from the IPStack: no more bytes at once than there is room for.
  void bytesArrive(const Bytes& bytes) {
    for (std::size_t used = 0; used < bytes.size() && session_.WantsInput();) {
      const std::size_t size = std::min(bytes.size() - used, Session::INPUT_CAPACITY);
      const Bytes piece(bytes.begin() + static_cast<std::ptrdiff_t>(used),
                        bytes.begin() + static_cast<std::ptrdiff_t>(used + size));
      session_.AddInput(piece.data(), piece.size());
      used += size;
      answer();
    }
  }

  void passFrames(unsigned count) {
    for (; count > 0; --count) {
      ++now_;
      joints_.NextFrame();
      lights_.NextFrame();
      checkJoints();
      if (now_ % 4 == 0) {
        measure();
      }
      if (now_ % 16 == 0) {
        finishFileJob();
      }
      passSound();
      answer();
    }
  }

  void passSound() {
    if (now_ % 4 == 0 && SoundGates::outputVector()) {
      speaker_.IsReady();
    }
    if (now_ % 2 == 0 && is_microphone_read) {
      session_.Sound().Heard(gates_.heardVector(now_));
      microphone_.AskForMore();
    }
    require(speaker_.Room() <= version2::SPEAKER_CAPACITY, "no more samples wait than there is room for");
    require(settings_.allow_microphone || !microphone_.IsOn(), "nobody hears what the owner does not allow");
  }

  void checkJoints() {
    for (int joint = 0; joint < joints_.NumberOfJoints(); ++joint) {
      const int position = joints_.Planner().Position(joint);
      require(position >= kRobot.joints[joint].lowest && position <= kRobot.joints[joint].highest,
              "a joint stays within its limits");
    }
  }

  void measure() {
    for (int joint = 0; joint < joints_.NumberOfJoints(); ++joint) {
      const int reference = joints_.Planner().Position(joint);
      const int position = joint == jammed_joint_ ? joints_.Position(joint) : reference;
      joints_.Measured(joint, {position, reference, position == reference ? 0 : 512}, now_, motors_.AreOn());
    }
    for (int sensor = 0; sensor < sensors_.NumberOfSensors(); ++sensor) {
      sensors_.Measured(sensor, static_cast<int>(now_) * sensor);
    }
    session_.Measured(now_);
  }

  void imageArrives() {
    ++images_;
    if (session_.Camera().WantsColors(images_)) {
      detectColors();
    }
    PictureOrder order;
    if (!session_.Pictures().ImageArrived(images_, &order)) {
      return;
    }
    require(order.quality <= protocol::MAX_JPEG_QUALITY, "a quality is within its range");
    if (order.purpose == PictureOrder::FOR_STICK) {
      const Bytes jpeg(4500);
      session_.Stick().PictureTaken(jpeg.data(), jpeg.size());
      return;
    }
    const version2::ImageHeader image = {images_,
                                         now_,
                                         208,
                                         160,
                                         order.quality,
                                         static_cast<version2::Layer>(order.layer),
                                         version2::defaultCameraSettings()};
    Bytes header(Session::MAX_PICTURE_HEADER_SIZE);
    require(session_.EncodePictureHeader(order, image, 4500, header.data()) <= header.size(), "a header fits");
  }

  // Some images have no plane.
  void detectColors() {
    constexpr std::size_t kWidth = 104;
    constexpr std::size_t kHeight = 80;
    Bytes plane(kWidth * kHeight);
    for (std::size_t i = 0; i < plane.size(); i += 1 + images_ % 40) {
      plane[i] = static_cast<unsigned char>(i + images_);
    }
    session_.Camera().ColorsDetected({images_ % 8 == 0 ? nullptr : plane.data(), kWidth, kHeight, kWidth}, images_,
                                     now_);
  }

  // Handles requests and sends answers until the session wants input.
  void answer() {
    const bool was_version2 = session_.ExpectsHeartbeat();
    session_.HandleRequests(now_);
    take(was_version2);
    while (!session_.IsOver() && !session_.WantsInput()) {
      finishFileJob();  // a request may wait for it
      session_.HandleRequests(now_);
      take(was_version2);
    }
    if (session_.IsOver()) {
      clientGoes();
    }
  }

  void finishFileJob() {
    if (!files_.isFree()) {
      const FileResult& result = files_.doJob();
      session_.FileDone(result, now_);
      if (session_.Stick().OwesFile()) {
        Bytes header(Session::MAX_PICTURE_HEADER_SIZE);
        require(result.size > 0 && session_.Stick().EncodeFileHeader(result.size, header.data()) <= header.size(),
                "a file has content, and its header fits");
      }
    }
  }

  void take(bool is_version2) {
    output_.resize(Outbox::CAPACITY);
    output_.resize(session_.TakeOutput(output_.data()));
    // An empty outbox has room for an answer to a request, so this loop ends.
    require(!output_.empty() || !files_.isFree() || session_.IsOver() || session_.WantsInput(),
            "a request is answered, or input is wanted");
    if (is_version2) {
      checkFrames();
    }
  }

  // The output consists of whole frames.
  void checkFrames() {
    std::size_t size = 0;
    for (std::size_t at = 0; at < output_.size(); at += size) {
      require(output_.size() - at >= version2::FRAME_HEADER_SIZE, "a header is whole");
      size = version2::FRAME_HEADER_SIZE + version2::decodeFrameHeader(output_.data() + at).payload_size;
      require(output_.size() - at >= size, "a frame is whole");
    }
  }

  void clientGoes() {
    session_.End();
    require(session_.WantsInput() || power_order_ != POWER_STAYS_ON, "the next client is served");
    power_order_ = POWER_STAYS_ON;
    session_.Begin();
  }

  HostSettings host_;
  Settings settings_;
  JointControl joints_{kRobot};
  ObedientMotors motors_;
  SensorDriver sensors_{kRobot};
  LightDriver lights_{kRobot};
  CameraControl camera_{kRobot.number_of_color_channels};
  Microphone microphone_;
  Speaker speaker_;
  SoundGates gates_;
  FreePorts datagrams_;
  PowerOrder power_order_ = POWER_STAYS_ON;
  SlowFiles files_{host_};
  FrameClock clock_;
  Robot robot_{kRobot.design, joints_,  motors_,    sensors_,     lights_, camera_,
               microphone_,   speaker_, datagrams_, power_order_, files_,  clock_};
  Session session_{robot_, settings_, version2::VERSION};
  Bytes output_;
  unsigned now_ = 0;
  unsigned images_ = 0;
  int jammed_joint_ = robot_model::NO_JOINT;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static SmallMemoryStick stick;
  static std::optional<Server> server;  // too large to be allocated each time
  FuzzInput input(data, size);
  const unsigned setting_bits = input.takeByte();
  server.emplace(stick, setting_bits);
  while (!input.empty()) {
    server->play(input);
  }
  if ((setting_bits & 19U) != 0) {  // uploads, deletes or pictures
    stick.restore();
  }
  return 0;
}
