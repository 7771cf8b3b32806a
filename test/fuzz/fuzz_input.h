/// @file fuzz_input.h
/// Shared by all fuzz targets.
#ifndef TEST_FUZZ_FUZZ_INPUT_H
#define TEST_FUZZ_FUZZ_INPUT_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

/// Called by libFuzzer with each input, and by replay.cpp with the inputs of the corpus. Always returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

using Bytes = std::vector<std::uint8_t>;

/// Aborts unless the condition holds. libFuzzer reports this as a finding.
inline void require(bool condition, const char* what) {
  if (!condition) {
    std::fprintf(stderr, "finding: this does not hold: %s\n", what);
    std::abort();
  }
}

/// An input, from which a target takes values in turn. After its end come zeros.
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

  /// In memory of exactly this size, so that the sanitizer sees reads behind the end.
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

/// An input that is a stream of bytes as TCP cuts it. The first four bytes are the sizes of the pieces, in turn; 0
/// means all the rest.
class PiecewiseInput {
 public:
  PiecewiseInput(const std::uint8_t* data, std::size_t size) : input_(data, size), sizes_(input_.takeBytes(4)) {}

  bool empty() const { return input_.empty(); }

  /// Empty only if the input is empty.
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
