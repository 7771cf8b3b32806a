/// @file request_reader.h
/// Splits the bytes a version 1 client sends into requests.
#ifndef AIBO_RCSERVER_PROTOCOL_REQUEST_READER_H
#define AIBO_RCSERVER_PROTOCOL_REQUEST_READER_H

#include <stddef.h>

#include "protocol/version1.h"

namespace protocol {

/// One request of a version 1 client, or what was found in its place.
struct Request {
  bool valid;             ///< false: an unknown letter or a wrong size, to be answered by one error
  BasicGetCommand basic;  ///< letter and identifier
  size_t payload_size;    ///< bytes of payload: 0, 2 (an int16) or 16 (name, a, b)
  unsigned char payload[FILE_REQUEST_SIZE - BASIC_COMMAND_SIZE];  ///< what follows letter and identifier
};

/// Splits a byte stream into version 1 requests. No I/O, and memory of a fixed size.
///
/// Nearly every request has the size that its letter says, so that it does not matter how TCP splits or joins the
/// bytes. `J`, `S`, `V` and `A` exist in two sizes, and servers since 2005 have told them apart by the number of bytes
/// that were there at once. For a request that begins with one of these four letters:
///
/// | bytes waiting | what it is |
/// |---|---|
/// | 1 | not enough yet |
/// | 2 | a read |
/// | 3 | the beginning of a write: the last byte is waited for |
/// | 4 | a write |
/// | more | a wrong size: all that is waiting makes one invalid request |
///
/// "Waiting" is what append() has brought and next() has not taken. A write whose four bytes TCP delivers two by two is
/// therefore taken for a read; version 1 has no cure for that.
///
/// After `U` and `C` follow as many bytes of content as the request announces. Who wants them takes them by
/// takeContent() before the next call of next(), which skips what it finds of them: the content of a refused file is
/// never taken for requests.
///
/// @code
/// while (reader.contentLeft() > 0 && (size = reader.takeContent(bytes, sizeof(bytes))) > 0) { ... }
/// if (reader.contentLeft() == 0) { ... the file is whole; go on with reader.next() ... }
/// @endcode
///
/// Not thread-safe.
class RequestReader {
 public:
  /// Most bytes one append() takes while no more than one unfinished request is waiting.
  static const size_t MAX_APPENDED = 1024;

  /// Most bytes that can be waiting.
  static const size_t MAX_WAITING = MAX_APPENDED + FILE_REQUEST_SIZE;

  /// Most requests next() can find in what one append() has brought: the shortest request has two bytes.
  static const size_t MAX_REQUESTS = MAX_WAITING / BASIC_COMMAND_SIZE;

  RequestReader();

  /// Forgets everything: a new client.
  void reset();

  /// Adds received bytes.
  /// @return how many were taken: all of them if `size` is at most MAX_APPENDED and next() has said false, or
  ///         takeContent() 0, before
  size_t append(const unsigned char* bytes, size_t size);

  /// Takes the next request out of the waiting bytes, behind the content of the last one.
  /// @return false if there is no whole one
  bool next(Request* request);

  /// Bytes of content that the last request of next() has announced and that are neither taken nor skipped.
  size_t contentLeft() const;

  /// Takes bytes of this content out of the waiting ones.
  /// @param out room for `capacity` bytes
  /// @return how many; 0 if none is waiting, and at the end of the content
  size_t takeContent(unsigned char* out, size_t capacity);

  /// Takes out all bytes that were added and that no request was made of: behind the request for version 2 they are
  /// version 2's.
  /// @param[out] out room for MAX_WAITING bytes
  /// @return how many there were
  size_t takeWaiting(unsigned char* out);

 private:
  void skipContent();
  size_t frontSize() const;
  void consume(size_t size);

  unsigned char waiting_[MAX_WAITING];
  size_t waiting_size_;
  size_t content_left_;
};

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_REQUEST_READER_H
