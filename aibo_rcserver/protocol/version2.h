/// @file version2.h
/// Version 2 of the RCServer's wire protocol. Used by both sides; C++98, no I/O, no memory of its own.
///
/// A client asks for version 2 in version 1 (versionRequest()). Once the server has agreed (versionReply()), both sides
/// send frames only: a header of 8 bytes, then a payload. The kind in the header determines the payload's layout. All
/// integers are big-endian, angles are in microradian, times on the robot are in OPEN-R frames of 8 ms.
/// docs/protocol.md describes the whole protocol; the hello is in hello.h, requests about motions in motion_requests.h,
/// those about walking in walk_requests.h, those about the camera's settings in camera_settings.h, those about its
/// colour detection in color_requests.h, pictures by UDP in picture_datagram.h, those about pictures on the memory
/// stick in stick_pictures.h.
///
/// Every decoder checks the payload's size, its counts, its reserved bytes and the values that the layout limits. It
/// returns NULL, or what is wrong in a few words that can follow "bad request: "; then its result is unchanged. Whether
/// a value makes sense for this robot, such as whether a joint exists, is checked by the server.
///
/// Every encoder returns the number of bytes it has written, which is at most the constant above it. It expects values
/// that its decoder would accept.
#ifndef AIBO_RCSERVER_PROTOCOL_VERSION2_H
#define AIBO_RCSERVER_PROTOCOL_VERSION2_H

#include <stddef.h>

#include "protocol/camera_settings.h"
#include "protocol/version1.h"

