/// @file hello.h
/// The server's description of itself, which it sends in its reply to `H` in version 2 of the protocol. It consists of
/// lines of UTF-8, each `key=value` and a newline:
///
///     robot=ERS-7
///     server=aibo_rcserver 0.1.0
///     frame_number=123456
///     capabilities=H F W J V T O I L K P N S E
///     limits=1:-1308997:0:3185226 2:-1535890:1535890:10057460
///     walk_limits=150:100:60:1200
///
/// The first five keys must be there; walk_limits is there if the robot can walk. None may be there twice. The order
/// does not matter. Other keys are for newer clients and are ignored.
#ifndef AIBO_RCSERVER_PROTOCOL_HELLO_H
#define AIBO_RCSERVER_PROTOCOL_HELLO_H

#include <stddef.h>

#include "protocol/version2.h"
#include "protocol/walk_requests.h"

namespace protocol {
namespace version2 {

/// The range and speed of a joint of this robot.
struct JointLimits {
  unsigned char id;
  int lower;  ///< microradian
  int upper;  ///< microradian, not below lower
  int speed;  ///< greatest speed in microradian/s, not negative
};

/// Most bytes in one text of a hello, without the end mark.
const size_t MAX_HELLO_TEXT_SIZE = 127;

/// The content of a hello. Texts end in a zero byte and are plain (text.h).
struct Hello {
  char robot[MAX_HELLO_TEXT_SIZE + 1];         ///< the design, as OPEN-R names it: "ERS-7"
  char server[MAX_HELLO_TEXT_SIZE + 1];        ///< name and version of the server
  unsigned frame_number;                       ///< OPEN-R frame (8 ms) now
  char capabilities[MAX_HELLO_TEXT_SIZE + 1];  ///< kinds of request that are not answered by CODE_NOT_SUPPORTED, and
                                               ///< words for other abilities; separated by spaces
  unsigned char joint_count;                   ///< 0..MAX_JOINTS
  JointLimits joints[MAX_JOINTS];              ///< `limits`: id:lower:upper:speed, separated by spaces
  WalkLimits walk;                             ///< `walk_limits`: forward:back:left:turn, in mm/s and mrad/s
};

/// Room for the largest hello: keys, three texts, and at most 4 + 3 * 12 bytes per joint, and 4 * 6 for the walk.
const size_t MAX_HELLO_SIZE = 160 + 3 * MAX_HELLO_TEXT_SIZE + MAX_JOINTS * 40;

/// Writes the payload.
/// @param out room for MAX_HELLO_SIZE bytes
/// @return bytes written
size_t encodeHello(const Hello& hello, unsigned char* out);

/// Reads the payload.
/// @return NULL, or what is wrong in a few words; then `hello` is undefined
const char* decodeHello(const unsigned char* payload, size_t size, Hello* hello);

/// True if `word` is among the hello's capabilities, for instance "J".
bool hasCapability(const Hello& hello, const char* word);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_HELLO_H
