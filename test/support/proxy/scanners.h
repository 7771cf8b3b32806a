/// @file scanners.h
/// What goes over a connection between a client and a server, however TCP has cut it.
#ifndef TEST_SUPPORT_PROXY_SCANNERS_H
#define TEST_SUPPORT_PROXY_SCANNERS_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "protocol/frame_reader.h"
#include "support/proxy/fault.h"

namespace test_support {

/// Finds the pictures in what a server sends over one connection, in either version of the protocol.
class ReplyScanner {
 public:
  /// @param on_picture called with the JPEG of each picture that is complete
  explicit ReplyScanner(std::function<void(Bytes jpeg)> on_picture = nullptr) : on_picture_(std::move(on_picture)) {}

  /// Takes the stream's next bytes.
  /// @return where in the stream pictures begin whose header's first byte is among them: offsets, ascending
  std::vector<std::uint64_t> feed(const std::uint8_t* data, std::size_t size);

 private:
  std::size_t headerSize() const;
  void takeHeader();
  void takePayload(const std::uint8_t* data, std::size_t size);

  const std::function<void(Bytes jpeg)> on_picture_;
  std::uint64_t offset_ = 0;  // of the next byte
  bool version2_ = false;
  bool lost_ = false;  // something that is not a reply has come: the next one cannot be found
  Bytes header_;
  std::uint64_t payload_left_ = 0;  // bytes of the present reply that are still to come
  bool in_picture_ = false;
  Bytes payload_;  // of the present picture, if somebody wants it
};

/// A request of either version of the protocol.
struct Request {
  char kind = 0;
  int id = 0;      ///< quality of `F` and `W`
  int number = 0;  ///< of the request; 0 in version 1
  Bytes payload{};
  bool version2 = false;
};

/// Finds the requests in what a client sends over one connection: commands of two bytes, and frames once it has asked
/// for version 2.
class RequestScanner {
 public:
  /// @param knows_version2 whether the server agrees to version 2
  explicit RequestScanner(bool knows_version2 = true) : knows_version2_(knows_version2) {}

  /// Takes the stream's next bytes.
  /// @return the requests that they complete
  std::vector<Request> feed(const std::uint8_t* data, std::size_t size);

 private:
  const bool knows_version2_;
  bool version2_ = false;
  Bytes command_;  // of version 1, as far as it has come
  Bytes payload_ = Bytes(protocol::version2::MAX_PAYLOAD_TOWARDS_ROBOT);
  protocol::version2::FrameReader frames_{payload_.data(), payload_.size()};
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_SCANNERS_H
