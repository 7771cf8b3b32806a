/// @file frame_reader.h
/// Splits the bytes of a version 2 connection into frames. Used by both sides.
#ifndef AIBO_RCSERVER_PROTOCOL_FRAME_READER_H
#define AIBO_RCSERVER_PROTOCOL_FRAME_READER_H

#include <stddef.h>

#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// Splits a byte stream into frames, however TCP splits or joins the bytes. No I/O, and no memory but the buffer that
/// it is given. A frame that announces more than the buffer holds is refused as soon as its header is complete.
///
/// @code
/// while (size > 0) {
///   size_t taken = 0;
///   switch (reader.append(bytes, size, &taken)) { ... handle reader.header() and reader.payload(), or give up ... }
///   bytes += taken;
///   size -= taken;
/// }
/// @endcode
///
/// Not thread-safe.
class FrameReader {
 public:
  /// The result of append().
  enum Result {
    FRAME_INCOMPLETE,  ///< all bytes are taken, and more are needed
    FRAME_COMPLETE,    ///< header() and payload() hold a frame
    FRAME_TOO_LARGE    ///< header() announces more than the buffer holds, a protocol error: close the connection
  };

  /// @param buffer room for one payload; owned by the caller, and must outlive the reader
  /// @param capacity bytes of the buffer, and so the largest payload: MAX_PAYLOAD_TOWARDS_CLIENT in a client,
  ///                 MAX_PAYLOAD_TOWARDS_ROBOT in a server
  FrameReader(unsigned char* buffer, size_t capacity);

  /// Forgets all bytes, for a new connection.
  void reset();

  /// Adds received bytes, at most up to the end of one frame. The call after a complete frame begins the next one.
  /// After FRAME_TOO_LARGE the beginning of the next frame is unknown: until reset(), every call takes all bytes and
  /// returns FRAME_TOO_LARGE.
  /// @param[out] taken how many of the bytes were used; not 0 unless `size` is 0
  Result append(const unsigned char* bytes, size_t size, size_t* taken);

  /// True if the next byte is the first of a frame.
  bool isBetweenFrames() const;

  /// Header of the frame; valid after FRAME_COMPLETE and FRAME_TOO_LARGE until the next call of append().
  const FrameHeader& header() const;

  /// The frame's header().payload_size bytes; valid after FRAME_COMPLETE until the next call of append().
  const unsigned char* payload() const;

 private:
  FrameReader(const FrameReader&);
  FrameReader& operator=(const FrameReader&);

  size_t appendHeader(const unsigned char* bytes, size_t size);
  size_t appendPayload(const unsigned char* bytes, size_t size);
  bool hasHeader() const;
  Result result() const;

  unsigned char* const buffer_;
  const size_t capacity_;
  unsigned char header_bytes_[FRAME_HEADER_SIZE];
  size_t header_bytes_size_;
  FrameHeader header_;
  size_t payload_size_;  ///< bytes of the payload received so far
};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_FRAME_READER_H
