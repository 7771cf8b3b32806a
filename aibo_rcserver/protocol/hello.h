/// @file hello.h
/// What the server says of itself in its reply to `H` in version 2 of the protocol: lines of UTF-8, each `key=value`
/// and a newline:
///
///     robot=ERS-7
///     server=aibo_rcserver 0.1.0
///     frame_number=123456
///     capabilities=H F W J V T O L K P N
///     limits=1:-1308997:0:3185226 2:-1535890:1535890:10057460
///
/// All five have to be there, each once, in any order; what else is there is for newer clients and is passed over.
#ifndef AIBO_RCSERVER_PROTOCOL_HELLO_H
#define AIBO_RCSERVER_PROTOCOL_HELLO_H

#include <stddef.h>

#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// What a joint can do on this robot.
struct JointLimits {
  unsigned char id;
  int lower;  ///< microradian
  int upper;  ///< microradian, not below lower
  int speed;  ///< greatest speed in microradian/s, not negative
};

/// Most bytes in one text of a hello, without the end mark.
const size_t MAX_HELLO_TEXT_SIZE = 127;

/// Texts end in a zero byte and are plain (text.h).
struct Hello {
  char robot[MAX_HELLO_TEXT_SIZE + 1];         ///< the design, as OPEN-R names it: "ERS-7"
  char server[MAX_HELLO_TEXT_SIZE + 1];        ///< name and version of the server
  unsigned frame_number;                       ///< OPEN-R frame (8 ms) now
  char capabilities[MAX_HELLO_TEXT_SIZE + 1];  ///< kinds of request that are not answered by CODE_NOT_SUPPORTED, and
                                               ///< words for what else the server can do; a space between two
  unsigned char joint_count;                   ///< 0..MAX_JOINTS
  JointLimits joints[MAX_JOINTS];              ///< `limits`: id:lower:upper:speed, a space between two
};

/// Room for the largest hello: keys, three texts, and 4 + 3 * 12 bytes a joint at most.
const size_t MAX_HELLO_SIZE = 128 + 3 * MAX_HELLO_TEXT_SIZE + MAX_JOINTS * 40;

/// Writes the payload.
/// @param out room for MAX_HELLO_SIZE bytes
/// @return bytes written
size_t encodeHello(const Hello& hello, unsigned char* out);

/// Reads the payload.
/// @return what is wrong in a few words, or NULL; `hello` is of use only then
const char* decodeHello(const unsigned char* payload, size_t size, Hello* hello);

/// True if `word` is among the hello's capabilities, for instance "J".
bool hasCapability(const Hello& hello, const char* word);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_HELLO_H
