/// The server's description of itself in the reply to `H` in version 2. Each line of UTF-8 is `key=value`:
///
///     robot=ERS-7
///     server=aibo_rcserver 0.1.0
///     frame_number=123456
///     capabilities=H F W J V T O I L K P N S E
///     limits=1:-1308997:0:3185226 2:-1535890:1535890:10057460
///     walk_limits=150:100:60:1200
///
/// The first five keys are required; walk_limits appears if the robot can walk. Keys come in any order, each at most
/// once. Unknown keys are ignored: newer servers may send them.
#ifndef AIBO_RCSERVER_PROTOCOL_HELLO_H
#define AIBO_RCSERVER_PROTOCOL_HELLO_H

#include <stddef.h>

#include "protocol/version2.h"
#include "protocol/walk_requests.h"

namespace protocol {
namespace version2 {

struct JointLimits {
  unsigned char id;
  int lower;  ///< microradian
  int upper;  ///< microradian, not below lower
  int speed;  ///< microradian/s, not negative
};

/// The longest text in a hello, without the zero byte.
const size_t MAX_HELLO_TEXT_SIZE = 127;

/// The content of a hello. Texts are plain (text.h) and end in a zero byte.
struct Hello {
  char robot[MAX_HELLO_TEXT_SIZE + 1];         ///< the design, in OPEN-R's words: "ERS-7"
  char server[MAX_HELLO_TEXT_SIZE + 1];        ///< name and version of the server
  unsigned frame_number;                       ///< the current OPEN-R frame (8 ms)
  char capabilities[MAX_HELLO_TEXT_SIZE + 1];  ///< supported kinds of request and other abilities, with spaces
  unsigned char joint_count;                   ///< 0..MAX_JOINTS
  JointLimits joints[MAX_JOINTS];              ///< `limits`: id:lower:upper:speed, separated by spaces
  WalkLimits walk;  ///< `walk_limits`: forward:back:left:turn; in the payload, in mm/s and mrad/s
};

/// Room for the keys, three texts, at most 4 + 3 * 12 bytes per joint, and 4 * 6 for the walk.
const size_t MAX_HELLO_SIZE = 160 + 3 * MAX_HELLO_TEXT_SIZE + MAX_JOINTS * 40;

/// @param out room for MAX_HELLO_SIZE bytes
/// @return the number of bytes written
size_t encodeHello(const Hello& hello, unsigned char* out);

/// @param[out] hello undefined unless the result is NULL
/// @return NULL, or what is wrong, in a few words
const char* decodeHello(const unsigned char* payload, size_t size, Hello* hello);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_HELLO_H
