#include "client/client_options.h"

#include <gmock/gmock.h>

#include "aibo_driver/exceptions.h"

using aibo_driver::ClientOptions;
using aibo_driver::InvalidArgumentException;
using aibo_driver::RcServerClient;
using std::chrono::milliseconds;
using testing::HasSubstr;

namespace {

template <typename Change>
std::string complaintAbout(const Change& change) {
  ClientOptions options;
  change(options);
  try {
    RcServerClient client(options, {});
  } catch (const InvalidArgumentException& error) {
    return error.what();
  }
  return "";
}

TEST(ClientOptionsTest, TheDefaultsAreAllowed) {
  EXPECT_EQ("", complaintAbout([](ClientOptions&) {}));
}

TEST(ClientOptionsTest, ABadOptionIsNamedWithItsRange) {
  EXPECT_THAT(complaintAbout([](ClientOptions& o) { o.host = ""; }), HasSubstr("host is empty"));
  EXPECT_EQ("port is 0, but has to be 1..65535", complaintAbout([](ClientOptions& o) { o.port = 0; }));
  EXPECT_THAT(complaintAbout([](ClientOptions& o) { o.port = 65536; }), HasSubstr("port"));
  EXPECT_THAT(complaintAbout([](ClientOptions& o) { o.jpeg_quality = 0; }), HasSubstr("jpeg_quality"));
  EXPECT_THAT(complaintAbout([](ClientOptions& o) { o.jpeg_quality = 101; }), HasSubstr("1..100"));
  EXPECT_THAT(complaintAbout([](ClientOptions& o) { o.protocol_version = 2; }), HasSubstr("protocol_version"));
  EXPECT_EQ("connect_timeout is 49 ms, but has to be 50..60000 ms",
            complaintAbout([](ClientOptions& o) { o.connect_timeout = milliseconds(49); }));
  EXPECT_THAT(complaintAbout([](ClientOptions& o) { o.read_timeout = milliseconds(60001); }),
              HasSubstr("read_timeout"));
  EXPECT_THAT(complaintAbout([](ClientOptions& o) { o.reconnect_wait_min = milliseconds(9); }),
              HasSubstr("reconnect_wait_min"));
  EXPECT_THAT(complaintAbout([](ClientOptions& o) { o.reconnect_wait_min = milliseconds(2001); }),
              HasSubstr("10..2000 ms"));
  EXPECT_THAT(complaintAbout([](ClientOptions& o) { o.reconnect_wait_max = milliseconds(60001); }),
              HasSubstr("reconnect_wait_max"));
}

}  // namespace
