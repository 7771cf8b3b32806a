/// @file utf8.h
/// Text on the wire: UTF-8 without control characters.
#ifndef AIBO_RCSERVER_PROTOCOL_UTF8_H
#define AIBO_RCSERVER_PROTOCOL_UTF8_H

#include <stddef.h>

namespace protocol {

/// True if the bytes are well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF) and
/// hold no control character (U+0000..U+001F, U+007F..U+009F): what the other side sends may go into a log or onto a
/// terminal as it is. An empty text is one.
bool isPlainText(const char* bytes, size_t size);

/// The greatest size at most `limit` at which a well-formed text can be cut without cutting a character in two.
size_t sizeOfWholeCharacters(const char* bytes, size_t size, size_t limit);

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_UTF8_H
