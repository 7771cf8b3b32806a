/// Version 2 of RCServer's wire protocol. C++98, no I/O, no memory of its own. docs/protocol.md describes the protocol.
///
/// A client requests version 2 in version 1 (versionRequest()). After the server's consent (versionReply()) both sides
/// send only frames: a header of 8 bytes, then a payload whose layout depends on the kind in the header. Integers are
/// big-endian, angles are in microradians, times on the robot are in OPEN-R frames of 8 ms. Numbers whose source is not
/// named are our choice.
///
/// encode() and decode() in fields.h convert each payload struct. Its visit() shows the layout, and so does
/// docs/protocol.md. The request's row (request.h) is next to its payload. Other headers have more payloads: hello.h,
/// motion_requests.h, walk_requests.h, camera_settings.h, color_requests.h, picture_datagram.h, stick_pictures.h and
/// sound_requests.h.
#ifndef AIBO_RCSERVER_PROTOCOL_VERSION2_H
#define AIBO_RCSERVER_PROTOCOL_VERSION2_H

#include <stddef.h>

#include "protocol/camera_settings.h"
#include "protocol/fields.h"
#include "protocol/request.h"
#include "protocol/version1.h"

namespace protocol {
namespace version2 {

const unsigned char VERSION = 2;

/// The version 1 request for version 2: {`X`, 2}.
BasicGetCommand versionRequest();

/// The version 1 reply that agrees: {`x`, 2, 0, 0}. Frames follow it.
ValueReply versionReply();

/// True if the reply agrees to version 2. After any other answer, the connection stays at version 1.
bool agreesToVersion2(const ValueReply& reply);

struct FrameHeader {
  char kind;  ///< capital letter: request; small letter: reply or push
  /// JPEG quality for `F`, `W` and `M`; TelemetryContent bits for `T`, HoldScope for `I`, CameraSetting for `G`,
  /// ColorOrder for `Z`, SoundPart for `A`, SteeringOption bits for `S`, Posture for `E`, StickPictureRequest for `Y`,
  /// a bit for `U` and `P`; otherwise 0.
  unsigned char id;
  unsigned short request_number;  ///< 1..65535 in a request and its reply, 0 in a push
  unsigned payload_size;          ///< bytes

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(kind);
    fields.number(id);
    fields.number(request_number);
    fields.number(payload_size);
  }
};

const size_t FRAME_HEADER_SIZE = 8;

const size_t MAX_PAYLOAD_TOWARDS_CLIENT = 256 * 1024;
const size_t MAX_PAYLOAD_TOWARDS_ROBOT = 64 * 1024;

/// Decodes a header. It does not check the payload size; FrameReader does.
FrameHeader decodeFrameHeader(const unsigned char* in);

const char REQUEST_HELLO = 'H';         ///< hello and heartbeat; no payload; the reply's is in hello.h. An empty `h`
                                        ///< (number 0) is pushed to ask for it
const char REQUEST_PICTURE = 'F';       ///< one picture, id = JPEG quality; the reply is the picture
const char REQUEST_STREAM = 'W';        ///< stream on or off, id = JPEG quality; pushes pictures
const char REQUEST_JOINTS = 'J';        ///< moves joints; the reply has the accepted targets
const char REQUEST_SPEED_LIMITS = 'V';  ///< sets or reads speed limits of joints; the reply has those in force
const char REQUEST_TELEMETRY = 'T';     ///< telemetry period; the reply has the period in force; pushes values
const char REQUEST_MOTORS = 'O';        ///< switches the motors, or reads their state; the reply has the state
const char REQUEST_HOLD = 'I';          ///< stops joints and what moves them, id = HoldScope; the reply has no payload
const char REQUEST_LEDS = 'L';          ///< sets LEDs; the reply has the accepted values
const char REQUEST_EARS = 'K';          ///< draws ears or lets them go; the reply has their new state
const char REQUEST_DATAGRAMS = 'B';     ///< pictures by UDP (picture_datagram.h); the reply has the same payload
const char REQUEST_UPLOAD = 'U';        ///< stores a motion; for U, D, P and N see motion_requests.h
const char REQUEST_DELETE = 'D';        ///< deletes a motion
const char REQUEST_PLAY = 'P';          ///< plays or stops a motion
const char REQUEST_LIST = 'N';          ///< lists the motions on the robot
const char REQUEST_SAVE_PICTURE = 'M';  ///< takes a picture onto the memory stick, id = quality; the reply has its name
const char REQUEST_PICTURES = 'Y';      ///< lists, fetches or deletes pictures; id = StickPictureRequest
const char REQUEST_STEER = 'S';         ///< walks; the reply has the velocity in force (walk_requests.h)
const char REQUEST_POSTURE = 'E';       ///< takes a posture, id = Posture; the reply comes when it begins
const char REQUEST_SHUT_DOWN = 'Q';     ///< motors off, then shut down; nothing follows the reply
const char REQUEST_REBOOT = 'R';        ///< motors off, then reboot; nothing follows the reply

const char PICTURE = 'f';                  ///< a picture: the reply to `F`, or pushed
const char TELEMETRY_PUSH = 't';           ///< measured values (request_number 0), or the reply to `T`
const char END_PUSH = 'i';                 ///< something has ended on the robot
const char MOTORS_AND_POSTURE_PUSH = 'o';  ///< pushed (request_number 0); the reply to `O` has no posture
const char ERROR_MESSAGE = 'e';  ///< a refusal; if pushed: a joint's fault, a power event, or why the connection closes

/// The value of not_after for an order that is never too old. It is for programs that a person watches.
const unsigned NEVER_TOO_OLD = 0xffffffffu;

/// True if an order is too old to be carried out.
/// @param not_after the last frame in which it may be carried out, or NEVER_TOO_OLD
/// @param present the robot's present frame; frames may overflow
bool isTooOld(unsigned not_after, unsigned present);

/// The not_after of an order that may be carried out in this frame and for so many more. It is never NEVER_TOO_OLD.
unsigned notAfter(unsigned present, int frames);

/// The small letter of the request.
char replyKind(char request_kind);

/// True for an error, which has at least its code. A successful reply to `E` is an `e`, too, but has no payload.
bool isError(char kind, size_t payload_size);

/// The quality that means the server's own default. Other numbers above MAX_JPEG_QUALITY mean MAX_JPEG_QUALITY.
const unsigned char SERVER_DEFAULT_QUALITY = 255;

/// The camera's layers, in OPEN-R's numbering, and the double resolution that the server computes from them.
enum Layer { LAYER_HIGH = 0, LAYER_MIDDLE = 1, LAYER_LOW = 2, LAYER_DOUBLE = 3 };

template <typename Fields>
void visitLayer(Fields& fields, Layer& layer) {
  fields.choice(layer, LAYER_DOUBLE, "the layer is not 0 (H), 1 (M), 2 (L) or 3 (double)");
}

/// The payload of a request or reply that has none.
struct NoPayload {
  template <typename Fields>
  void visit(Fields& /*fields*/) {}
};

const Request SAY_HELLO = {REQUEST_HELLO, "say hello", 0, NULL};

/// Payload of `F`.
struct PictureRequest {
  Layer layer;

