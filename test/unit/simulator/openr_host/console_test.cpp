// The wireless console.
#include <OPENR/OSyslog.h>
#include <gmock/gmock.h>

#include "simulator/openr_host/machine.h"
#include "support/raw_client.h"
#include "test_system.h"

namespace openr_host {
namespace {

using test_support::TestClient;

class ConsoleTest : public testing::Test {
 protected:
  ConsoleTest() {
    test_.boot();
    port_ = test_.system.console().takePort("127.0.0.1", 0);
  }

  /// Prints until this listener receives something, which shows that it has been accepted.
  void awaitAccepted(TestClient& listener) {
    ASSERT_TRUE(test_.runUntil([&] {
      test_.as(object_, [] { OSYSPRINT(("%s", ".")); });
      return !listener.received().empty();
    }));
  }

  TestSystem test_;
  TestObject& object_ = test_.add("Object");
  std::uint16_t port_ = 0;
};

TEST_F(ConsoleTest, ALogLineNamesItsPriorityAndItsObject) {
  test_.as(object_, [] {
    OSYSLOG1((osyslogERROR, "no %s", "image"));
    OSYSLOG1((osyslogWARNING, "hm"));
    OSYSLOG1((osyslogINFO, "well"));
    OSYSDEBUG(("not in this build\n"));
  });
  EXPECT_EQ(test_.output.str(), "ERROR Object: no image\nWARNING Object: hm\nINFO Object: well\n");
}

TEST_F(ConsoleTest, EachTypedLineIsAnsweredToItsListener) {
  std::vector<std::string> lines;
  test_.on_console_line = [&](const std::string& line) {
    lines.push_back(line);
    return "answer to " + line + "\n";
  };
  TestClient typing(port_);
  TestClient other(port_);
  typing.send("pre");
  test_.runPending();
  EXPECT_TRUE(lines.empty()) << "the line is not finished";
  typing.send("ss chin\r\n\r\nhe\xff\xfb\x01lp\nun");
  ASSERT_TRUE(test_.runUntil([&] { return typing.received().size() >= 36; }));
  EXPECT_THAT(lines, testing::ElementsAre("press chin", "help"));
  EXPECT_EQ(typing.received(), "answer to press chin\nanswer to help\n");
  EXPECT_EQ(other.received(), "");
}

// The lines after the first would be obeyed.
TEST_F(ConsoleTest, NothingIsObeyedOfAListenerWhoseFirstLineIsNoCommand) {
  std::vector<std::string> obeyed;
  test_.on_console_line = [&](const std::string& line) -> std::optional<std::string> {
    if (line != "press pause") {
      return std::nullopt;
    }
    obeyed.push_back(line);
    return "ok\n";
  };
  const std::string after = " / HTTP/1.1\r\nHost: 127.0.0.1:59000\r\n\r\npress pause\r\n";
  for (const std::string& first :
       {"GET" + after, "POST" + after, "QUERY" + after, std::string("\x16\x03\x01\npress pause\n"),
        std::string("\0\x80\0\1\x21\x12\xa4\x42\npress pause\n", 21), "\xffpress pause\n" + after,
        std::string("what?\npress pause\n"), std::string(300, 'x') + "\npress pause\n"}) {
    TestClient stranger(port_);
    stranger.send(first);
    ASSERT_TRUE(test_.runUntil([&] { return stranger.ended(); })) << first;
    EXPECT_THAT(obeyed, testing::IsEmpty()) << first;
  }
  TestClient listener(port_);
  listener.send("press pause\npress pause\nwhat?\npress pause\n");
  const std::string answers = "ok\nok\nerror: not understood: \"what?\"; \"help\" shows the commands\nok\n";
  EXPECT_TRUE(test_.runUntil([&] { return listener.received() == answers; })) << listener.received();
}

TEST_F(ConsoleTest, TheNinthListenerHasNoPlaceUntilAnotherOneLeaves) {
  std::vector<std::unique_ptr<TestClient>> listeners;
  for (int i = 0; i < 8; ++i) {
    listeners.push_back(std::make_unique<TestClient>(port_));
    awaitAccepted(*listeners.back());
  }
  TestClient ninth(port_);
  EXPECT_TRUE(test_.runUntil([&] { return ninth.isAtEnd(); }));
  EXPECT_THAT(ninth.received(), testing::HasSubstr("8 listeners already"));
  listeners.pop_back();
  test_.runPending();
  TestClient newcomer(port_);
  awaitAccepted(newcomer);
  EXPECT_FALSE(newcomer.isAtEnd());
}

}  // namespace
}  // namespace openr_host
