/// @file version1_requests.h
/// The requests of version 1 of the protocol, and what its error codes mean.
#ifndef AIBO_DRIVER_CLIENT_VERSION1_REQUESTS_H
#define AIBO_DRIVER_CLIENT_VERSION1_REQUESTS_H

#include <chrono>
#include <string>
#include <vector>

#include "client/call.h"

namespace aibo_client {

/// If a server has not answered `X`, the request for version 2, after this time, it speaks version 1
/// (docs/protocol.md).
constexpr std::chrono::milliseconds kVersionPatience{500};

/// What a server has answered to `X`.
enum class VersionAnswer {
  kNotAsked,
  kNone,      ///< nothing yet; an answer may still come
  kVersion1,  ///< the server has refused version 2
  kVersion2
};

/// Takes the answer to `X` out of what has come.
/// @param[in,out] bytes what has come since then
VersionAnswer takeVersionAnswer(Call::Bytes* bytes);

/// A request for a picture, for the stream, for version 2, or to read a value.
Call::Bytes version1Command(char letter, int identifier);

/// A request to set a value.
Call::Bytes version1SetCommand(char letter, int identifier, short value);

/// The request of a call. It is empty for a picture, and for a request that version 1 does not have.
Call::Bytes version1Request(const Call& call);

/// True if version 1 of the protocol has this request.
bool isKnownToVersion1(const Call& call);

/// Why a version 1 server answered this call with an error code, and what the user can do.
std::string explainRefusal(const Call& call, int code);

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_VERSION1_REQUESTS_H
