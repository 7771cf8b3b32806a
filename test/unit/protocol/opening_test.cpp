#include "protocol/opening.h"

#include <gtest/gtest.h>

#include <string>

#include "protocol/version1.h"

namespace protocol {
namespace {

// RFC 9110, 5789, 5323, 3253, 4918; QUERY and the preface of HTTP/2 (RFC 9113); RTSP; some that a page makes up.
const std::string kMethods[] = {"GET",      "POST",  "PUT",     "HEAD",           "OPTIONS",  "DELETE", "CONNECT",
                                "TRACE",    "PATCH", "QUERY",   "SEARCH",         "REPORT",   "LOCK",   "COPY",
                                "PROPFIND", "ACL",   "PRI",     "PLAY",           "DESCRIBE", "R",      "Q",
                                "J",        "F",     "FU",      "JUMP",           "Queery",   "Q-1.x",  "FUFUFU",
                                "XX",       "L",     "KICKOFF", "VERSION-CONTROL"};

Opening::Verdict add(Opening& opening, const std::string& bytes) {
  opening.add(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return opening.verdict();
}

Opening::Verdict verdictOn(const std::string& bytes) {
  Opening opening;
  return add(opening, bytes);
}

TEST(Opening, RecognisesHttpOfAnyMethodInOnePieceAndByteByByte) {
  for (const std::string& method : kMethods) {
    for (const std::string target : {" /", " *", " http://localhost/"}) {
      const std::string line = method + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
      EXPECT_EQ(verdictOn(line), Opening::STRANGER) << line;
      Opening opening;
      for (const char byte : line) {
        add(opening, {byte});
      }
      EXPECT_EQ(opening.verdict(), Opening::STRANGER) << line;
    }
  }
}

// STUN over TCP as Chromium sends it (RFC 5389, RFC 4571), TURN, TLS, SMB, a proxy's request, JSON.
TEST(Opening, RecognisesOtherProtocolsByTheFirstByte) {
  for (const std::string& bytes :
       {std::string("\0\x80\0\1\0\x6c\x21\x12\xa4\x42", 10), std::string("\0\3\0\4", 4), std::string("\x16\3\1"),
        std::string("\0\0\0\x85\xffSMB", 8), std::string("\5\1\0", 3), std::string("{\"J\":1}"), std::string("get /"),
        std::string("\r\nX\2"), std::string(" X\2"), std::string("H\0\0\1\0\0\0\0", 8), std::string("\xefJ")}) {
    EXPECT_EQ(verdictOn(bytes.substr(0, 1)), Opening::STRANGER) << bytes;
    EXPECT_EQ(verdictOn(bytes), Opening::STRANGER) << bytes;
  }
}

// Every request with every identifier, alone and twice; those that name a file, with the names that come closest to a
// method.
TEST(Opening, NoRequestOfVersion1IsMistaken) {
  for (const char letter : std::string("FWXJSVA")) {
    for (int identifier = 0; identifier < 256; ++identifier) {
      const std::string request = {letter, static_cast<char>(identifier)};
      EXPECT_NE(verdictOn(request), Opening::STRANGER) << letter << identifier;
      EXPECT_NE(verdictOn(request + request), Opening::STRANGER) << letter << identifier;
    }
  }
  for (const char letter : std::string("JSVALYKQR")) {
    for (const int identifier : {0, 1, 33, 44, 52, 62, 255}) {
      for (const int value : {0, 1, 255, 0x1921, 0x2121}) {
        const std::string request = {letter, static_cast<char>(identifier), static_cast<char>(value & 0xff),
                                     static_cast<char>(value >> 8)};
        EXPECT_EQ(verdictOn(request), Opening::CLIENT) << letter << identifier << " " << value;
      }
    }
  }
  for (const char letter : std::string("PDUC")) {
    for (int identifier = 0; identifier < 256; ++identifier) {
      for (const std::string name : {"", "ST.MTN", "T.MTN", "TCH.MTN", "LETE.MTN", "NNECT.MTN", "ABCDEFGH.MTN"}) {
        const std::string padded = name + std::string(MAX_MOTION_NAME_SIZE - name.size(), '\0') + std::string(4, '\1');
        const std::string request = std::string{letter, static_cast<char>(identifier)} + padded;
        EXPECT_EQ(verdictOn(request), Opening::CLIENT) << letter << identifier << name;
      }
    }
  }
}

}  // namespace
}  // namespace protocol
