/// @file bytes.h
/// Bytes in the tests' notation.
#ifndef TEST_UNIT_PROTOCOL_BYTES_H
#define TEST_UNIT_PROTOCOL_BYTES_H

#include <string>
#include <vector>

namespace protocol {

using Bytes = std::vector<unsigned char>;

/// "00 1f ff" as bytes.
inline Bytes hex(const std::string& digits) {
  Bytes bytes;
  for (size_t i = 0; i < digits.size(); i += 3) {
    bytes.push_back(static_cast<unsigned char>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

inline Bytes bytesOf(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

inline Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// The first `size` bytes, in memory of exactly that size, so that a sanitizer finds reads beyond the end.
inline Bytes firstOf(const Bytes& bytes, size_t size) {
  return Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
}

}  // namespace protocol

#endif  // TEST_UNIT_PROTOCOL_BYTES_H
