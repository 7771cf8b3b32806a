// OPENR::ObservePowerStatus: Level2 Reference Guide, pages 76 to 80.
#include "simulator/openr_host/objects/power_watch.h"

#include <OPENR/OPENRAPI.h>
#include <gmock/gmock.h>

#include "simulator/openr_host/object_description.h"
#include "test_system.h"

namespace openr_host {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class PowerWatchTest : public testing::Test {
 protected:
  bool reports(const OPowerStatus& wanted, const OPowerStatus& before, const OPowerStatus& now) {
    watch_.observe(entry_, wanted, before);
    return !watch_.look(now).empty();
  }

  const OServiceEntry entry_{oidOf(3), 5};
  PowerWatch watch_;
  OPowerStatus present_;
  OPowerStatus changed_;
};

TEST_F(PowerWatchTest, ABitIsReportedWhenItRisesAndWhenItFalls) {
  OPowerStatus wanted;
  wanted.robotStatus = orsbPAUSE;
  changed_.robotStatus = orsbPAUSE | orsbMOTOR_POWER;
  watch_.observe(entry_, wanted, present_);
  EXPECT_THAT(watch_.look(present_), IsEmpty());
  EXPECT_THAT(watch_.look(changed_), ElementsAre(entry_));
  EXPECT_THAT(watch_.look(changed_), IsEmpty()) << "nothing has changed";
  EXPECT_THAT(watch_.look(present_), ElementsAre(entry_));
}

TEST_F(PowerWatchTest, OnlyTheChosenBitsAreWatched) {
  OPowerStatus wanted;
  wanted.robotStatus = orsbPAUSE;
  wanted.batteryStatus = obsbFULLY_DISCHARGED;
  changed_.robotStatus = orsbBATTERY_CAPACITY_LOW;
  changed_.batteryStatus = obsbOVER_TEMP_ALARM;
  EXPECT_FALSE(reports(wanted, present_, changed_));
  changed_.batteryStatus |= obsbFULLY_DISCHARGED;
  EXPECT_TRUE(reports(wanted, present_, changed_));
}

TEST_F(PowerWatchTest, AnEntryObservesOnceUntilItStops) {
  OPowerStatus wanted;
  wanted.robotStatus = orsbALL;
  watch_.observe(entry_, wanted, present_);
  watch_.observe(entry_, wanted, present_);
  changed_.robotStatus = orsbPAUSE;
  EXPECT_THAT(watch_.look(changed_), ElementsAre(entry_));
  EXPECT_TRUE(watch_.unobserve(entry_));
  EXPECT_FALSE(watch_.unobserve(entry_));
  EXPECT_FALSE(watch_.isWatching());
}

TEST_F(PowerWatchTest, EachEntryIsToldOfItsOwnBits) {
  const OServiceEntry next{oidOf(1), 1};
  OPowerStatus wanted;
  wanted.robotStatus = orsbPAUSE;
  watch_.observe(entry_, wanted, present_);
  wanted.robotStatus = orsbALL;
  watch_.observe(next, wanted, present_);
  changed_.robotStatus = orsbPAUSE;
  EXPECT_THAT(watch_.look(changed_), ElementsAre(entry_, next));
  EXPECT_THAT(watch_.look(changed_), IsEmpty());
  changed_.robotStatus |= orsbMOTOR_POWER;
  EXPECT_THAT(watch_.look(changed_), ElementsAre(next));
  EXPECT_TRUE(watch_.unobserve(entry_));
  EXPECT_THAT(watch_.look(present_), ElementsAre(next));
}

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
  const OServiceEntry entry(object.id(), TestObject::kSecond);
  test.as(object, [&] {
    EXPECT_EQ(OPENR::ObservePowerStatus(wanted, OServiceEntry(object.id(), 7)), oINVALID_ARG) << "no such entry";
    EXPECT_EQ(OPENR::ObservePowerStatus(wanted, entry), oSUCCESS);
  });
  test.system.watchPower();
  test.run();
  EXPECT_THAT(seen, IsEmpty());
  test.robot.power_status.robotStatus = orsbPAUSE;
  test.system.watchPower();
  test.run();
  EXPECT_THAT(seen, ElementsAre(orsbPAUSE));
  test.as(object, [&] {
    EXPECT_EQ(OPENR::UnobservePowerStatus(entry), oSUCCESS);
    EXPECT_EQ(OPENR::UnobservePowerStatus(entry), oINVALID_ARG);
  });
  test.robot.power_status.robotStatus = 0;
  test.system.watchPower();
  test.run();
  EXPECT_THAT(seen, ElementsAre(orsbPAUSE));
}

}  // namespace
}  // namespace openr_host
