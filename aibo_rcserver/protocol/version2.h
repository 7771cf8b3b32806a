/// @file version2.h
/// Version 2 of the RCServer's wire protocol. Used by both sides; C++98, no I/O, no memory of its own.
///
/// A client asks for it in version 1 (versionRequest()); once the server has agreed (versionReply()), everything both
/// ways is a frame: a header of 8 bytes, then a payload whose layout the kind in the header tells. All integers are
/// big-endian, angles are microradian, times on the robot are OPEN-R frames of 8 ms. docs/protocol.md tells the whole
/// of it; the text of a hello is in hello.h.
///
/// Every decoder here checks the payload's size, its counts, its reserved bytes and the values that the layout itself
/// limits, and returns what is wrong in a few words that can follow "bad request: ", or NULL if all is well. What it
/// was to fill in is untouched unless all is well. What a value means to this robot, such as whether there is such a
/// joint, is for the server to say.
///
/// Every encoder returns the bytes it has written, which is at most the constant named beside it. It expects what its
/// decoder would accept.
#ifndef AIBO_RCSERVER_PROTOCOL_VERSION2_H
#define AIBO_RCSERVER_PROTOCOL_VERSION2_H

#include <stddef.h>

#include "protocol/version1.h"

namespace protocol {
namespace version2 {

const unsigned char VERSION = 2;

/// The version 1 request for version 2: {`X`, 2}.
BasicGetCommand versionRequest();

/// The version 1 reply that agrees: {`x`, 2, 0, 0}. The next byte is a frame's.
ValueReply versionReply();

/// True if `reply` is versionReply(). Any other answer leaves the connection at version 1.
bool agreesToVersion2(const ValueReply& reply);

/// What every frame begins with.
struct FrameHeader {
  char kind;                      ///< capital letter = request, lower-case letter = reply or push
  unsigned char id;               ///< JPEG quality of `F` and `W`; 0 for the other kinds here
  unsigned short request_number;  ///< 1..65535 in a request and its reply, 0 in a push
  unsigned payload_size;          ///< bytes that follow the header
};

const size_t FRAME_HEADER_SIZE = 8;

const size_t MAX_PAYLOAD_TOWARDS_CLIENT = 256 * 1024;
const size_t MAX_PAYLOAD_TOWARDS_ROBOT = 64 * 1024;

/// Writes FRAME_HEADER_SIZE bytes.
size_t encodeFrameHeader(const FrameHeader& header, unsigned char* out);

/// Reads FRAME_HEADER_SIZE bytes. The payload size is as announced, whatever that is; FrameReader is who checks it.
FrameHeader decodeFrameHeader(const unsigned char* in);

const char REQUEST_HELLO = 'H';         ///< hello and heartbeat; no payload, the reply's is in hello.h
const char REQUEST_PICTURE = 'F';       ///< one picture, id = JPEG quality; answered by a picture
const char REQUEST_STREAM = 'W';        ///< stream on or off, id = JPEG quality; pictures are then pushed
const char REQUEST_JOINTS = 'J';        ///< joints to positions; answered by what was accepted
const char REQUEST_SPEED_LIMITS = 'V';  ///< speed limits of joints, set or read; answered by those in force
const char REQUEST_TELEMETRY = 'T';     ///< telemetry period; answered by the one in force, values are then pushed
const char REQUEST_MOTORS = 'O';        ///< motors on or off, or asks which; answered by the state in force
const char REQUEST_LEDS = 'L';          ///< LEDs to intensities; answered by what was accepted
const char REQUEST_EARS = 'K';          ///< draws ears or lets them go; answered by what was accepted
const char REQUEST_UPLOAD = 'U';        ///< stores a motion; the layouts of U, D, P and N are in motion_requests.h
const char REQUEST_DELETE = 'D';        ///< deletes a motion
const char REQUEST_PLAY = 'P';          ///< plays a motion, or stops it
const char REQUEST_LIST = 'N';          ///< answered by the names of the motions that are there
const char REQUEST_SHUT_DOWN = 'Q';     ///< motors off, then shut down: the reply is the last that comes
const char REQUEST_REBOOT = 'R';        ///< motors off, then reboot: the reply is the last that comes

const char PICTURE = 'f';         ///< a picture: the reply to `F`, or pushed by a stream
const char TELEMETRY_PUSH = 't';  ///< measured values if request_number is 0; else the reply to `T`, a period
const char ERROR_MESSAGE = 'e';   ///< a request refused; with request_number 0, a joint's fault, or why the
                                  ///< server will hang up

/// The kind of a request's reply unless it is refused: the small letter.
char replyKind(char request_kind);

/// Quality that means the server's own default. Above MAX_JPEG_QUALITY, everything else means MAX_JPEG_QUALITY.
const unsigned char SERVER_DEFAULT_QUALITY = 255;

/// The camera's layers, as OPEN-R numbers them, and the double resolution that is made of them.
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

/// A joint and what it is to do.
struct JointValue {
  unsigned char id;
  int value;  ///< microradian, or microradian/s
};

/// Most joints in one payload: the 18 servos of an ERS-7 or ERS-210, and room.
const size_t MAX_JOINTS = 32;

/// Payload of `J` and of its reply: uint16 duration, uint8 count, uint8 0, count x {uint8 id, uint8 0, uint16 0, int32
/// microradian}. No id may be there twice.
struct JointTargets {
  unsigned short duration_ms;  ///< all joints arrive after this time; 0 = each as fast as its limits allow
  unsigned char count;         ///< of joints, 0..MAX_JOINTS
  JointValue joints[MAX_JOINTS];
};

const size_t MAX_JOINT_TARGETS_SIZE = 4 + MAX_JOINTS * 8;
size_t encodeJointTargets(const JointTargets& targets, unsigned char* out);
const char* decodeJointTargets(const unsigned char* payload, size_t size, JointTargets* targets);

/// Payload of `V` and of its reply: count x {uint8 id, uint8 0, uint16 0, int32 microradian/s}. No id may be there
/// twice. An empty request reads all limits.
struct SpeedLimits {
  unsigned char count;  ///< of joints, 0..MAX_JOINTS
  JointValue joints[MAX_JOINTS];
};

const size_t MAX_SPEED_LIMITS_SIZE = MAX_JOINTS * 8;
size_t encodeSpeedLimits(const SpeedLimits& limits, unsigned char* out);
const char* decodeSpeedLimits(const unsigned char* payload, size_t size, SpeedLimits* limits);

/// Payload of `T` and of its reply: uint16 period in OPEN-R frames of 8 ms, 0 = off.
const size_t TELEMETRY_PERIOD_SIZE = 2;
size_t encodeTelemetryPeriod(unsigned short frames, unsigned char* out);
const char* decodeTelemetryPeriod(const unsigned char* payload, size_t size, unsigned short* frames);

const char GROUP_JOINT = 'J';   ///< a position in microradian
const char GROUP_SENSOR = 'S';  ///< millionths of the sensor's SI unit; a switch is 0 or 1

/// One measured value.
struct TelemetryEntry {
  char group;  ///< GROUP_JOINT or GROUP_SENSOR
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

/// Payload of `O` and of its reply: uint8 1 = on, 0 = off. An empty request only asks.
const size_t MOTOR_STATE_SIZE = 1;
size_t encodeMotorState(bool on, unsigned char* out);
const char* decodeMotorState(const unsigned char* payload, size_t size, bool* on);

/// Modes of an LED that has them, as Sony names them; what they look like is the robot's affair.
enum LedMode { LED_MODE_A = 0, LED_MODE_B = 1 };

/// An LED and how it is to shine.
struct LedValue {
  unsigned char id;
  unsigned char intensity;  ///< 0..255; an LED that is only on or off is on unless it is 0
  LedMode mode;             ///< of no meaning to an LED that is only on or off
};

/// Most LEDs in one payload: the 26 of an ERS-7, and room.
const size_t MAX_LEDS = 32;

/// Payload of `L` and of its reply: count x {uint8 id, uint8 intensity, uint8 mode, uint8 0}. No id may be there twice.
struct LedValues {
  unsigned char count;  ///< of LEDs, 0..MAX_LEDS
  LedValue leds[MAX_LEDS];
};

const size_t MAX_LED_VALUES_SIZE = MAX_LEDS * 4;
size_t encodeLedValues(const LedValues& values, unsigned char* out);
const char* decodeLedValues(const unsigned char* payload, size_t size, LedValues* values);

/// Payload of `K` and of its reply: uint8 left, uint8 right; 1 = drawn by its magnet, 0 = let go.
struct EarPositions {
  bool left;   ///< in a request: draw it; in a reply: it is drawn now
  bool right;  ///< the same
};

const size_t EAR_POSITIONS_SIZE = 2;
size_t encodeEarPositions(const EarPositions& positions, unsigned char* out);
const char* decodeEarPositions(const unsigned char* payload, size_t size, EarPositions* positions);

/// For a request or reply without a payload, such as `N`, `Q` and `R`: what is wrong if there is one, or NULL.
const char* checkNoPayload(size_t size);

/// What stands before the JPEG in the payload of `f`: uint32 image count, uint32 frame number, uint16 width, uint16
/// height, uint8 quality, uint8 layer, uint16 0.
struct ImageHeader {
  unsigned image_count;   ///< the camera's own count of images; the low 16 bits may be all that a robot counts
  unsigned frame_number;  ///< OPEN-R frame (8 ms) in which the camera took the image
  unsigned short width;   ///< pixels, never 0
  unsigned short height;  ///< pixels, never 0
  unsigned char quality;  ///< JPEG quality, 0..MAX_JPEG_QUALITY
  Layer layer;            ///< of which the picture was made
};

const size_t IMAGE_HEADER_SIZE = 16;

/// Largest JPEG that fits into a frame together with its header.
const size_t MAX_JPEG_SIZE = MAX_PAYLOAD_TOWARDS_CLIENT - IMAGE_HEADER_SIZE;

/// Writes IMAGE_HEADER_SIZE bytes; the JPEG goes right behind them.
size_t encodeImageHeader(const ImageHeader& header, unsigned char* out);

/// Takes a picture's payload apart. Whether the JPEG is one is not looked at.
/// @param[out] jpeg_size bytes of the JPEG, which begins at payload + IMAGE_HEADER_SIZE; never 0
const char* decodePicture(const unsigned char* payload, size_t size, ImageHeader* header, size_t* jpeg_size);

/// Codes of an error message. A receiver has to bear codes that it does not know.
enum {
  CODE_REFUSED = 0,        ///< bad payload, unknown joint, not allowed, anything else
  CODE_FILE_MISSING = 1,   ///< file missing or unreadable, as in version 1
  CODE_NOT_SUPPORTED = 2,  ///< a kind of request that this server does not know or cannot do (yet)
  CODE_JOINT_FAULT = 3,    ///< pushed: a joint does not follow what it is told; the text names it
  CODE_POWER = 4           ///< pushed: the pause button or a low battery switches the robot off; the text says which
};

/// Payload of `e`: uint16 code, then a text without end mark, which may be empty.
struct ErrorMessage {
  unsigned short code;
  const char* text;  ///< plain text (text.h) in words that a user can act on; decoded, it lies in the payload
  size_t text_size;
};

/// Longest text that encodeErrorMessage() sends, in bytes.
const size_t MAX_ERROR_TEXT_SIZE = 512;

const size_t MAX_ERROR_MESSAGE_SIZE = 2 + MAX_ERROR_TEXT_SIZE;

/// A text longer than MAX_ERROR_TEXT_SIZE is cut after a whole character.
size_t encodeErrorMessage(const ErrorMessage& message, unsigned char* out);
const char* decodeErrorMessage(const unsigned char* payload, size_t size, ErrorMessage* message);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_VERSION2_H
