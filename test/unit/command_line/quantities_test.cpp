#include "command_line/quantities.h"

#include <gtest/gtest.h>

#include "aibo_client/exceptions.h"
#include "support/refusal.h"

namespace aibo_driver::command_line {

using aibo_client::InvalidArgumentException;

namespace {

constexpr double kTolerance = 1e-9;

template <typename Function>
std::string refusalOf(const Function& function) {
  return test_support::refusalOf<InvalidArgumentException>(function);
}

TEST(Quantity, HasAUnit) {
  EXPECT_NEAR(parseAngle("head_pan", "180deg"), 3.14159265358979, kTolerance);
  EXPECT_NEAR(parseAngle("head_pan", "-.5rad"), -0.5, kTolerance);
  EXPECT_NEAR(parseSpeed("forward", "5cm/s"), 0.05, kTolerance);
  EXPECT_NEAR(parseSpeed("forward", "-80mm/s"), -0.08, kTolerance);
  EXPECT_NEAR(parseAngularSpeed("turn", "90deg/s"), 1.5707963267949, kTolerance);
}

TEST(Quantity, WithoutItsUnitOrWithoutANumberIsRefused) {
  for (const char* const text : {"30", "deg", "30 deg", "30grad", "", "nandeg", "infrad", "1e999rad", "30degx"}) {
    EXPECT_THROW(parseAngle("head_pan", text), InvalidArgumentException) << text;
  }
  EXPECT_THROW(parseSpeed("forward", "5cm"), InvalidArgumentException);
  EXPECT_THROW(parseAngularSpeed("turn", "90deg"), InvalidArgumentException);
}

TEST(Quantity, RefusalSaysWhatIsMissing) {
  using Parser = double(const std::string&, const std::string&);
  for (const auto& [parse, allowed] : {std::pair<Parser*, const char*>(parseAngle, "30deg or 0.52rad"),
                                       {parseAngularSpeed, "30deg/s or 0.52rad/s"},
                                       {parseSpeed, "0.1m/s, 10cm/s or 100mm/s"}}) {
    EXPECT_EQ(refusalOf([parse = parse] { parse("head_pan", "30"); }),
              "head_pan cannot be '30': give a number with its unit: " + std::string(allowed));
  }
}

TEST(Number, KeepsToItsRange) {
  EXPECT_EQ(parseNumber("--seconds", "0.5", 0.1, 60), 0.5);
  EXPECT_EQ(parseNumber("--seconds", "0.1", 0.1, 60), 0.1);
  EXPECT_EQ(parseNumber("--seconds", "60", 0.1, 60), 60);
  for (const char* const text : {"60.1", "0", "-1", "1s", "nan", ""}) {
    EXPECT_EQ(refusalOf([text] { parseNumber("--seconds", text, 0.1, 60); }),
              "--seconds cannot be '" + std::string(text) + "': give a number from 0.1 to 60");
  }
}

TEST(WholeNumber, IsRefusedWithWhatIsAllowed) {
  EXPECT_EQ(parseWholeNumber("--port", "1", 1, 65535), 1);
  EXPECT_EQ(parseWholeNumber("--port", "65535", 1, 65535), 65535);
  for (const char* const text : {"", "x", "0", "65536", "1.5", "9 ", "1e99", "nan"}) {
    EXPECT_EQ(refusalOf([text] { parseWholeNumber("--port", text, 1, 65535); }),
              "--port cannot be '" + std::string(text) + "': give a whole number from 1 to 65535");
  }
}

TEST(Assignment, HasANameAndAValue) {
  const std::vector<Assignment> parsed = parseAssignments({"a=1", "b=c=d"}, "a=1");
  ASSERT_EQ(parsed.size(), 2U);
  EXPECT_EQ(parsed[1].name, "b");
  EXPECT_EQ(parsed[1].value, "c=d");
  for (const char* const word : {"c", "=1", "c=", "a=2"}) {
    EXPECT_THROW(parseAssignments({"a=1", "b=2", word}, "a=1"), InvalidArgumentException) << word;
  }
}

}  // namespace
}  // namespace aibo_driver::command_line
