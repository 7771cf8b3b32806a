// The wireless console.
#include <OPENR/OSyslog.h>
#include <gmock/gmock.h>

#include <chrono>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "simulator/openr_host/machine.h"
#include "support/test_client.h"
#include "test_system.h"

namespace openr_host {
namespace {

using test_support::TestClient;
using testing::HasSubstr;

class ConsoleTest : public testing::Test {
 protected:
  ConsoleTest() {
    test_.boot();
    port_ = test_.system.console().takePort("127.0.0.1", 0);
  }

  void print(const std::string& text) {
    test_.as(object_, [&] { OSYSPRINT(("%s", text.c_str())); });
  }

  /// Prints until this listener receives something, which shows that it has been accepted.
  void awaitAccepted(TestClient& listener) {
    ASSERT_TRUE(test_.runUntil([&] {
      print(".");
      return !listener.received().empty();
    }));
  }

  TestSystem test_;
  TestObject& object_ = test_.add("Object");
  std::uint16_t port_ = 0;
};

TEST_F(ConsoleTest, PrintsToItsStreamAndToEveryListener) {
  TestClient first(port_);
  TestClient second(port_);
  awaitAccepted(first);
  awaitAccepted(second);
  test_.as(object_, [] { OSYSPRINT(("%d and %s\n", 42, "text")); });
  const auto has_it = [](TestClient& listener) {
    return listener.received().find("42 and text\n") != std::string::npos;
  };
  EXPECT_TRUE(test_.runUntil([&] { return has_it(first) && has_it(second); }));
  EXPECT_THAT(test_.output.str(), HasSubstr("42 and text\n"));
}

// docs/first_start.md and docs/protocol.md name it.
TEST(ConsolePort, IsThatOfTheDocuments) {
  EXPECT_EQ(kConsolePort, 59000);
}

TEST_F(ConsoleTest, ALogLineNamesItsPriorityAndItsObject) {
  test_.as(object_, [] {
    OSYSLOG1((osyslogERROR, "no %s", "image"));
    OSYSLOG1((osyslogWARNING, "hm"));
    OSYSLOG1((osyslogINFO, "well"));
    OSYSDEBUG(("not in this build\n"));
  });
  EXPECT_EQ(test_.output.str(), "ERROR Object: no image\nWARNING Object: hm\nINFO Object: well\n");
}

// Programmer's Guide, 5.1: 243 characters including the closing 0.
TEST_F(ConsoleTest, OnePrintShowsItsFirst242Characters) {
  const std::string most(242, 'x');
  print(most);
  EXPECT_EQ(test_.output.str(), most);
  test_.output.str("");
  print(most + "and more\n");
  EXPECT_EQ(test_.output.str(), most);
  test_.output.str("");
  test_.as(object_, [&] { OSYSLOG1((osyslogINFO, "%s", (most + "and more").c_str())); });
  EXPECT_EQ(test_.output.str(), "INFO Object: " + most + "\n");
}

TEST_F(ConsoleTest, AListenerThatDoesNotReadDelaysNothingAndIsToldAboutLostMessages) {
  TestClient slow(port_, 64 * 1024);  // with a smaller window the kernel may need minutes
  TestClient quick(port_);
  awaitAccepted(slow);
  awaitAccepted(quick);
  const std::string line = std::string(241, '#') + "\n";
  std::size_t printed = 0;
  // Far more than kernel and console together keep for one listener.
  for (; printed < 64 * 1024; ++printed) {
    print(line);
    quick.received();
  }
  // The megabytes take their time on a busy computer.
  const std::chrono::seconds limit(300);
  EXPECT_TRUE(test_.runUntil([&] { return quick.received().size() >= printed * line.size(); }, limit));
  // Look only at the end: searching all megabytes again and again would take longer than receiving them.
  const auto ends_with = [&slow](const std::string& text) {
    const std::string& heard = slow.received();
    return heard.size() >= text.size() && heard.compare(heard.size() - text.size(), text.size(), text) == 0;
  };
  ASSERT_TRUE(test_.runUntil([&] { return ends_with(" messages lost: this console was not read]\n"); }, limit));
  const auto arrived = std::count(slow.received().begin(), slow.received().end(), '\n') - 1;
  EXPECT_TRUE(ends_with("[" + std::to_string(printed - static_cast<std::size_t>(arrived)) +
                        " messages lost: this console was not read]\n"));
  print("now then\n");
  EXPECT_TRUE(test_.runUntil([&] { return ends_with("now then\n"); }));
}

TEST_F(ConsoleTest, AListenerThatDisconnectsDoesNotDisturbOthers) {
  TestClient staying(port_);
  awaitAccepted(staying);
  {
    TestClient closing(port_);
    awaitAccepted(closing);
    TestClient resetting(port_);
    awaitAccepted(resetting);
    resetting.reset();
  }
  print("one\n");
  test_.runPending();
  print("two\n");
  EXPECT_TRUE(test_.runUntil([&] { return staying.received().find("one\ntwo\n") != std::string::npos; }));
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
  EXPECT_EQ(test_.output.str(), "");
}

TEST_F(ConsoleTest, ALineThatIsTooLongIsRefusedAndTheNextOneAccepted) {
  test_.on_console_line = [](const std::string& line) { return "got " + std::to_string(line.size()) + "\n"; };
  TestClient listener(port_);
  listener.send("help\n" + std::string(5000, 'x') + "\n" + std::string(256, 'x') + "\n");
  EXPECT_TRUE(test_.runUntil(
      [&] { return listener.received() == "got 4\nerror: a line has at most 256 characters\ngot 256\n"; }));
}

TEST_F(ConsoleTest, OneListenerTooManyGetsAMessageAndIsDisconnected) {
  std::vector<std::unique_ptr<TestClient>> listeners;
  for (std::size_t i = 0; i < Console::kMostListeners; ++i) {
    listeners.push_back(std::make_unique<TestClient>(port_));
    awaitAccepted(*listeners.back());
  }
  TestClient newcomer(port_);
  ASSERT_TRUE(test_.runUntil([&] { return newcomer.isAtEnd(); }));
  EXPECT_THAT(newcomer.received(), HasSubstr("8 listeners already"));

  listeners.pop_back();
  test_.runPending();
  TestClient next(port_);
  awaitAccepted(next);
  EXPECT_FALSE(next.isAtEnd());
}

// The lines after the first would be obeyed.
TEST_F(ConsoleTest, AListenerWhoseFirstLineIsNoCommandIsDroppedAndNothingOfItIsObeyed) {
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

/// A console with a clock of its own.
class ConsoleClockTest : public testing::Test {
 protected:
  void run() {
    for (bool had_event = true; had_event;) {
      PollSet poll_set;
      console_.addTo(poll_set);
      had_event = poll_set.wait(std::chrono::steady_clock::time_point());
    }
  }

  Console::Time now_{};
  std::ostringstream output_;
  Console console_{
      &output_, [](const std::string& line) { return line == "x" ? std::optional<std::string>("y\n") : std::nullopt; },
      [this] { return now_; }};
  const std::uint16_t port_ = console_.takePort("127.0.0.1", 0);
};

TEST_F(ConsoleClockTest, StrangersAreReportedOnceAMinute) {
  const auto sendPage = [this] {
    TestClient browser(port_);
    browser.send("POST / HTTP/1.1\r\n\r\n");
    while (!browser.ended()) {
      run();
    }
  };
  const std::string line =
      "The console dropped a listener whose first line was not a command; a web page may have sent it";
  for (int i = 0; i < 100; ++i) {
    sendPage();
  }
  EXPECT_EQ(output_.str(), line + "\n");
  output_.str("");
  now_ += std::chrono::minutes(1);
  sendPage();
  sendPage();
  EXPECT_EQ(output_.str(), line + " (99 more before it)\n");
}

TEST_F(ConsoleClockTest, AListenerThatTypesNothingForAMinuteLosesItsPlaceToTheNinth) {
  std::vector<std::unique_ptr<TestClient>> listeners;
  for (std::size_t i = 0; i < Console::kMostListeners; ++i) {
    listeners.push_back(std::make_unique<TestClient>(port_));
    run();
  }
  for (const std::chrono::seconds wait : {std::chrono::seconds(0), Console::kIdleTime - std::chrono::seconds(1)}) {
    now_ += wait;
    listeners.front()->send("x\n");
    run();
  }
  TestClient too_early(port_);
  run();
  EXPECT_TRUE(too_early.isAtEnd());
  now_ += std::chrono::seconds(1);
  TestClient newcomer(port_);
  TestClient another(port_);
  run();
  EXPECT_FALSE(newcomer.ended());
  EXPECT_FALSE(another.ended());
  EXPECT_FALSE(listeners.front()->ended()) << "it has typed";
  for (const std::size_t replaced : {1U, 2U}) {
    EXPECT_TRUE(listeners[replaced]->isAtEnd());
    EXPECT_THAT(listeners[replaced]->received(), HasSubstr("was idle"));
  }
  EXPECT_FALSE(listeners[3]->ended()) << "two places are enough";
}

}  // namespace
}  // namespace openr_host
