#ifndef AIBO_RCSERVER_PROTOCOL_OPENING_H
#define AIBO_RCSERVER_PROTOCOL_OPENING_H

#include <stddef.h>

namespace protocol {

/// Judges the first bytes of a connection, in any pieces. The class is not thread-safe.
///
/// A web page can make its visitor's browser connect to any port, and choose much of what the browser sends: HTTP (RFC
/// 9110), TLS, STUN (RFC 5389). If these bytes were read as requests, they could move the robot. So no request is
/// carried out if the first byte is not a letter of a version 1 request, or if the connection begins like HTTP: with a
/// token, which is what a method is (RFC 9110, sections 5.6.2 and 9.1), and a space.
///
/// Methods consist of letters that are also requests, and a token has no maximum length. So the verdict stays open as
/// long as all bytes are token characters. Requests of two bytes, which ask for pictures and values, do not wait for
/// the verdict: "FU" is a whole request. Longer requests wait while IsUnclear(). A request that could be carried out is
/// never unclear, because an identifier, a zero byte or a full stop among its first bytes rules out HTTP.
class Opening {
 public:
  enum Verdict {
    UNCLEAR,  ///< so far, the bytes could be HTTP
    CLIENT,   ///< so far, the bytes are a client's
    STRANGER  ///< the peer is not a client; this verdict does not change
  };

  Opening()
      : size_(0),
        is_decided_(false),
        is_stranger_(false),
        is_of_letters_(true),
        is_of_pairs_(true),
        ends_with_space_(false) {}

  /// Adds received bytes. After the verdict CLIENT, more bytes change nothing.
  void add(const unsigned char* bytes, size_t size);

  Verdict verdict() const;

  /// True if the connection that begins with these bytes is a stranger's.
  static bool isStrangers(const unsigned char* bytes, size_t size);

 private:
  void take(unsigned char byte);
  void decide(bool is_stranger);

  size_t size_;
  bool is_decided_;
  bool is_stranger_;      ///< true: the verdict is STRANGER
  bool is_of_letters_;    ///< all bytes so far are letters
  bool is_of_pairs_;      ///< all bytes so far can be requests of two bytes
  bool ends_with_space_;  ///< the space may end a method, or be the second byte of a request
};

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_OPENING_H
