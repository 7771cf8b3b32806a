#include "protocol/angles.h"

#include <gmock/gmock.h>

#include <climits>
#include <cmath>

namespace protocol {
namespace {

TEST(Angles, OfKnownJointsAreConverted) {
  // Limits of the ERS-7's joints in degrees and in the microradians that OPEN-R programs use for them.
  EXPECT_EQ(microradiansFromCentidegrees(0), 0);
  EXPECT_EQ(microradiansFromCentidegrees(-7500), -1308997);
  EXPECT_EQ(microradiansFromCentidegrees(8800), 1535890);
  EXPECT_EQ(microradiansFromCentidegrees(13000), 2268928);
  EXPECT_EQ(microradiansFromCentidegrees(-11500), -2007129);
  EXPECT_EQ(microradiansFromCentidegrees(-300), -52360);
  EXPECT_EQ(centidegreesFromMicroradians(-1308997), -7500);
  EXPECT_EQ(centidegreesFromMicroradians(1535890), 8800);
  EXPECT_EQ(centidegreesFromMicroradians(500000), 2865);
}

TEST(Angles, AreRoundedToTheNearest) {
  // 0.01 degree is 174.533 microradian: the border between 0 and 1 lies at 87.27.
  EXPECT_EQ(centidegreesFromMicroradians(87), 0);
  EXPECT_EQ(centidegreesFromMicroradians(88), 1);
  EXPECT_EQ(centidegreesFromMicroradians(-87), 0);
  EXPECT_EQ(centidegreesFromMicroradians(-88), -1);
  EXPECT_EQ(microradiansFromCentidegrees(1), 175);
  EXPECT_EQ(microradiansFromCentidegrees(-1), -175);
}

TEST(Angles, OfVersion1SurviveTheWayToMicroradiansAndBack) {
  for (int centidegrees = SHRT_MIN; centidegrees <= SHRT_MAX; ++centidegrees) {
    const short value = static_cast<short>(centidegrees);
    const int microradians = microradiansFromCentidegrees(value);
    ASSERT_NEAR(microradians, value * 174.53292519943295, 0.5);
    ASSERT_EQ(centidegreesFromMicroradians(microradians), value);
  }
}

TEST(Angles, BeyondVersion1AreLimited) {
  EXPECT_EQ(microradiansFromCentidegrees(-32768), -5719095);
  EXPECT_EQ(centidegreesFromMicroradians(5718920), 32767);
  EXPECT_EQ(centidegreesFromMicroradians(5719095), 32767);
  EXPECT_EQ(centidegreesFromMicroradians(10057460), 32767);
  EXPECT_EQ(centidegreesFromMicroradians(INT_MAX), 32767);
  EXPECT_EQ(centidegreesFromMicroradians(-5719270), -32768);
  EXPECT_EQ(centidegreesFromMicroradians(INT_MIN), -32768);
}

}  // namespace
}  // namespace protocol
