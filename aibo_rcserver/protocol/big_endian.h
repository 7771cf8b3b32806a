/// Integers of version 2, and a picture's size in version 1: most significant byte first, signed ones in two's
/// complement, on any machine.
#ifndef AIBO_RCSERVER_PROTOCOL_BIG_ENDIAN_H
#define AIBO_RCSERVER_PROTOCOL_BIG_ENDIAN_H

namespace protocol {

/// C++98 has no <stdint.h>, so `int` and `unsigned` hold the 32-bit integers of the protocol.
typedef char IntMustHave32Bits[sizeof(int) == 4 ? 1 : -1];

inline void encodeBigEndian16(unsigned value, unsigned char* out) {
  out[0] = static_cast<unsigned char>((value >> 8) & 0xff);
  out[1] = static_cast<unsigned char>(value & 0xff);
}

inline unsigned short decodeBigEndian16(const unsigned char* in) {
  return static_cast<unsigned short>((in[0] << 8) | in[1]);
}

inline short decodeBigEndianSigned16(const unsigned char* in) {
  return static_cast<short>(decodeBigEndian16(in));
}

inline void encodeBigEndian32(unsigned value, unsigned char* out) {
  encodeBigEndian16(value >> 16, out);
  encodeBigEndian16(value & 0xffff, out + 2);
}

inline unsigned decodeBigEndian32(const unsigned char* in) {
  return (static_cast<unsigned>(decodeBigEndian16(in)) << 16) | decodeBigEndian16(in + 2);
}

inline int decodeBigEndianSigned32(const unsigned char* in) {
  return static_cast<int>(decodeBigEndian32(in));
}

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_BIG_ENDIAN_H
