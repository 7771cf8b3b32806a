/// @file fuzz_input.h
/// What the fuzz targets share.
#ifndef TEST_FUZZ_FUZZ_INPUT_H
#define TEST_FUZZ_FUZZ_INPUT_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

/// What libFuzzer calls with each input; so does replay.cpp with the inputs of the corpus. Always returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

using Bytes = std::vector<std::uint8_t>;

/// Ends the program, which is a finding, unless the condition holds.
inline void require(bool condition, const char* what) {
  if (!condition) {
    std::fprintf(stderr, "finding: not so: %s\n", what);
    std::abort();
  }
}

/// An input, from which a target takes what it needs from the front. At the end there are only zeros.
class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return size_ == 0; }

  unsigned takeByte() {
    if (size_ == 0) {
      return 0;
    }
    --size_;
    return *data_++;
  }

  /// Big-endian.
  unsigned take16() {
    const unsigned high = takeByte();
    return high << 8 | takeByte();
  }

  /// In memory of just that size, so that the sanitizer sees whoever reads on.
  Bytes takeBytes(std::size_t count) {
    count = std::min(count, size_);
    const Bytes bytes(data_, data_ + count);
    data_ += count;
    size_ -= count;
    return bytes;
  }

  Bytes takeAll() { return takeBytes(size_); }

  std::string takeText(std::size_t count) {
    const Bytes bytes = takeBytes(count);
    return {bytes.begin(), bytes.end()};
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// An input that is a stream of bytes as TCP cuts it: the first four bytes are the sizes of the pieces, in turn; 0 is
/// all that is left.
class PiecewiseInput {
 public:
  PiecewiseInput(const std::uint8_t* data, std::size_t size) : input_(data, size), sizes_(input_.takeBytes(4)) {}

  bool empty() const { return input_.empty(); }

  /// Not empty unless the input is.
  Bytes takePiece() {
    const std::size_t size = sizes_[turn_++ % sizes_.size()];
    return size == 0 ? input_.takeAll() : input_.takeBytes(size);
  }

 private:
  FuzzInput input_;
  Bytes sizes_;
  std::size_t turn_ = 0;
};

#endif  // TEST_FUZZ_FUZZ_INPUT_H
