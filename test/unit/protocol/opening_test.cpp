#include "protocol/opening.h"

#include <gtest/gtest.h>

#include <string>

#include "protocol/text.h"
#include "protocol/version1.h"

namespace protocol {
namespace {

const std::string kOpenings[] = {"GET ",    "POST ",    "PUT ",   "HEAD ",  "OPTIONS ",
                                 "DELETE ", "CONNECT ", "TRACE ", "PATCH ", "\x16\x03"};

Opening::Verdict add(Opening& opening, const std::string& bytes) {
  return opening.add(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

Opening::Verdict verdictOn(const std::string& bytes) {
  Opening opening;
  return add(opening, bytes);
}

TEST(Opening, RecognisesABrowserInOnePieceAndByteByByte) {
  for (const std::string& method : kOpenings) {
    EXPECT_EQ(verdictOn(method), Opening::BROWSER) << method;
    EXPECT_EQ(verdictOn(method + "/ HTTP/1.1\r\nHost: localhost\r\n\r\n"), Opening::BROWSER) << method;
    Opening opening;
    for (std::size_t i = 0; i + 1 < method.size(); ++i) {
      EXPECT_EQ(add(opening, method.substr(i, 1)), Opening::UNCLEAR) << method << i;
    }
    EXPECT_EQ(add(opening, method.substr(method.size() - 1)), Opening::BROWSER) << method;
  }
}

TEST(Opening, IsClearAtTheFirstByteThatNoMethodHas) {
  for (const std::string& method : kOpenings) {
    for (std::size_t i = 0; i < method.size(); ++i) {
      EXPECT_EQ(verdictOn(method.substr(0, i) + "."), Opening::CLIENT) << method << i;
    }
  }
  EXPECT_EQ(verdictOn("GET\t"), Opening::CLIENT);
  EXPECT_EQ(verdictOn("get "), Opening::CLIENT);
  EXPECT_EQ(verdictOn(" GET /"), Opening::CLIENT);
}

TEST(Opening, VerdictStays) {
  Opening opening;
  EXPECT_EQ(add(opening, "X\2"), Opening::CLIENT);
  EXPECT_EQ(add(opening, "GET / HTTP/1.1\r\n"), Opening::CLIENT);
  Opening browser;
  add(browser, "GET ");
  EXPECT_EQ(add(browser, "X\2"), Opening::BROWSER);
}

TEST(Opening, NothingIsUnclear) {
  EXPECT_EQ(verdictOn(""), Opening::UNCLEAR);
}

// Every request with every identifier; those that name a file, with the names that come closest to a method.
TEST(Opening, NoRequestOfVersion1IsMistaken) {
  for (const char letter : std::string("FWXJSVALYKQR")) {
    for (int identifier = 0; identifier < 256; ++identifier) {
      EXPECT_EQ(verdictOn({letter, static_cast<char>(identifier)}), Opening::CLIENT) << letter << identifier;
    }
  }
  for (const char letter : std::string("PDUC")) {
    for (int identifier = 0; identifier < 256; ++identifier) {
      for (const std::string name : {"", "ST.MTN", "T.MTN", "TCH.MTN", "LETE.MTN", "NNECT.MTN"}) {
        const std::string padded = name + std::string(MAX_MOTION_NAME_SIZE - name.size(), '\0');
        const std::string request = std::string{letter, static_cast<char>(identifier)} + padded;
        EXPECT_EQ(verdictOn(request), Opening::CLIENT) << letter << identifier << name;
      }
    }
  }
}

TEST(Opening, RequestsWithABrowsersOpeningNameNoMotion) {
  for (const std::string& method : kOpenings) {
    const std::string name = method.substr(BASIC_COMMAND_SIZE) + "A.MTN";
    MotionName checked;
    const bool is_request = std::string("PDU").find(method[0]) != std::string::npos;
    EXPECT_TRUE(!is_request || readMotionName(name.data(), name.size(), checked) != nullptr) << method;
  }
}

}  // namespace
}  // namespace protocol
