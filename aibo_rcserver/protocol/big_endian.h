/// @file big_endian.h
/// Integers of version 2 of the protocol: most significant byte first, whatever the machine's byte order and alignment.
#ifndef AIBO_RCSERVER_PROTOCOL_BIG_ENDIAN_H
#define AIBO_RCSERVER_PROTOCOL_BIG_ENDIAN_H

namespace protocol {

/// The wire's 32-bit integers are `int` and `unsigned` in C++98, which has no <stdint.h>.
typedef char IntMustHave32Bits[sizeof(int) == 4 ? 1 : -1];

/// Writes 2 bytes.
inline void encodeBigEndian16(unsigned value, unsigned char* out) {
  out[0] = static_cast<unsigned char>((value >> 8) & 0xff);
  out[1] = static_cast<unsigned char>(value & 0xff);
}

/// Reads 2 bytes.
inline unsigned short decodeBigEndian16(const unsigned char* in) {
  return static_cast<unsigned short>((in[0] << 8) | in[1]);
}

/// Writes 2 bytes in two's complement.
inline void encodeBigEndianSigned16(short value, unsigned char* out) {
  encodeBigEndian16(static_cast<unsigned short>(value), out);
}

/// Reads 2 bytes in two's complement.
inline short decodeBigEndianSigned16(const unsigned char* in) {
  return static_cast<short>(decodeBigEndian16(in));
}

/// Writes 4 bytes.
inline void encodeBigEndian32(unsigned value, unsigned char* out) {
  encodeBigEndian16(value >> 16, out);
  encodeBigEndian16(value & 0xffff, out + 2);
}

/// Reads 4 bytes.
inline unsigned decodeBigEndian32(const unsigned char* in) {
  return (static_cast<unsigned>(decodeBigEndian16(in)) << 16) | decodeBigEndian16(in + 2);
}

/// Writes 4 bytes in two's complement.
inline void encodeBigEndianSigned32(int value, unsigned char* out) {
  encodeBigEndian32(static_cast<unsigned>(value), out);
}

/// Reads 4 bytes in two's complement.
inline int decodeBigEndianSigned32(const unsigned char* in) {
  return static_cast<int>(decodeBigEndian32(in));
}

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_BIG_ENDIAN_H
