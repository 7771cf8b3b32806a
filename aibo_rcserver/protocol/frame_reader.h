/// @file frame_reader.h
/// Splits the bytes of a version 2 connection into frames. Used by both sides.
#ifndef AIBO_RCSERVER_PROTOCOL_FRAME_READER_H
#define AIBO_RCSERVER_PROTOCOL_FRAME_READER_H

#include <stddef.h>

#include "protocol/version2.h"

namespace protocol {
namespace version2 {

/// Splits a byte stream into frames, however TCP splits or joins the bytes. No I/O, and no memory but the buffer it is
/// given once: a frame that announces more than fits in there is refused as soon as its header is whole.
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
  /// What append() has come to.
  enum Result {
    FRAME_INCOMPLETE,  ///< all bytes are taken, and more are needed
    FRAME_COMPLETE,    ///< header() and payload() hold a frame
    FRAME_TOO_LARGE    ///< header() announces more than the buffer holds: a protocol error, close the connection
  };

  /// @param buffer room for one payload; stays the caller's and has to outlive the reader
  /// @param capacity bytes of the buffer, which is the limit for a payload: MAX_PAYLOAD_TOWARDS_CLIENT in a client,
  ///                 MAX_PAYLOAD_TOWARDS_ROBOT in a server, and whatever is tight enough in a test
  FrameReader(unsigned char* buffer, size_t capacity);

  /// Forgets everything: a new connection.
  void reset();

  /// Adds received bytes, at most up to the end of one frame. The call after a complete frame begins the next one.
  /// After FRAME_TOO_LARGE there is no telling where a frame begins: every call takes all bytes and says so again,
  /// until reset().
  /// @param[out] taken how many of the bytes were used; never 0 if `size` is not
  Result append(const unsigned char* bytes, size_t size, size_t* taken);

  /// True if no byte of an unfinished frame has been taken: the next byte is the first of a frame.
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
  size_t payload_size_;  ///< bytes of the payload that are there
};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_FRAME_READER_H
