/// @file request_reader.h
/// Splits the bytes that a version 1 client sends into requests.
#ifndef AIBO_RCSERVER_PROTOCOL_REQUEST_READER_H
#define AIBO_RCSERVER_PROTOCOL_REQUEST_READER_H

#include <stddef.h>

#include "protocol/version1.h"

namespace protocol {

/// One request of a version 1 client, or an invalid one.
struct Request {
  bool valid;             ///< false: unknown letter or wrong size; answered by one error
  BasicGetCommand basic;  ///< letter and identifier
  size_t payload_size;    ///< bytes of payload: 0, 2 (an int16) or 16 (name, a, b)
  unsigned char payload[FILE_REQUEST_SIZE - BASIC_COMMAND_SIZE];  ///< the bytes after letter and identifier
};

/// Splits a byte stream into version 1 requests. No I/O, and memory of a fixed size.
///
/// For most requests the letter determines the size, so it does not matter how TCP splits or joins the bytes. But `J`,
/// `S`, `V` and `A` exist in two sizes, and servers since 2005 have distinguished them by the number of bytes that
/// arrived together. For a request that begins with one of these four letters:
///
/// | bytes waiting | meaning |
/// |---|---|
/// | 1 | incomplete |
/// | 2 | a read |
/// | 3 | an incomplete write |
/// | 4 | a write |
/// | more | wrong size: all waiting bytes become one invalid request |
///
/// "Waiting" bytes are those that append() has added and next() has not taken. So a write whose four bytes TCP delivers
/// in two pairs is mistaken for a read; version 1 offers no way around that.
///
/// The content that `U` and `C` announce follows them. A caller that wants it calls takeContent() before the next
/// next(), which skips the rest of the content. So the content of a refused file is never mistaken for requests.
///
/// @code
/// while (reader.contentLeft() > 0 && (size = reader.takeContent(bytes, sizeof(bytes))) > 0) { ... }
/// if (reader.contentLeft() == 0) { ... the file is whole; go on with reader.next() ... }
/// @endcode
///
/// Not thread-safe.
class RequestReader {
 public:
  /// Bytes that one append() always takes if at most one unfinished request is waiting.
  static const size_t MAX_APPENDED = 1024;

  /// Most bytes that can be waiting.
  static const size_t MAX_WAITING = MAX_APPENDED + FILE_REQUEST_SIZE;

  /// Most requests that next() can find after one append(). The shortest request has two bytes.
  static const size_t MAX_REQUESTS = MAX_WAITING / BASIC_COMMAND_SIZE;

  RequestReader();

  /// True if requests of version 1 can begin with this.
  static bool isLetter(char letter);

  /// True if a connection that begins with these bytes begins with a whole request.
  static bool beginsWithRequest(const unsigned char* bytes, size_t size) { return frontSize(bytes, size) > 0; }

  /// Forgets all bytes, for a new client.
  void reset();

  /// Adds received bytes.
  /// @return how many were taken: all of them if `size` is at most MAX_APPENDED and the last next() returned false or
  ///         the last takeContent() returned 0
  size_t append(const unsigned char* bytes, size_t size);

  /// Takes the next request out of the waiting bytes, after the content of the last one.
  /// @return false if no complete request is waiting
  bool next(Request* request);

  /// Bytes of content that the last request announced and that have been neither taken nor skipped.
  size_t contentLeft() const;

  /// Takes bytes of this content out of the waiting bytes.
  /// @param out room for `capacity` bytes
  /// @return how many; 0 if none are waiting, and at the end of the content
  size_t takeContent(unsigned char* out, size_t capacity);

  /// True if no bytes are waiting.
  bool isEmpty() const { return waiting_size_ == 0; }

  /// Takes all waiting bytes. After the request for version 2 they belong to version 2.
  /// @param[out] out room for MAX_WAITING bytes
  /// @return how many there were
  size_t takeWaiting(unsigned char* out);

 private:
  void skipContent();
  static size_t frontSize(const unsigned char* bytes, size_t size);
  void consume(size_t size);

  unsigned char waiting_[MAX_WAITING];
  size_t waiting_size_;
  size_t content_left_;
};

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_REQUEST_READER_H
