#ifndef AIBO_RCSERVER_PROTOCOL_REQUEST_READER_H
#define AIBO_RCSERVER_PROTOCOL_REQUEST_READER_H

#include <stddef.h>

#include "protocol/version1.h"

namespace protocol {

/// One request of a version 1 client, or an invalid one.
struct Request {
  bool valid;             ///< false: unknown letter or wrong size; answered by one error
  BasicGetCommand basic;  ///< letter and identifier
  size_t payload_size;    ///< bytes: 0, 2 (an int16) or 16 (name, a, b)
  unsigned char payload[FILE_PAYLOAD_SIZE];
};

/// Splits the bytes of a version 1 client into requests. It does no I/O, has a fixed size, and is not thread-safe.
///
/// The letter determines the size of most requests, so it does not matter how TCP splits or joins the bytes. But `J`,
/// `S`, `V` and `A` exist in two sizes. Servers since 2005 tell them apart by the number of bytes that arrive together:
///
/// | bytes waiting | meaning |
/// |---|---|
/// | 1 | incomplete |
/// | 2 | a read |
/// | 3 | an incomplete write |
/// | 4 | a write |
/// | more | wrong size: all waiting bytes become one invalid request |
///
/// Bytes wait from append() to next(). If TCP delivers a write as two pairs of bytes, it is mistaken for a read, and
/// version 1 offers no remedy.
///
/// `U` and `C` are followed by content. A caller that wants it calls takeContent() before the next next(), which skips
/// the rest. So the content of a refused file is never mistaken for requests.
///
/// @code
/// while (reader.contentLeft() > 0 && (size = reader.takeContent(bytes, sizeof(bytes))) > 0) { ... }
/// if (reader.contentLeft() == 0) { ... the file is whole; go on with reader.next() ... }
/// @endcode
class RequestReader {
 public:
  /// How many bytes append() always takes if at most one unfinished request is waiting.
  static const size_t MAX_APPENDED = 1024;

  static const size_t MAX_WAITING = MAX_APPENDED + FILE_REQUEST_SIZE;

  RequestReader();

  /// True if a version 1 request can begin with this letter.
  static bool isLetter(char letter);

  /// True if these bytes begin with a whole request.
  static bool beginsWithRequest(const unsigned char* bytes, size_t size) { return frontSize(bytes, size) > 0; }

  /// Adds received bytes.
  /// @return how many bytes were taken: all, if `size` is at most MAX_APPENDED and the last next() returned false or
  ///   the last takeContent() returned 0
  size_t append(const unsigned char* bytes, size_t size);

  /// Takes the next request. What is left of the last request's content is skipped.
  /// @return false if no complete request is waiting
  bool next(Request* request);

  /// Bytes of the announced content that were neither taken nor skipped.
  size_t contentLeft() const { return content_left_; }

  /// Takes waiting bytes of the content.
  /// @param out room for `capacity` bytes
  /// @return the number of bytes; 0 if none are waiting or the content has ended
  size_t takeContent(unsigned char* out, size_t capacity);

  /// The waiting bytes. After the request for version 2 they belong to version 2.
  const unsigned char* waiting() const { return waiting_; }
  size_t waitingSize() const { return waiting_size_; }

  /// Removes bytes from the beginning of the waiting ones.
  void take(size_t size);

 private:
  void skipContent();
  static size_t frontSize(const unsigned char* bytes, size_t size);

  unsigned char waiting_[MAX_WAITING];
  size_t waiting_size_;
  size_t content_left_;
};

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_REQUEST_READER_H
