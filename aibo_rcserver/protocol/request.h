/// What both sides have to know about a version 2 request, apart from its payload.
#ifndef AIBO_RCSERVER_PROTOCOL_REQUEST_H
#define AIBO_RCSERVER_PROTOCOL_REQUEST_H

namespace protocol {
namespace version2 {

/// What a request does, as bits.
enum Trait {
  STOPS_ROBOT = 1,          ///< holds joints or switches the motors off; goes before everything else
  STOPS_MOTIONS = 2,        ///< stops one motion or all
  STARTS_MOVEMENT = 4,      ///< a stop cancels the request
  TAKES_OVER_JOINTS = 8,    ///< decides the positions of joints from then on
  ENDS_WALK = 16,           ///< forbids earlier requests to begin a walk
  MOVES_BODY = 32,          ///< the request is not supported by a robot that cannot walk
  NEEDS_MEMORY_STICK = 64,  ///< the answer needs the stick; such requests wait for one another
  FETCHES_FILE = 128        ///< the answer is a file and can take long
};

/// A row in the table of requests, beside its payload. A letter has several rows if its requests do different things.
struct Request {
  char letter;
  const char* words;    ///< what the request does, in words to put after "refused to "
  int traits;           ///< bits of Trait
  const char* setting;  ///< the line of RCSERVER.CFG that has to allow the request, or NULL

  bool has(Trait trait) const { return (traits & trait) != 0; }
};

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_REQUEST_H
