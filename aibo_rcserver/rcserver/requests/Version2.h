/// @file Version2.h
/// What the server does for a client of version 2 of the protocol.
#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_VERSION2_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_VERSION2_H

#include "protocol/hello.h"
#include "protocol/version2.h"
#include "protocol/walk_requests.h"
#include "rcserver/Outbox.h"
#include "rcserver/camera/ColorCounter.h"
#include "rcserver/camera/ImageObserver.h"
#include "rcserver/requests/FileOrder.h"
#include "rcserver/requests/MotionCommands.h"
#include "rcserver/requests/Robot.h"
#include "rcserver/settings/Settings.h"

/// Carries out the requests of version 2, answers them, and pushes telemetry, colours and faults (docs/protocol.md).
class Version2 {
 public:
  /// All must outlive this.
  Version2(const Robot& robot, const Settings& settings, FileOrder& files, MotionCommands& motions,
           ImageObserver& camera, Outbox& outbox);

  /// A new client: no telemetry is pushed.
  void Begin() { client_ = Client(); }

  /// Carries out a request and adds at most one reply to the outbox. FileDone() answers a request that needs the memory
  /// stick. A request for a picture is answered by the picture.
  /// @param payload as many bytes as the header says
  /// @param now the present OPEN-R frame
  void Handle(const protocol::version2::FrameHeader& request, const unsigned char* payload, unsigned now);

  /// Answers the request that has been waiting for the memory stick.
  /// @param result that the FileOrder awaits
  /// @param now the present OPEN-R frame
  void FileDone(const FileResult& result, unsigned now);

  /// The picture of an order for the memory stick has been made.
  void PictureTaken(const unsigned char* jpeg, size_t size);

  /// True if the file of the last FileDone() must be sent, after EncodeFileHeader().
  bool OwesFile() const { return client_.owes_file; }

  /// Writes the header of the frame that carries the file. The file is then no longer owed.
  /// @param[out] out room for FRAME_HEADER_SIZE bytes
  size_t EncodeFileHeader(size_t size, unsigned char* out);

  /// Answers a request whose payload is larger than MAX_PAYLOAD_TOWARDS_ROBOT.
  void RefuseTooLarge(const protocol::version2::FrameHeader& request);

  /// Tells the client why the robot goes off, if there is room in the outbox.
  void PushPowerOff(const char* reason);

  /// Pushes an empty `h`, if there is room in the outbox. The client answers at once.
  /// @return false if there is no room
  bool AskForSign();

  /// True if the client has switched on colour detection and this image is due.
  bool WantsColors(unsigned image_count) const {
    return client_.detects_colors &&
           (!client_.has_pushed_colors || image_count - client_.last_colors >= client_.colors.every_nth_image);
  }

  /// Pushes the colours detected in an image. Call it only if WantsColors(). If the camera has no such plane, an error
  /// is pushed once instead.
  /// @param frame in which the image was taken
  void ColorsDetected(const ColorPlane& plane, unsigned image_count, unsigned frame);

  /// Pushes sound from the microphone, if the client listens.
  void Heard(OSoundVectorData* vector);

  /// Pushes the reports of joints, motions, the walk and sounds, as far as the outbox has room.
  void PushReports();

  /// Call when all joints have been measured. Pushes reports, and telemetry if it is due.
  /// @param frame in which they were measured
  void Measured(unsigned frame);

 private:
  Version2(const Version2&);
  Version2& operator=(const Version2&);

  /// @name Messages. Payload() is where the payload of the next one goes
  /// @{
  unsigned char* Payload() { return message_ + protocol::version2::FRAME_HEADER_SIZE; }
  size_t Frame(char kind, unsigned char id, unsigned short request_number, size_t payload_size);
  void FinishReply(size_t payload_size);
  void Send(char kind, unsigned short request_number, const unsigned char* payload, size_t size);
  template <typename Content>
  void Reply(const Content& content) {
    FinishReply(encode(content, Payload()));
  }
  template <typename Content>
  void Send(char kind, unsigned short request_number, const Content& content) {
    unsigned char payload[protocol::version2::MAX_END_MESSAGE_SIZE];
    Send(kind, request_number, payload, encode(content, payload));
  }
  void Refuse(unsigned short code, const char* text);
  void SendEnd(unsigned char what, unsigned char how, unsigned short order, const char* name, const char* reason);
  void SendError(unsigned short request_number, unsigned short code, const char* text);
  /// @}

