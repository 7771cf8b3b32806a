/// @file introduction.h
/// What a client of version 2 sends first when it comes back: the request for version 2, and a hello with the token
/// that the server gave it over its last connection. All in one piece, without waiting for an answer in between, so
/// that the server can tell it at once from a stranger.
#ifndef AIBO_RCSERVER_PROTOCOL_INTRODUCTION_H
#define AIBO_RCSERVER_PROTOCOL_INTRODUCTION_H

#include <stddef.h>

#include "protocol/hello.h"

namespace protocol {
namespace version2 {

/// Most bytes of the payload of `H`: `token=` and the token.
const size_t MAX_HELLO_REQUEST_SIZE = 6 + TOKEN_SIZE;

const size_t INTRODUCTION_SIZE = BASIC_COMMAND_SIZE + FRAME_HEADER_SIZE + MAX_HELLO_REQUEST_SIZE;

/// The number of the hello in an introduction.
const unsigned short INTRODUCTION_NUMBER = 1;

/// Writes INTRODUCTION_SIZE bytes.
/// @param token valid (isToken())
size_t encodeIntroduction(const char* token, unsigned char* out);

/// True if a connection that begins with these bytes begins with an introduction.
/// @param[out] token of the introduction, with an end mark; any text
bool decodeIntroduction(const unsigned char* bytes, size_t size, char (&token)[TOKEN_SIZE + 1]);

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_INTRODUCTION_H
