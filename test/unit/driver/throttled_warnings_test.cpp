#include "ros/throttled_warnings.h"

#include <gmock/gmock.h>

#include <vector>

namespace aibo_driver::node {
namespace {

TEST(ThrottledWarnings, LogsTheSameOnceInAWhileWhateverNumbersAreInIt) {
  std::vector<std::string> logged;
  ThrottledWarnings warnings([&logged](const std::string& text) { logged.push_back(text); });
  for (int i = 0; i < 1000; ++i) {
    warnings.warn("LED face_1 cannot shine with intensity " + std::to_string(i * 1.5) + ", which is not 0..1.");
    warnings.warn("LED face_2 cannot shine with intensity -" + std::to_string(i) + ", which is not 0..1.");
  }
  EXPECT_THAT(logged, ::testing::ElementsAre("LED face_1 cannot shine with intensity 0.000000, which is not 0..1.",
                                             "LED face_2 cannot shine with intensity -0, which is not 0..1."));
}

}  // namespace
}  // namespace aibo_driver::node
