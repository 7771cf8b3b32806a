#include "text/sentence.h"

#include <gmock/gmock.h>

namespace aibo_driver::text {
namespace {

TEST(Decimal, HasTheDigitsAskedForAndStaysShort) {
  EXPECT_EQ(decimal(0.256, 2), "0.26");
  EXPECT_EQ(decimal(-1.96, 1), "-2.0");
  EXPECT_EQ(decimal(99.6, 0), "100");
  EXPECT_EQ(decimal(-1e300, 1), "-1e+300");
  EXPECT_EQ(decimal(std::numeric_limits<double>::infinity(), 1), "inf");
}

}  // namespace
}  // namespace aibo_driver::text
