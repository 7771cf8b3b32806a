// OPENR::ObservePowerStatus: Level2 Reference Guide, pages 76 to 80.
#include "simulator/openr_host/objects/power_watch.h"

#include <OPENR/OPENRAPI.h>
#include <gmock/gmock.h>

#include "test_system.h"

namespace openr_host {
namespace {

TEST(ObservePowerStatusTest, CallsTheEntryOfTheObjectWithTheStatus) {
  TestSystem test;
  TestObject& object = test.add("Monitor");
  test.boot();
  std::vector<longword> seen;
  object.on_answer = [&](ANTENVMSG message) {
    const auto* told = static_cast<const OPowerStatusMessage*>(message);
    EXPECT_EQ(told->msgType, 1030U);
    seen.push_back(told->powerStatus.robotStatus);
  };
  OPowerStatus wanted;
  wanted.robotStatus = orsbPAUSE;
  const OServiceEntry entry(object.id(), TestObject::kEntry);
  test.as(object, [&] {
    EXPECT_EQ(OPENR::ObservePowerStatus(wanted, OServiceEntry(object.id(), 7)), oINVALID_ARG) << "no such entry";
    EXPECT_EQ(OPENR::ObservePowerStatus(wanted, entry), oSUCCESS);
  });
  test.system.watchPower();
  test.run();
  EXPECT_THAT(seen, testing::IsEmpty());
  test.robot.power_status.robotStatus = orsbPAUSE;
  test.system.watchPower();
  test.run();
  EXPECT_THAT(seen, testing::ElementsAre(orsbPAUSE));
  test.as(object, [&] {
    EXPECT_EQ(OPENR::UnobservePowerStatus(entry), oSUCCESS);
    EXPECT_EQ(OPENR::UnobservePowerStatus(entry), oINVALID_ARG);
  });
  test.robot.power_status.robotStatus = 0;
  test.system.watchPower();
  test.run();
  EXPECT_THAT(seen, testing::ElementsAre(orsbPAUSE));
}

}  // namespace
}  // namespace openr_host
