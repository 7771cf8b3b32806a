// Which object may run on the robot's only processor.
#include "simulator/openr_host/objects/processor.h"

#include <gtest/gtest.h>

#include "simulator/openr_host/object_description.h"

namespace openr_host {
namespace {

using std::chrono::milliseconds;

const OID kServer = oidOf(1);
const OID kWorker = oidOf(2);
const OID kNeighbour = oidOf(3);

class ProcessorTest : public testing::Test {
 protected:
  ProcessorTest() {
    processor_.add(kWorker, 112);
    processor_.add(kServer, 128);
    processor_.add(kNeighbour, 140);
  }

  Processor processor_;
};

// Level2 Reference Guide, chapter 1.
TEST_F(ProcessorTest, AnObjectHandlesOneMessageAtATime) {
  processor_.run(kServer, milliseconds(10), milliseconds(5));
  EXPECT_FALSE(processor_.mayRun(kServer, milliseconds(14)));
  EXPECT_TRUE(processor_.mayRun(kServer, milliseconds(15)));
}

// Programmer's Guide, section 3.1, SCHED_PRIORITY: the upper four bits are the scheduling class.
TEST_F(ProcessorTest, ALowerClassWaitsForAHigherOneButNotTheOtherWayRound) {
  processor_.run(kWorker, milliseconds(0), milliseconds(60));
  EXPECT_TRUE(processor_.mayRun(kServer, milliseconds(10)));
  processor_.run(kServer, milliseconds(10), milliseconds(5));
  EXPECT_FALSE(processor_.mayRun(kWorker, milliseconds(12)));
  EXPECT_EQ(processor_.busyUntil(kWorker), milliseconds(65)) << "it continues when the higher class has finished";
  EXPECT_EQ(processor_.nextFinish(milliseconds(12)), milliseconds(15));
  EXPECT_EQ(processor_.nextFinish(milliseconds(15)), milliseconds(65));
  EXPECT_FALSE(processor_.nextFinish(milliseconds(65)));
}

TEST_F(ProcessorTest, ObjectsOfOneClassShareTheProcessor) {
  processor_.run(kServer, milliseconds(0), milliseconds(8));
  EXPECT_FALSE(processor_.mayRun(kNeighbour, milliseconds(4)));
  EXPECT_TRUE(processor_.mayRun(kNeighbour, milliseconds(8)));
}

// It waits for a device, not for the processor.
TEST_F(ProcessorTest, AnObjectThatWaitsKeepsOnlyItselfBusy) {
  const OID waiting = oidOf(4);
  processor_.add(waiting, 128, true);
  processor_.run(kWorker, milliseconds(0), milliseconds(5));
  processor_.run(waiting, milliseconds(0), milliseconds(60));
  EXPECT_EQ(processor_.busyUntil(kWorker), milliseconds(5));
  EXPECT_FALSE(processor_.mayRun(waiting, milliseconds(10)));
  EXPECT_TRUE(processor_.mayRun(kServer, milliseconds(10)));
  EXPECT_TRUE(processor_.mayRun(kWorker, milliseconds(10)));
  processor_.run(kNeighbour, milliseconds(10), milliseconds(20));
  EXPECT_EQ(processor_.busyUntil(waiting), milliseconds(60)) << "the device goes on";
}

}  // namespace
}  // namespace openr_host
