/// @file reply_scanner.h
#ifndef TEST_SUPPORT_PROXY_REPLY_SCANNER_H
#define TEST_SUPPORT_PROXY_REPLY_SCANNER_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fault_bench {

/// Finds where pictures begin in what a server sends over one connection, whichever version of the protocol it speaks
/// and however TCP has cut it.
class ReplyScanner {
 public:
  /// Takes the stream's next bytes.
  /// @return where in the stream pictures begin whose header's first byte is among them: offsets, ascending
  std::vector<std::uint64_t> feed(const std::uint8_t* data, std::size_t size);

 private:
  std::size_t headerSize() const;
  void takeHeader();

  std::uint64_t offset_ = 0;  // of the next byte
  bool version2_ = false;
  bool lost_ = false;  // what came is no reply: nothing tells where the next one begins
  std::vector<std::uint8_t> header_;
  std::uint64_t skip_ = 0;  // bytes of the present reply that are still to come
};

}  // namespace fault_bench

#endif  // TEST_SUPPORT_PROXY_REPLY_SCANNER_H
