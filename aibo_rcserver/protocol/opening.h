/// @file opening.h
/// Tells by the first bytes of a connection whether a web browser has made it.
#ifndef AIBO_RCSERVER_PROTOCOL_OPENING_H
#define AIBO_RCSERVER_PROTOCOL_OPENING_H

#include <stddef.h>

namespace protocol {

/// The first bytes of a connection, which may arrive in any pieces.
///
/// A web page can make its visitor's browser send HTTP, with a body of its choice, to any port that the browser
/// reaches, also to one that only the visitor's own computer may use. Read as requests, such a body could move the
/// robot. So a connection is dropped if its first bytes are one of HTTP's methods with the space after it, or the
/// beginning of TLS's first message. They are held until this is clear, which takes at most LONGEST bytes.
///
/// No request of version 1 that could be carried out is mistaken for HTTP, and none waits. Only `P`, `D` and `C` are
/// letters both of requests and of methods, and these requests have 18 bytes, of which bytes 3 to 14 are the name of a
/// file: "POST " would be the name "ST ...", "DELETE " would be "LETE ...". No name of a motion contains a space, and
/// `C` is always refused. The other methods, and TLS's byte 0x16, begin with a byte that is no request's; after that
/// byte, the answer "unknown" comes when it is clear that there is no method.
///
/// Not thread-safe.
class Opening {
 public:
  enum Verdict {
    UNCLEAR,  ///< the bytes so far may become a browser's
    CLIENT,   ///< not a browser
    BROWSER   ///< HTTP or TLS
  };

  /// Most bytes that can be UNCLEAR and one more: "OPTIONS ".
  static const size_t LONGEST = 8;

  Opening() : size_(0), verdict_(UNCLEAR) {}

  /// Adds bytes that have arrived. After the verdict, more bytes change nothing.
  /// @return the verdict on all bytes so far
  Verdict add(const unsigned char* bytes, size_t size);

  Verdict verdict() const { return verdict_; }

 private:
  Verdict judge() const;

  char bytes_[LONGEST];
  size_t size_;
  Verdict verdict_;
};

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_OPENING_H
