#include "text/throttled_warnings.h"

#include <gmock/gmock.h>

namespace aibo_driver::text {
namespace {

using testing::SizeIs;

class ThrottledWarningsTest : public testing::Test {
 protected:
  std::vector<std::string> logged_;
  ThrottledWarnings::TimePoint now_{std::chrono::milliseconds(5000123)};
  ThrottledWarnings warnings_{[this](const std::string& text) { logged_.push_back(text); }, [this] { return now_; }};
};

TEST_F(ThrottledWarningsTest, TheSameIsLoggedOnceWhateverNumbersAreInIt) {
  for (int i = 0; i < 1000; ++i) {
    warnings_.warn("LED face_1 cannot shine with intensity " + std::to_string(i * 1.5) + ", which is not 0..1.");
    warnings_.warn("LED face_2 cannot shine with intensity -" + std::to_string(i) + ", which is not 0..1.");
  }
  EXPECT_THAT(logged_, testing::ElementsAre("LED face_1 cannot shine with intensity 0.000000, which is not 0..1.",
                                            "LED face_2 cannot shine with intensity -0, which is not 0..1."));
}

TEST_F(ThrottledWarningsTest, WhatIsRepeatedAllTheTimeIsLoggedOnceInEachPeriod) {
  for (int i = 0; i <= 100; ++i) {
    warnings_.warn("No joint is named 'knee'.");
    now_ += std::chrono::milliseconds(100);
  }
  EXPECT_THAT(logged_, SizeIs(3)) << "after 0, 5 and 10 s";
}

// Even if a stranger sends many names.
TEST_F(ThrottledWarningsTest, AFloodOfDifferentOnesIsALineASecondAndSaysSo) {
  for (int i = 0; i < 100'000; ++i) {
    warnings_.warn("No joint is named 'joint" + std::to_string(i) + "'.");
    now_ += std::chrono::microseconds(100);
  }
  ASSERT_THAT(logged_, SizeIs(ThrottledWarnings::kBurst + 9U));
  EXPECT_EQ(logged_[20], "No joint is named 'joint10000'. (earlier messages left out: 9980)");
  EXPECT_EQ(logged_[28], "No joint is named 'joint90000'. (earlier messages left out: 9999)");
}

TEST_F(ThrottledWarningsTest, HaveNothingThatATerminalObeysAndAreShort) {
  warnings_.warn("No joint is named '\x1b[2J\nERROR: " + std::string(10'000'000, 'x') + "'.");
  ASSERT_THAT(logged_, SizeIs(1));
  EXPECT_THAT(logged_[0], testing::StartsWith("No joint is named '?[2J?ERROR: x"));
  EXPECT_LT(logged_[0].size(), ThrottledWarnings::kLongest + 10);
}

}  // namespace
}  // namespace aibo_driver::text