  template <typename Fields>
  void visit(Fields& fields) {
    visitLayer(fields, layer);
  }
};

const Request TAKE_PICTURE = {REQUEST_PICTURE, "take a picture", 0, NULL};

/// Payload of `W` and its reply.
struct StreamSettings {
  bool on;
  Layer layer;
  unsigned short every_nth_image;  ///< 1 = every image, 2 = every other one; never 0

  template <typename Fields>
  void visit(Fields& fields) {
    fields.flag(on, "the stream is neither off (0) nor on (1)");
    visitLayer(fields, layer);
    fields.number(every_nth_image);
    fields.require(every_nth_image != 0, "the image interval is 0; 1 means every image");
  }
};

const Request STREAM_PICTURES = {REQUEST_STREAM, "stream pictures", 0, NULL};

/// A joint and its target or speed limit.
struct JointValue {
  unsigned char id;
  int value;  ///< microradian, or microradian/s

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(id);
    fields.zeros(3);
    fields.number(value);
  }
};

/// The most joints in a payload. An ERS-7 and an ERS-210 have 18 servos.
const size_t MAX_JOINTS = 32;
extern const char TOO_MANY_JOINTS[];
extern const char JOINT_TWICE[];

/// Payload of the reply to `J`. No id may repeat.
struct JointTargets {
  unsigned short duration_ms;  ///< when all joints arrive; 0 means that each moves as fast as its limits allow
  unsigned char count;         ///< 0..MAX_JOINTS
  JointValue joints[MAX_JOINTS];

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(duration_ms);
    fields.number(count);
    fields.zeros(1);
    fields.list(joints, count, MAX_JOINTS, TOO_MANY_JOINTS);
    fields.once(joints, count, JOINT_TWICE);
  }
};

