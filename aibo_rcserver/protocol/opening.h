/// @file opening.h
/// Tells by the first bytes of a connection whether a client of this protocol has made it.
#ifndef AIBO_RCSERVER_PROTOCOL_OPENING_H
#define AIBO_RCSERVER_PROTOCOL_OPENING_H

#include <stddef.h>

namespace protocol {

/// The first bytes of a connection, which may arrive in any pieces.
///
/// A web page can make its visitor's browser connect to any port that the browser reaches, and send much of what the
/// page chooses: HTTP of any method (RFC 9110), TLS, STUN (RFC 5389). Read as requests, these bytes could move the
/// robot. So nothing is carried out for a connection whose first byte is not the letter of a request of version 1, or
/// that begins like a line of HTTP: with a token, which is what a method is (RFC 9110, sections 5.6.2 and 9.1), and a
/// space.
///
/// Letters of methods are letters of requests, too, and a token has no greatest length. So the question stays open
/// while all bytes are those of tokens. Requests of two bytes, which ask for pictures and values, need not wait for the
/// answer: "FU" is a whole request. What has more bytes has to wait while IsUnclear(); no request that could be carried
/// out is so: an identifier, a zero byte, or a full stop in its first bytes says that it is none of HTTP.
///
/// Not thread-safe.
class Opening {
 public:
  enum Verdict {
    UNCLEAR,  ///< the bytes so far may become HTTP
    CLIENT,   ///< they are a client's, as far as they go
    STRANGER  ///< they are not; stays so
  };

  Opening()
      : size_(0),
        is_decided_(false),
        is_stranger_(false),
        is_of_letters_(true),
        is_of_pairs_(true),
        ends_with_space_(false) {}

  /// Adds bytes that have arrived. Once it is clear that they are a client's, more bytes change nothing.
  void add(const unsigned char* bytes, size_t size);

  /// The verdict on all bytes so far.
  Verdict verdict() const;

 private:
  void take(unsigned char byte);
  void decide(bool is_stranger);

  size_t size_;
  bool is_decided_;
  bool is_stranger_;      ///< if it is decided
  bool is_of_letters_;    ///< all bytes so far are
  bool is_of_pairs_;      ///< all so far may be requests of two bytes
  bool ends_with_space_;  ///< which may be the end of a method, or the second byte of a request
};

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_OPENING_H
