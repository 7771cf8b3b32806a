/// Version 1 of RCServer's wire protocol, which robots in the field speak. C++98, no I/O. docs/protocol.md describes
/// the protocol.
///
/// A request begins with a capital letter and an identifier, a reply with a small letter. Integers are little-endian,
/// except for the big-endian size of a picture (report, section 3.4.1).
#ifndef AIBO_RCSERVER_PROTOCOL_VERSION1_H
#define AIBO_RCSERVER_PROTOCOL_VERSION1_H

#include <stddef.h>

#include "protocol/text.h"

namespace protocol {

/// The port for TCP (report, section 2.2).
const int RCSERVER_PORT = 54321;

/// The JPEG quality that clients ask for by default (report, section 3.3.3).
const unsigned char DEFAULT_JPEG_QUALITY = 85;

/// The highest JPEG quality. Higher numbers mean the same (report, section 3.3.6).
const unsigned char MAX_JPEG_QUALITY = 100;

/// The largest picture, in bytes, that either side sends or accepts. The value is our choice: the worst 208x160 picture
/// at quality 100 takes 99.5 KiB at 4:2:0 (libjpeg-turbo's tjBufSize), and 197 KiB at 4:4:4.
const size_t MAX_PICTURE_SIZE = 256 * 1024;

/// The first bytes of every request (report, section 2.3).
struct BasicGetCommand {
  char command;              ///< capital letter
  unsigned char identifier;  ///< JPEG quality, joint, sensor...: depends on the letter
};

const char REQUEST_PICTURE = 'F';           ///< one picture, identifier = JPEG quality
const char REQUEST_STREAM_TOGGLE = 'W';     ///< starts or stops a stream of pictures; identifier = JPEG quality
const char REQUEST_NEWER_VERSION = 'X';     ///< continue in the protocol version given by the identifier
const char REQUEST_JOINT = 'J';             ///< joint angle, read or set
const char REQUEST_SENSOR = 'S';            ///< sensor value: reads it, or includes it in or excludes it from the block
const char REQUEST_MAX_VELOCITY = 'V';      ///< a joint's greatest speed, read or set
const char REQUEST_MAX_ACCELERATION = 'A';  ///< a joint's greatest acceleration, read or set
const char REQUEST_LED = 'L';               ///< one LED or all of them
const char REQUEST_FACE_LEDS = 'Y';         ///< all LEDs with a face mode
const char REQUEST_EARS = 'K';              ///< one ear or both
const char REQUEST_SHUT_DOWN = 'Q';         ///< motors off, then shut down
const char REQUEST_REBOOT = 'R';            ///< motors off, then reboot
const char REQUEST_UPLOAD_MOTION = 'U';     ///< the bytes of a motion file follow
const char REQUEST_DELETE_MOTION = 'D';     ///< delete a motion file
const char REQUEST_PLAY_MOTION = 'P';       ///< play a motion file
const char REQUEST_UPLOAD_OBJECT = 'C';     ///< the bytes of an OPEN-R object follow

const char REPLY_PICTURE = 'f';  ///< answers `F`, and carries every picture of a stream
const char REPLY_ERROR = 'e';

/// Codes of an error reply.
enum ErrorCode {
  ERROR_REFUSED = 0,       ///< unknown command, wrong size, not allowed, or any other reason
  ERROR_FILE_MISSING = 1,  ///< file missing or unreadable
  ERROR_NOT_A_MOTION = 2   ///< readMotionName() refuses the name
};

const size_t BASIC_COMMAND_SIZE = 2;   ///< bytes of an encoded BasicGetCommand
const size_t VALUE_REQUEST_SIZE = 4;   ///< bytes of a request with a value: letter, identifier, int16
const size_t FILE_REQUEST_SIZE = 18;   ///< bytes of a request with a file name: letter, identifier, char[12], 2 uint16
const size_t PICTURE_HEADER_SIZE = 5;  ///< bytes before the JPEG: `f` and its size
const size_t VALUE_REPLY_SIZE = 4;     ///< bytes of a value or error reply: letter, identifier, int16

/// A reply of four bytes: a value or an error.
struct ValueReply {
  char letter;               ///< the request's small letter, or REPLY_ERROR
  unsigned char identifier;  ///< the identifier of the request; 0 for an error
  short value;               ///< the value, or an ErrorCode
};

void encodeCommand(const BasicGetCommand& command, unsigned char* out);

BasicGetCommand decodeCommand(const unsigned char* in);

/// @param size bytes of the JPEG that follows, 1..MAX_PICTURE_SIZE
void encodePictureHeader(size_t size, unsigned char* out);

/// @param[out] size the bytes of the JPEG that are announced, even if out of range
/// @return false if the bytes are no picture header, or if the size is 0 or above MAX_PICTURE_SIZE
bool decodePictureHeader(const unsigned char* in, size_t* size);

const size_t VALUE_SIZE = 2;  ///< bytes of an encoded value, an int16

void encodeValue(short value, unsigned char* out);

short decodeValue(const unsigned char* in);

void encodeValueReply(const ValueReply& reply, unsigned char* out);

ValueReply decodeValueReply(const unsigned char* in);

/// A value, an acknowledgement and an error have VALUE_REPLY_SIZE bytes.
bool isValueReply(char letter);

/// The identifier in `L` and `K` that means all LEDs or both ears.
const unsigned char ALL_IDENTIFIERS = 0;

/// The identifier in `Y` that means mode A; any other means mode B.
const unsigned char FACE_MODE_A = 1;

/// The low byte of the value of `L` and `Y`. The high byte is ignored.
unsigned char ledIntensity(short value);

/// What follows the identifier in `U`, `D`, `P` and `C`: char name[12], uint16 a, uint16 b.
struct FileRequest {
  char name[MAX_MOTION_NAME_SIZE + 1];  ///< as sent, unchecked, up to the first zero byte
  unsigned short a;                     ///< `P`: repetitions; `U`, `C`: whole blocks of 512 bytes
  unsigned short b;                     ///< `U`, `C`: bytes after these blocks
};

const size_t FILE_PAYLOAD_SIZE = FILE_REQUEST_SIZE - BASIC_COMMAND_SIZE;  ///< bytes of an encoded FileRequest

void encodeFileRequest(const FileRequest& request, unsigned char* out);

/// Decodes a request. It does not check the name; readMotionName() does.
FileRequest decodeFileRequest(const unsigned char* in);

/// The content that `U` and `C` announce: a * 512 + b bytes.
size_t contentSize(const FileRequest& request);

/// @param size 0..65535 * 512 + 65535
void announceContent(size_t size, FileRequest* request);

unsigned char limitJpegQuality(unsigned char quality);

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_VERSION1_H