  /// A request that this server knows.
  struct Row {
    const protocol::version2::Request* request;
    void (Version2::*carry_out)();
    bool Settings::*is_allowed;  ///< NULL: always
  };
  static const Row ROWS[];

  bool Serves(const Row& row) const;
  bool IsAllowed(bool Settings::*setting, const char* name);
  void Execute();

  /// Carries out the request with this letter. Each request is a specialisation that is listed in ROWS.
  template <char LETTER>
  void CarryOut();

  /// Reads the payload of the request, or refuses it.
  template <typename Content>
  bool Decode(Content* content) {
    return IsWellFormed(protocol::version2::decode(payload_, request_.payload_size, content));
  }
  bool IsWellFormed(const char* problem);
  bool HasNoPayload();

  bool MakesLayer(protocol::version2::Layer layer);
  bool ArePositive(const protocol::version2::SpeedLimits& limits);
  bool HasJoints(const protocol::version2::JointValue* joints, int count);
  bool HasJoint(int identifier);
  void RefuseMissing(const char* part, int identifier);
  void HoldJoints();
  bool MayTake(protocol::version2::Posture posture);
  bool IsTooOld(unsigned not_after);
  bool SetEar(int identifier, bool draw);
  void SwitchColors(bool on, const protocol::version2::ColorSettings& settings);
  void LoadColorTable();
  void SetMicrophone();
  void PlaySound();
  void SetSpeakerVolume();
  void GoOff(PowerOrder order);
  bool LeavesOutMissingJoints() const;
  void EndWaitingMotion(const protocol::MotionName& name, const char* why);
  bool IsStickFree();
  FileOrder::Outcome OrderPicture();
  void MotionJobDone(const FileResult& result);
  void PictureJobDone(const FileResult& result);
  void Answer(FileOrder::Outcome outcome);

  void PushJointFaults();
  void PushRecoveries();
  void PushEnds();
  void PushFall();
  void PushSoundEnds();
  void PushMotorsAndPosture();
  void PushTelemetry(unsigned frame);

  static unsigned char JpegQuality(unsigned char id);

  static const protocol::MotionName ALL_MOTIONS;
  static const char TOO_MANY_OWED[];

  // What the client has asked for and was told. Everything is 0 for a new one.
  struct Client {
    bool owes_file;        ///< pending_ must be answered with a file
    bool has_told_motors;  ///< told has been pushed
    protocol::version2::MotorsAndPosture told;
    unsigned short telemetry_period;  ///< in frames; 0: no telemetry
    unsigned char content;            ///< bits of TelemetryContent that are pushed
    bool has_pushed_telemetry;        ///< since the period was set
    unsigned last_telemetry;          ///< frame in which telemetry was last pushed
    bool detects_colors;
    protocol::version2::ColorSettings colors;  ///< valid while detects_colors
    bool has_pushed_colors;                    ///< since colors was set
    unsigned last_colors;                      ///< image count of the last image whose colours were pushed
  };

  const Robot& robot_;
  const Settings& settings_;
  FileOrder& files_;
  MotionCommands& motions_;
  ImageObserver& camera_;
  Outbox& outbox_;
  char capabilities_[protocol::version2::MAX_HELLO_TEXT_SIZE + 1];
  protocol::version2::FrameHeader request_;  ///< the request that is being handled
  const unsigned char* payload_;             ///< of the request
  unsigned now_;                             ///< the present OPEN-R frame
  protocol::version2::FrameHeader pending_;  ///< the request that waits for the memory stick; kind 0: it has ended
  unsigned play_not_after_;                  ///< of a `P` that waits
  unsigned char message_[Outbox::MAX_COLORS_SIZE];  ///< the message that is being written
  Client client_;
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_VERSION2_H