/// Payload of `J`.
struct JointOrder {
  unsigned not_after;  ///< frame (isTooOld())
  JointTargets targets;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(not_after);
    fields.item(targets);
  }
};

const Request MOVE_JOINTS = {REQUEST_JOINTS, "move joints", 0, NULL};

/// Payload of `V` and its reply. No id may repeat. An empty request reads all limits.
struct SpeedLimits {
  unsigned char count;  ///< 0..MAX_JOINTS
  JointValue joints[MAX_JOINTS];

  template <typename Fields>
  void visit(Fields& fields) {
    fields.rest(joints, count, MAX_JOINTS, TOO_MANY_JOINTS);
    fields.once(joints, count, JOINT_TWICE);
  }
};

const Request LIMIT_SPEEDS = {REQUEST_SPEED_LIMITS, "limit the speed of joints", 0, NULL};

/// What telemetry contains besides positions, sensors and the walk: bits of the id of `T`. The reply repeats the bits
/// that the server knows.
enum TelemetryContent { TELEMETRY_PLAIN = 0, TELEMETRY_WITH_DUTY = 1 };

/// Payload of `T` and its reply.
struct TelemetryPeriod {
  unsigned short frames;  ///< of 8 ms; 0 = off

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(frames);
  }
};

const Request SEND_TELEMETRY = {REQUEST_TELEMETRY, "send telemetry", 0, NULL};

const char GROUP_JOINT = 'J';   ///< a position in microradian
const char GROUP_SENSOR = 'S';  ///< millionths of the sensor's SI unit; a switch is 0 or 1
const char GROUP_DUTY = 'D';    ///< a motor's duty, in millionths of full duty; only with TELEMETRY_WITH_DUTY
const char GROUP_WALK = 'W';    ///< the robot's walk (walk_requests.h), if it can walk

struct TelemetryEntry {
  char group;  ///< a GROUP_ constant
  unsigned char id;
  int value;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(group);
    fields.require(group == GROUP_JOINT || group == GROUP_SENSOR || group == GROUP_DUTY || group == GROUP_WALK,
                   "the group of a value is not one of J, S, D and W");
    fields.number(id);
    fields.zeros(2);
    fields.number(value);
  }
};

/// The most values in a push. An ERS-7 has 18 joints and about 20 sensors.
const size_t MAX_TELEMETRY_ENTRIES = 128;

/// Payload of a pushed `t`.
struct Telemetry {
  unsigned frame_number;  ///< the OPEN-R frame (8 ms) of the measurement
  unsigned short count;   ///< 0..MAX_TELEMETRY_ENTRIES
  TelemetryEntry entries[MAX_TELEMETRY_ENTRIES];

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(frame_number);
    fields.number(count);
    fields.zeros(2);
    fields.list(entries, count, MAX_TELEMETRY_ENTRIES, "more values than any robot measures");
  }
};

const size_t MAX_TELEMETRY_SIZE = 8 + MAX_TELEMETRY_ENTRIES * 8;

/// Payload of `O`. An empty request reads the state.
struct MotorOrder {
  unsigned not_after;  ///< frame (isTooOld()); ignored if the motors are switched off
  bool on;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(not_after);
    fields.flag(on, "the motors are neither off (0) nor on (1)");
  }
};

/// Payload of the reply to `O`.
struct MotorState {
  bool on;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.flag(on, "the motors are neither off (0) nor on (1)");
  }
};

const Request TELL_OF_MOTORS = {REQUEST_MOTORS, "report the state of its motors", 0, NULL};
const Request SWITCH_MOTORS_ON = {REQUEST_MOTORS, "switch the motors on", TAKES_OVER_JOINTS, NULL};
const Request SWITCH_MOTORS_OFF = {REQUEST_MOTORS, "switch the motors off", STOPS_ROBOT | ENDS_WALK, NULL};

