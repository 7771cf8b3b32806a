/// @file version1_requests.h
/// The requests of version 1 of the protocol, and what its error codes mean.
#ifndef AIBO_DRIVER_CLIENT_VERSION1_REQUESTS_H
#define AIBO_DRIVER_CLIENT_VERSION1_REQUESTS_H

#include <string>
#include <vector>

#include "client/call.h"

namespace aibo_client {

/// A picture, the stream, or a value that is read.
Call::Bytes version1Command(char letter, int identifier);

/// A value that is set.
Call::Bytes version1SetCommand(char letter, int identifier, short value);

/// The request of a call. It is empty if version 1 does not have it, and for a picture.
Call::Bytes version1Request(const Call& call);

/// True if version 1 of the protocol has this request.
bool isKnownToVersion1(const Call& call);

/// Why a version 1 server answered this call with an error code, and what the user can do.
std::string explainRefusal(const Call& call, int code);

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_VERSION1_REQUESTS_H
