#include "tools/teleop/terminal.h"

#include <gmock/gmock.h>
#include <termios.h>

#include <cstring>
#include <stdexcept>

#include "support/pseudo_terminal.h"
#include "tools/teleop/key_steering.h"

namespace teleop {
namespace {

using std::chrono::seconds;

class TerminalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!user_.exists()) {
      GTEST_SKIP() << "this system gives no pseudo terminal: is /dev/pts mounted?";
    }
  }

  termios settings() const {
    termios settings{};
    EXPECT_EQ(::tcgetattr(user_.descriptor(), &settings), 0);
    return settings;
  }

  test_support::PseudoTerminal user_;
};

TEST_F(TerminalTest, DoesNotShowTheKeysAndIsThenAsBefore) {
  const termios before = settings();
  {
    const Terminal terminal(user_.descriptor());
    EXPECT_EQ(settings().c_lflag & (ECHO | ICANON | ISIG), static_cast<tcflag_t>(ISIG)) << "Ctrl-C interrupts";
  }
  const termios after = settings();
  EXPECT_EQ(std::memcmp(&after, &before, sizeof(termios)), 0);
}

TEST_F(TerminalTest, SaysThatItWasClosed) {
  Terminal terminal(user_.descriptor());
  user_.close();
  EXPECT_THROW(terminal.readKey(seconds(20)), std::runtime_error);
}

TEST_F(TerminalTest, AKeyIsGivenAtOnceAndASpecialKeyIsOneKey) {
  Terminal terminal(user_.descriptor());
  const auto key = [&](const std::string& bytes) {
    user_.type(bytes + "k");
    const std::optional<char> first = terminal.readKey(seconds(10));
    EXPECT_EQ('k', terminal.readKey(seconds(10))) << "nothing of it is left";
    return first;
  };
  EXPECT_EQ('i', key("i"));
  for (const std::string begin : {"\x1b[", "\x1bO"}) {  // the latter after an editor, for example
    EXPECT_EQ(kArrowUp, key(begin + "A"));
    EXPECT_EQ(kArrowDown, key(begin + "B"));
    EXPECT_EQ(kArrowRight, key(begin + "C"));
    EXPECT_EQ(kArrowLeft, key(begin + "D"));
    EXPECT_EQ(kOtherSpecialKey, key(begin + "M")) << "Enter on the keypad";
  }
  EXPECT_EQ(kOtherSpecialKey, key("\x1b[3~")) << "Delete";
  EXPECT_EQ(kOtherSpecialKey, key("\x1b[1;5A")) << "Ctrl with an arrow";
  user_.type("\x1b");
  EXPECT_EQ(kOtherSpecialKey, terminal.readKey(seconds(10))) << "Escape";
  user_.type("\x1b[");
  EXPECT_EQ(kOtherSpecialKey, terminal.readKey(seconds(10))) << "cut";
}

}  // namespace
}  // namespace teleop