/// The robot's posture. `E` can ask for some of them (canTake()). A receiver must accept unknown values.
enum Posture {
  POSTURE_UNKNOWN = 0,  ///< none of the others
  POSTURE_STAND = 1,
  POSTURE_SIT = 2,
  POSTURE_REST = 3,  ///< the robot lies; if `E` asks for it, the robot lies down, then switches its motors off
  POSTURE_WALK = 4,
  POSTURE_FALLEN = 5,  ///< the robot lies on its side or back
  POSTURE_CARRIED = 6
};

/// Payload of a pushed `o`. A client gets this message soon after its first request and at each change.
struct MotorsAndPosture {
  bool motors_on;
  unsigned char posture;  ///< a Posture

  template <typename Fields>
  void visit(Fields& fields) {
    fields.flag(motors_on, "the motors are neither off (0) nor on (1)");
    fields.number(posture);
    fields.zeros(2);
  }
};

/// The id of `I`.
enum HoldScope {
  HOLD_EVERYTHING = 0,  ///< everything that moves; no payload
  HOLD_JOINTS = 1       ///< the joints in the payload
};

/// Payload of `I` for some joints. No id may repeat.
struct JointIds {
  unsigned char count;  ///< 1..MAX_JOINTS
  unsigned char ids[MAX_JOINTS];

  template <typename Fields>
  void visit(Fields& fields) {
    fields.rest(ids, count, MAX_JOINTS, TOO_MANY_JOINTS);
    fields.require(count > 0, "no joint is named");
    fields.once(ids, count, JOINT_TWICE);
  }
};

const Request HOLD = {REQUEST_HOLD, "hold its joints", STOPS_ROBOT | ENDS_WALK, NULL};

/// Modes of LEDs, with Sony's names. Their effect depends on the robot.
enum LedMode { LED_MODE_A = 0, LED_MODE_B = 1 };

struct LedValue {
  unsigned char id;
  unsigned char intensity;  ///< 0..255; an LED without levels is on unless this is 0
  LedMode mode;             ///< ignored by an LED without levels

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(id);
    fields.number(intensity);
    fields.choice(mode, LED_MODE_B, "the mode of an LED is neither 0 (A) nor 1 (B)");
    fields.zeros(1);
  }
};

/// The most LEDs in a payload. An ERS-7 has 26.
const size_t MAX_LEDS = 32;

/// Payload of `L` and its reply. No id may repeat.
struct LedValues {
  unsigned char count;  ///< 0..MAX_LEDS
  LedValue leds[MAX_LEDS];

  template <typename Fields>
  void visit(Fields& fields) {
    fields.rest(leds, count, MAX_LEDS, "more LEDs than any robot has");
    fields.once(leds, count, "an LED is named twice");
  }
};

const Request SET_LEDS = {REQUEST_LEDS, "set LEDs", 0, NULL};

/// Payload of `K` and its reply.
struct EarPositions {
  bool left;   ///< in a request: draw the ear; in a reply: the ear is drawn
  bool right;  ///< the same for the right ear

  template <typename Fields>
  void visit(Fields& fields) {
    fields.flag(left, "an ear is neither drawn (1) nor released (0)");
    fields.flag(right, "an ear is neither drawn (1) nor released (0)");
  }
};

const Request MOVE_EARS = {REQUEST_EARS, "move the ears", 0, NULL};

const Request SHUT_DOWN = {REQUEST_SHUT_DOWN, "shut down", 0, "ALLOW_SHUT_DOWN"};
const Request REBOOT = {REQUEST_REBOOT, "reboot", 0, "ALLOW_REBOOT"};

/// The payload of `f` before the JPEG.
struct ImageHeader {
  unsigned image_count;     ///< the camera's own counter, of which a robot may use only the low 16 bits
  unsigned frame_number;    ///< the OPEN-R frame (8 ms) of the image
  unsigned short width;     ///< pixels, never 0
  unsigned short height;    ///< pixels, never 0
  unsigned char quality;    ///< JPEG quality, 0..MAX_JPEG_QUALITY
  Layer layer;              ///< the layer that the picture was made from
  CameraSettings settings;  ///< the settings in force when the camera delivered the image; may be unknown

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(image_count);
    fields.number(frame_number);
    fields.number(width);
    fields.number(height);
    fields.require(width != 0 && height != 0, "the picture has no width or no height");
    fields.number(quality);
    fields.require(quality <= MAX_JPEG_QUALITY, "the JPEG quality is above 100");
    visitLayer(fields, layer);
    fields.packed(settings, packCameraSettings, unpackCameraSettings);
  }
};

const size_t IMAGE_HEADER_SIZE = 16;

