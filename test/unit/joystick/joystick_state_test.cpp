#include "tools/joystick/joystick_state.h"

#include <gmock/gmock.h>

namespace joystick {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::FloatEq;

class ReporterTest : public ::testing::Test {
 protected:
  std::optional<State> after(milliseconds time, const std::optional<State>& state) {
    now_ += time;
    return reporter_.report(state, now_);
  }

  Reporter reporter_{0.1, milliseconds(50)};
  Reporter::TimePoint now_{std::chrono::hours(1)};
};

TEST_F(ReporterTest, ReportsEachChangeAtOnceAndTheSameAgainAfterAWhile) {
  EXPECT_FALSE(after(milliseconds(10), std::nullopt)) << "there is no joystick";
  State state{{0, 0.5F}, {0, 1, 0}};
  EXPECT_TRUE(after(milliseconds(10), state));
  EXPECT_FALSE(after(milliseconds(10), state));
  state.buttons[2] = 1;
  EXPECT_TRUE(after(milliseconds(10), state));
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(after(milliseconds(40), state)) << i;
    EXPECT_TRUE(after(milliseconds(10), state)) << i;
  }
  state.axes[1] = 0.6F;
  EXPECT_TRUE(after(milliseconds(10), state)) << "a stick has moved";
}

TEST_F(ReporterTest, TakesASmallDeflectionForNone) {
  const auto report = after(milliseconds(10), State{{0.09F, -0.099F, 0.55F, -0.55F, -1.0F, 2.0F}, {}});
  ASSERT_TRUE(report);
  EXPECT_THAT(report->axes, ElementsAre(0, 0, FloatEq(0.5F), FloatEq(-0.5F), FloatEq(-1), FloatEq(1)));
  EXPECT_FALSE(after(milliseconds(10), State{{-0.03F, 0, 0.55F, -0.55F, -1.0F, 2.0F}, {}})) << "it only trembles";
}

TEST_F(ReporterTest, SaysOnceThatAllIsReleasedWhenTheJoystickIsGone) {
  after(milliseconds(10), State{{1, -1}, {1, 0}});
  const auto report = after(milliseconds(10), std::nullopt);
  ASSERT_TRUE(report);
  EXPECT_THAT(report->axes, ElementsAre(0, 0));
  EXPECT_THAT(report->buttons, ElementsAre(0, 0));
  EXPECT_FALSE(after(milliseconds(1000), std::nullopt));
  EXPECT_TRUE(after(milliseconds(10), State{{0, 0}, {0, 0}})) << "it is back";
}

TEST(Reporter, RepeatsNothingIfNotWanted) {
  Reporter reporter(0, milliseconds(0));
  EXPECT_TRUE(reporter.report(State{{0}, {}}, Reporter::TimePoint()));
  EXPECT_FALSE(reporter.report(State{{0}, {}}, Reporter::TimePoint(std::chrono::hours(1))));
}

}  // namespace
}  // namespace joystick
