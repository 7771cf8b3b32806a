// Old code for the robot compiles, boots and communicates without changes.
#include <gmock/gmock.h>

#include <sstream>

#include "Surveyor_stub.h"
#include "fake_robot.h"
#include "simulator/openr_host/machine.h"
#include "support/temporary_folder.h"

namespace openr_host {
namespace {

using testing::HasSubstr;
using testing::Not;

class ConformanceTest : public testing::Test {
 protected:
  ConformanceTest() {
    stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", "/MS/OPEN-R/MW/OBJS/SURVEYOR.BIN\n");
    options_.memory_stick = stick_.path().string();
    options_.ports = {{kConsolePort, 0}};
    options_.catalog = {{"SURVEYOR.BIN", describeSurveyor()}};
    options_.console = &console_;
  }

  /// @return the console's output
  std::string boot() {
    Machine machine(options_, clock_, robot_);
    machine.boot();
    clock_.step();
    machine.runPending();
    return console_.str();
  }

  test_support::TemporaryFolder stick_;
  SteppedClock clock_;
  FakeRobot robot_;
  std::ostringstream console_;
  MachineOptions options_;
};

TEST_F(ConformanceTest, WithoutConnectCfgObjectsBootAndTheConsoleSaysSo) {
  const std::string shown = boot();
  EXPECT_THAT(shown, HasSubstr("There is no OPEN-R/MW/CONF/CONNECT.CFG"));
  EXPECT_THAT(shown, HasSubstr("Surveyor at 0\n"));
  EXPECT_THAT(shown, Not(HasSubstr("hears")));
}

TEST_F(ConformanceTest, ServicesAreConnectedByTheirNamesInStubCfgEvenWithinOneObject) {
  stick_.write("OPEN-R/MW/CONF/CONNECT.CFG",
               "[ERS-210]\nNobody.Map.Place.S Country.News.Place.O\n[ERS-7]\n"
               "Country.Map.Place.S Country.News.Place.O\n");
  stick_.write("OPEN-R/MW/CONF/DESIGNDB.CFG", "PLACE /MS/OPEN-R/MW/DATA/P/PLACE.TXT\n");
  stick_.write("OPEN-R/MW/DATA/P/PLACE.TXT", "77");
  EXPECT_THAT(boot(), HasSubstr("Surveyor at 77\nSurveyor hears of 77\n"));
}

}  // namespace
}  // namespace openr_host