/// The largest JPEG that fits into a frame with its header.
const size_t MAX_JPEG_SIZE = MAX_PAYLOAD_TOWARDS_CLIENT - IMAGE_HEADER_SIZE;

/// Payload of `f`.
struct PicturePayload {
  ImageHeader header;
  const unsigned char* jpeg;  ///< unchecked; after decoding, points into the payload
  size_t jpeg_size;           ///< bytes, never 0

  template <typename Fields>
  void visit(Fields& fields) {
    fields.item(header);
    fields.content(jpeg, jpeg_size);
    fields.require(jpeg_size > 0, "there is no picture after the image header");
  }
};

/// Error codes. A receiver must accept unknown codes.
enum {
  CODE_REFUSED = 0,        ///< bad payload, unknown joint, not allowed, or another reason
  CODE_FILE_MISSING = 1,   ///< the file is missing or unreadable
  CODE_NOT_SUPPORTED = 2,  ///< the server does not support this kind of request
  CODE_JOINT_FAULT = 3,    ///< pushed: a joint does not follow its commands; the text names it
  CODE_POWER = 4,          ///< pushed: the pause button or a low battery shuts the robot down; the text says which
  CODE_TOO_OLD = 5         ///< the order came later than its not_after
};

/// The longest text, in bytes. A longer text is cut after a whole character.
const size_t MAX_ERROR_TEXT_SIZE = 512;
const size_t MAX_ERROR_MESSAGE_SIZE = 2 + MAX_ERROR_TEXT_SIZE;

/// Payload of `e`.
struct ErrorMessage {
  unsigned short code;
  const char* text;  ///< plain text (text.h) that a user can act on; after decoding, points into the payload
  size_t text_size;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(code);
    fields.text(text, text_size, MAX_ERROR_TEXT_SIZE);
  }
};

/// What has ended. A receiver must accept unknown values.
enum {
  ENDED_MOTION = 1,   ///< a motion; the name is its file's
  ENDED_WALK = 2,     ///< walking; the name is WALK_NAME
  ENDED_POSTURE = 3,  ///< a change of posture; the name is postureName()
  ENDED_JAM = 4,      ///< a joint's fault: the joint follows its commands again; the name is the joint's
  ENDED_JOINTS = 5    ///< a `J`: no joint moves for it any more; no name
};

/// How it has ended. A receiver must accept unknown values.
enum {
  END_DONE = 0,      ///< its end was reached; for a walk: zeros have ended it; for a `J`: its joints were measured
                     ///< within ARRIVED of their targets
  END_REPLACED = 1,  ///< a command, a motion, a walk or a posture took the joints
  END_STOPPED = 2,   ///< the client stopped it or did not steer for 500 ms, or the motors were switched off
  END_REFUSED = 3,   ///< the robot could not continue, for instance because a joint did not follow
  END_FELL = 4       ///< the robot fell or was lifted
};

/// How near a joint of a `J` has to be to its target to have arrived, in microradian: 0.05 rad. Our choice.
const int ARRIVED = 50000;

/// The time that such a joint gets to arrive, in frames (2 s). It begins 12 frames after the end of the joint's planned
/// movement (docs/protocol.md). Our choice.
const unsigned ARRIVAL_FRAMES = 250;

/// The longest texts, in bytes. A longer text is cut after a whole character.
const size_t MAX_END_NAME_SIZE = 64;
const size_t MAX_END_REASON_SIZE = 512;
const size_t MAX_END_MESSAGE_SIZE = 4 + MAX_END_NAME_SIZE + 1 + MAX_END_REASON_SIZE;

/// Payload of a pushed `i`.
struct EndMessage {
  unsigned char what;
  unsigned char how;
  unsigned short order;  ///< number of its request; 0 for a joint's fault, and for what an earlier client began
  const char* name;      ///< plain text (text.h), may be empty; after decoding, points into the payload
  size_t name_size;
  const char* reason;  ///< plain text that a user can act on, may be empty; after decoding, points into the payload
  size_t reason_size;

  template <typename Fields>
  void visit(Fields& fields) {
    fields.number(what);
    fields.number(how);
    fields.number(order);
    fields.line(name, name_size, MAX_END_NAME_SIZE, "there is no newline after the name");
    fields.text(reason, reason_size, MAX_END_REASON_SIZE);
  }
};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_VERSION2_H
