#ifndef AIBO_RCSERVER_PROTOCOL_FRAME_READER_H
#define AIBO_RCSERVER_PROTOCOL_FRAME_READER_H

#include <stddef.h>

#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// Splits a byte stream into frames, however TCP splits or joins the bytes. It uses no memory except the given buffer.
/// It refuses a frame that is larger than the buffer as soon as the header is complete. The class is not thread-safe.
///
/// @code
/// while (size > 0) {
///   size_t taken = 0;
///   switch (reader.append(bytes, size, &taken)) { ... handle reader.header() and reader.payload(), or give up ... }
///   bytes += taken;
///   size -= taken;
/// }
/// @endcode
class FrameReader {
 public:
  enum Result {
    FRAME_INCOMPLETE,  ///< all bytes have been read, and the frame needs more
    FRAME_COMPLETE,    ///< header() and payload() hold a frame
    FRAME_TOO_LARGE    ///< header() announces more than the buffer holds: a protocol error, so close the connection
  };

  /// @param buffer room for one payload
  /// @param capacity the largest payload, in bytes: MAX_PAYLOAD_TOWARDS_CLIENT in a client, MAX_PAYLOAD_TOWARDS_ROBOT
  ///   in a server
  FrameReader(unsigned char* buffer, size_t capacity);

  /// Call this for a new connection.
  void reset();

  /// Adds received bytes, at most up to the end of a frame. The next call begins the next frame. After FRAME_TOO_LARGE
  /// nobody knows where the next frame begins, so every call takes all bytes and returns FRAME_TOO_LARGE until reset().
  /// @param[out] taken how many bytes were used; not 0 unless `size` is 0
  Result append(const unsigned char* bytes, size_t size, size_t* taken);

  bool isBetweenFrames() const;

  /// The header of the frame. It is valid after FRAME_COMPLETE and FRAME_TOO_LARGE, until the next append().
  const FrameHeader& header() const { return header_; }

  /// The payload, header().payload_size bytes. It is valid after FRAME_COMPLETE, until the next append().
  const unsigned char* payload() const { return buffer_; }

 private:
  FrameReader(const FrameReader&);
  FrameReader& operator=(const FrameReader&);

  size_t appendHeader(const unsigned char* bytes, size_t size);
  size_t appendPayload(const unsigned char* bytes, size_t size);
  bool hasHeader() const { return header_bytes_size_ == FRAME_HEADER_SIZE; }
  Result result() const;

  unsigned char* const buffer_;
  const size_t capacity_;
  unsigned char header_bytes_[FRAME_HEADER_SIZE];
  size_t header_bytes_size_;
  FrameHeader header_;
  size_t payload_size_;  ///< bytes received so far
};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_FRAME_READER_H
