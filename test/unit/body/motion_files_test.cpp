#include "body/motion_files.h"

#include <gmock/gmock.h>

#include "files/files.h"

namespace aibo_driver::body {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

TEST(MotionFileName, AddsTheEndingAndCapitals) {
  EXPECT_EQ(motionFileName("nod"), "NOD.MTN");
  EXPECT_EQ(motionFileName("Nod.mtn"), "NOD.MTN");
  EXPECT_EQ(motionFileName(""), "");
}

TEST(LoadMotion, ReadsAMotionAndNothingElse) {
  EXPECT_THAT(loadMotion(MEMORY_STICK "/OPEN-R/MW/DATA/P/NOD.MTN"), Not(IsEmpty()));
  EXPECT_THROW(loadMotion(MEMORY_STICK "/OPEN-R/MW/CONF/RCSERVER.CFG"), files::FileException);
}

}  // namespace
}  // namespace aibo_driver::body