namespace protocol {
namespace version2 {

const unsigned char VERSION = 2;

/// The version 1 request for version 2: {`X`, 2}.
BasicGetCommand versionRequest();

/// The version 1 reply that agrees: {`x`, 2, 0, 0}. The next byte is a frame's.
ValueReply versionReply();

/// True if `reply` is versionReply(). After any other answer, the connection stays at version 1.
bool agreesToVersion2(const ValueReply& reply);

/// The first bytes of every frame.
struct FrameHeader {
  char kind;  ///< capital letter = request, lower-case letter = reply or push
  /// JPEG quality of `F`, `W` and `M`, bits of TelemetryContent of `T`, HoldScope of `I`, CameraSetting of `G`,
  /// ColorOrder of `Z`, Posture of `E`, StickPictureRequest of `Y`, bits of `U` and `P`; 0 for all other kinds
  unsigned char id;
  unsigned short request_number;  ///< 1..65535 in a request and its reply, 0 in a push
  unsigned payload_size;          ///< bytes that follow the header
};

const size_t FRAME_HEADER_SIZE = 8;

const size_t MAX_PAYLOAD_TOWARDS_CLIENT = 256 * 1024;
const size_t MAX_PAYLOAD_TOWARDS_ROBOT = 64 * 1024;

/// Writes FRAME_HEADER_SIZE bytes.
size_t encodeFrameHeader(const FrameHeader& header, unsigned char* out);

/// Reads FRAME_HEADER_SIZE bytes. The announced payload size is not checked; FrameReader does that.
FrameHeader decodeFrameHeader(const unsigned char* in);

const char REQUEST_HELLO = 'H';         ///< hello and heartbeat; no payload, the reply's is in hello.h
const char REQUEST_PICTURE = 'F';       ///< one picture, id = JPEG quality; answered by a picture
const char REQUEST_STREAM = 'W';        ///< stream on or off, id = JPEG quality; pictures are then pushed
const char REQUEST_JOINTS = 'J';        ///< moves joints; answered by the accepted targets
const char REQUEST_SPEED_LIMITS = 'V';  ///< sets or reads speed limits of joints; answered by those in force
const char REQUEST_TELEMETRY = 'T';     ///< telemetry period; answered by the one in force; values are then pushed
const char REQUEST_MOTORS = 'O';        ///< switches the motors, or reads their state; answered by the state in force
const char REQUEST_HOLD = 'I';          ///< stops joints and what moves them; id = HoldScope; the reply has no payload
const char REQUEST_LEDS = 'L';          ///< sets LEDs; answered by the accepted values
const char REQUEST_EARS = 'K';          ///< draws ears or lets them go; answered by their new state
const char REQUEST_CAMERA = 'G';        ///< sets or reads a camera setting (camera_settings.h); answered by its value
const char REQUEST_DATAGRAMS = 'B';     ///< pictures by UDP (picture_datagram.h); answered by the port in force
const char REQUEST_UPLOAD = 'U';        ///< stores a motion; the layouts of U, D, P and N are in motion_requests.h
const char REQUEST_DELETE = 'D';        ///< deletes a motion
const char REQUEST_PLAY = 'P';          ///< plays a motion, or stops it
const char REQUEST_LIST = 'N';          ///< answered by the names of the motions on the robot
const char REQUEST_SAVE_PICTURE = 'M';  ///< takes a picture onto the memory stick, id = quality; answered by its name
const char REQUEST_PICTURES = 'Y';      ///< lists, fetches or deletes them, id = StickPictureRequest (stick_pictures.h)
const char REQUEST_STEER = 'S';         ///< walks; answered by the velocity in force; layouts are in walk_requests.h
const char REQUEST_POSTURE = 'E';       ///< takes a posture, id = Posture; no payload; answered when it has begun
const char REQUEST_SHUT_DOWN = 'Q';     ///< motors off, then shut down; nothing follows the reply
const char REQUEST_REBOOT = 'R';        ///< motors off, then reboot; nothing follows the reply

const char PICTURE = 'f';         ///< a picture: the reply to `F`, or pushed by a stream
const char TELEMETRY_PUSH = 't';  ///< measured values if request_number is 0; otherwise the reply to `T`, a period
const char END_PUSH = 'i';        ///< something that the robot did has ended
const char MOTORS_AND_POSTURE_PUSH = 'o';  ///< if request_number is 0; otherwise the reply to `O`, the motors alone
const char ERROR_MESSAGE = 'e';  ///< a request was refused; with request_number 0: a joint's fault, a power event,
                                 ///< or why the server closes the connection

/// The kind of the reply to a request that is not refused: the small letter.
char replyKind(char request_kind);

/// True if a frame of this kind and payload is an error. The reply to `E` that is not refused is an `e`, too; it has no
/// payload, while an error has at least its code.
bool isError(char kind, size_t payload_size);

/// Quality that means the server's own default. All other numbers above MAX_JPEG_QUALITY mean MAX_JPEG_QUALITY.
const unsigned char SERVER_DEFAULT_QUALITY = 255;

/// The camera's layers, as OPEN-R numbers them, and the double resolution that the server computes from them.
enum Layer { LAYER_HIGH = 0, LAYER_MIDDLE = 1, LAYER_LOW = 2, LAYER_DOUBLE = 3 };

/// Payload of `F`: uint8 layer.
const size_t PICTURE_REQUEST_SIZE = 1;
size_t encodePictureRequest(Layer layer, unsigned char* out);
const char* decodePictureRequest(const unsigned char* payload, size_t size, Layer* layer);

/// Payload of `W` and of its reply: uint8 on, uint8 layer, uint16 every n-th image.
struct StreamSettings {
  bool on;
  Layer layer;
  unsigned short every_nth_image;  ///< 1 = every image of the camera, 2 = every other one; never 0
};

const size_t STREAM_SETTINGS_SIZE = 4;
size_t encodeStreamSettings(const StreamSettings& settings, unsigned char* out);
const char* decodeStreamSettings(const unsigned char* payload, size_t size, StreamSettings* settings);

/// A joint and its target or speed limit.
struct JointValue {
  unsigned char id;
  int value;  ///< microradian, or microradian/s
};

/// Most joints in one payload. An ERS-7 and an ERS-210 have 18 servos.
const size_t MAX_JOINTS = 32;

/// Payload of `J` and of its reply: uint16 duration, uint8 count, uint8 0, count x {uint8 id, uint8 0, uint16 0, int32
/// microradian}. No id may appear twice.
struct JointTargets {
  unsigned short duration_ms;  ///< all joints arrive after this time; 0 = each as fast as its limits allow
  unsigned char count;         ///< of joints, 0..MAX_JOINTS
  JointValue joints[MAX_JOINTS];
};

const size_t MAX_JOINT_TARGETS_SIZE = 4 + MAX_JOINTS * 8;
size_t encodeJointTargets(const JointTargets& targets, unsigned char* out);
const char* decodeJointTargets(const unsigned char* payload, size_t size, JointTargets* targets);

/// Payload of `V` and of its reply: count x {uint8 id, uint8 0, uint16 0, int32 microradian/s}. No id may appear twice.
/// An empty request reads all limits.
struct SpeedLimits {
  unsigned char count;  ///< of joints, 0..MAX_JOINTS
  JointValue joints[MAX_JOINTS];
};

const size_t MAX_SPEED_LIMITS_SIZE = MAX_JOINTS * 8;
size_t encodeSpeedLimits(const SpeedLimits& limits, unsigned char* out);
const char* decodeSpeedLimits(const unsigned char* payload, size_t size, SpeedLimits* limits);

/// What telemetry contains besides positions and sensors: bits of the id of `T`. The reply's id has the bits in force:
/// a server leaves out those that it does not know. A server that knows TELEMETRY_WITH_DUTY only takes an id with other
/// bits for TELEMETRY_PLAIN, so ask for a walk only if the server has REQUEST_STEER.
enum TelemetryContent { TELEMETRY_PLAIN = 0, TELEMETRY_WITH_DUTY = 1, TELEMETRY_WITH_WALK = 2 };

/// Payload of `T` and of its reply: uint16 period in OPEN-R frames of 8 ms, 0 = off.
const size_t TELEMETRY_PERIOD_SIZE = 2;
size_t encodeTelemetryPeriod(unsigned short frames, unsigned char* out);
const char* decodeTelemetryPeriod(const unsigned char* payload, size_t size, unsigned short* frames);

const char GROUP_JOINT = 'J';   ///< a position in microradian
const char GROUP_SENSOR = 'S';  ///< millionths of the sensor's SI unit; a switch is 0 or 1
const char GROUP_DUTY = 'D';    ///< of a joint's motor, in millionths of full duty; only TELEMETRY_WITH_DUTY
const char GROUP_WALK = 'W';    ///< how the robot walks (walk_requests.h); only TELEMETRY_WITH_WALK

/// One measured value.
struct TelemetryEntry {
  char group;  ///< GROUP_JOINT, GROUP_SENSOR, GROUP_DUTY or GROUP_WALK
  unsigned char id;
  int value;
};

/// Most values in one push: an ERS-7 has 18 joints and about 20 sensors.
const size_t MAX_TELEMETRY_ENTRIES = 128;

/// Payload of a pushed `t`: uint32 frame number, uint16 count, uint16 0, count x {char group, uint8 id, uint16 0, int32
/// value}.
struct Telemetry {
  unsigned frame_number;  ///< OPEN-R frame (8 ms) in which the values were measured
  unsigned short count;   ///< of values, 0..MAX_TELEMETRY_ENTRIES
  TelemetryEntry entries[MAX_TELEMETRY_ENTRIES];
};

const size_t MAX_TELEMETRY_SIZE = 8 + MAX_TELEMETRY_ENTRIES * 8;
size_t encodeTelemetry(const Telemetry& telemetry, unsigned char* out);
const char* decodeTelemetry(const unsigned char* payload, size_t size, Telemetry* telemetry);

/// Payload of `O` and of its reply: uint8 1 = on, 0 = off. An empty request reads the state.
const size_t MOTOR_STATE_SIZE = 1;
size_t encodeMotorState(bool on, unsigned char* out);
const char* decodeMotorState(const unsigned char* payload, size_t size, bool* on);

/// How the robot is. A receiver must accept values that it does not know.
enum PostureNow {
  POSTURE_NOW_UNKNOWN = 0,  ///< none of the others
  POSTURE_NOW_STANDING = 1,
  POSTURE_NOW_SITTING = 2,
  POSTURE_NOW_LYING = 3,
  POSTURE_NOW_WALKING = 4,
  POSTURE_NOW_FALLEN = 5,  ///< on its side or its back
  POSTURE_NOW_CARRIED = 6
};

/// Payload of a pushed `o`: uint8 1 = motors on, 0 = off, uint8 posture, uint16 0. It is pushed to a client that has
/// sent `O`, then and at each change.
struct MotorsAndPosture {
  bool motors_on;
  unsigned char posture;  ///< a PostureNow
};

const size_t MOTORS_AND_POSTURE_SIZE = 4;
size_t encodeMotorsAndPosture(const MotorsAndPosture& state, unsigned char* out);
const char* decodeMotorsAndPosture(const unsigned char* payload, size_t size, MotorsAndPosture* state);

/// What `I` holds: its id.
enum HoldScope {
  HOLD_EVERYTHING = 0,  ///< everything that moves; no payload
  HOLD_JOINTS = 1       ///< the joints in the payload
};

/// Payload of `I` for some joints: count x uint8 id. No id may appear twice.
struct JointIds {
  unsigned char count;  ///< of joints, 1..MAX_JOINTS
  unsigned char ids[MAX_JOINTS];
};

const size_t MAX_JOINT_IDS_SIZE = MAX_JOINTS;
size_t encodeJointIds(const JointIds& joints, unsigned char* out);
const char* decodeJointIds(const unsigned char* payload, size_t size, JointIds* joints);

/// Modes of the LEDs that have modes, with Sony's names. What they look like depends on the robot.
enum LedMode { LED_MODE_A = 0, LED_MODE_B = 1 };

/// An LED and its intensity.
struct LedValue {
  unsigned char id;
  unsigned char intensity;  ///< 0..255; an LED that can only be on or off is on unless this is 0
  LedMode mode;             ///< ignored by an LED that can only be on or off
};

/// Most LEDs in one payload. An ERS-7 has 26.
const size_t MAX_LEDS = 32;

/// Payload of `L` and of its reply: count x {uint8 id, uint8 intensity, uint8 mode, uint8 0}. No id may appear twice.
struct LedValues {
  unsigned char count;  ///< of LEDs, 0..MAX_LEDS
  LedValue leds[MAX_LEDS];
};

const size_t MAX_LED_VALUES_SIZE = MAX_LEDS * 4;
size_t encodeLedValues(const LedValues& values, unsigned char* out);
const char* decodeLedValues(const unsigned char* payload, size_t size, LedValues* values);

/// Payload of `K` and of its reply: uint8 left, uint8 right; 1 = drawn by its magnet, 0 = let go.
struct EarPositions {
  bool left;   ///< in a request: draw it; in a reply: it is drawn
  bool right;  ///< the same
};

const size_t EAR_POSITIONS_SIZE = 2;
size_t encodeEarPositions(const EarPositions& positions, unsigned char* out);
const char* decodeEarPositions(const unsigned char* payload, size_t size, EarPositions* positions);

/// The decoder of requests and replies without a payload, such as `N`, `Q` and `R`.
const char* checkNoPayload(size_t size);

/// The bytes before the JPEG in the payload of `f`: uint32 image count, uint32 frame number, uint16 width, uint16
/// height, uint8 quality, uint8 layer, uint16 camera settings (packCameraSettings()), which a server sends only to a
/// client that has sent `G`, and 0 to all others.
struct ImageHeader {
  unsigned image_count;     ///< the camera's own count of images; a robot may count in the low 16 bits only
  unsigned frame_number;    ///< OPEN-R frame (8 ms) in which the camera took the image
  unsigned short width;     ///< pixels, never 0
  unsigned short height;    ///< pixels, never 0
  unsigned char quality;    ///< JPEG quality, 0..MAX_JPEG_QUALITY
  Layer layer;              ///< from which the picture was made
  CameraSettings settings;  ///< in force when the image came from the camera; unknown unless the server tells
};

const size_t IMAGE_HEADER_SIZE = 16;

/// Largest JPEG that fits into a frame beside its header.
const size_t MAX_JPEG_SIZE = MAX_PAYLOAD_TOWARDS_CLIENT - IMAGE_HEADER_SIZE;

/// Writes IMAGE_HEADER_SIZE bytes; the JPEG follows them.
size_t encodeImageHeader(const ImageHeader& header, unsigned char* out);

/// Decodes the payload of a picture. The JPEG itself is not checked.
/// @param[out] jpeg_size bytes of the JPEG, which begins at payload + IMAGE_HEADER_SIZE; never 0
const char* decodePicture(const unsigned char* payload, size_t size, ImageHeader* header, size_t* jpeg_size);

/// Codes of an error message. A receiver must accept codes that it does not know.
enum {
  CODE_REFUSED = 0,        ///< bad payload, unknown joint, not allowed, or anything else
  CODE_FILE_MISSING = 1,   ///< file missing or unreadable, as in version 1
  CODE_NOT_SUPPORTED = 2,  ///< a kind of request that this server does not know or support
  CODE_JOINT_FAULT = 3,    ///< pushed: a joint does not follow its commands; the text names it
  CODE_POWER = 4           ///< pushed: the pause button or a low battery shuts the robot down; the text says which
};

/// Payload of `e`: uint16 code, then a text without an end mark, which may be empty.
struct ErrorMessage {
  unsigned short code;
  const char* text;  ///< plain text (text.h) that a user can act on; after decoding, points into the payload
  size_t text_size;
};

/// Longest text that encodeErrorMessage() sends, in bytes.
const size_t MAX_ERROR_TEXT_SIZE = 512;

const size_t MAX_ERROR_MESSAGE_SIZE = 2 + MAX_ERROR_TEXT_SIZE;

/// A text longer than MAX_ERROR_TEXT_SIZE is cut after a whole character.
size_t encodeErrorMessage(const ErrorMessage& message, unsigned char* out);
const char* decodeErrorMessage(const unsigned char* payload, size_t size, ErrorMessage* message);

/// What has ended. A receiver must accept values that it does not know.
enum {
  ENDED_MOTION = 1,   ///< a motion; the name is its file's
  ENDED_WALK = 2,     ///< walking; the name is WALK_NAME
  ENDED_POSTURE = 3,  ///< a change of posture; the name is postureName()
  ENDED_JAM = 4       ///< a joint's fault: it follows its commands again; the name is the joint's
};

/// How it has ended. A receiver must accept values that it does not know.
enum {
  END_DONE = 0,      ///< it has reached its end; a walk: the robot stands because it was steered so
  END_REPLACED = 1,  ///< a command or another motion took its joints
  END_STOPPED = 2,   ///< the client, or the motors' switch, stopped it
  END_REFUSED = 3,   ///< the robot could not go on with it, for instance because a joint did not follow
  END_FELL = 4       ///< the robot fell or was lifted
};

/// Payload of a pushed `i`: uint8 what, uint8 how, uint16 0, then name, newline, reason, without an end mark.
struct EndMessage {
  unsigned char what;
  unsigned char how;
  const char* name;  ///< plain text (text.h), may be empty; after decoding, points into the payload
  size_t name_size;
  const char* reason;  ///< plain text that a user can act on, may be empty; after decoding, points into the payload
  size_t reason_size;
};

/// Longest name and longest reason that encodeEndMessage() sends, in bytes.
const size_t MAX_END_NAME_SIZE = 64;
const size_t MAX_END_REASON_SIZE = 512;

const size_t MAX_END_MESSAGE_SIZE = 4 + MAX_END_NAME_SIZE + 1 + MAX_END_REASON_SIZE;

/// A name or reason that is too long is cut after a whole character.
size_t encodeEndMessage(const EndMessage& message, unsigned char* out);
const char* decodeEndMessage(const unsigned char* payload, size_t size, EndMessage* message);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_VERSION2_H
