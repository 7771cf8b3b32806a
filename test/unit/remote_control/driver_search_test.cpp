#include "remote_control/driver_search.h"

#include <gmock/gmock.h>

namespace aibo_driver::remote_control {
namespace {

constexpr const char* kConnection = "aibo_driver/Connection";
constexpr const char* kSettings = "dynamic_reconfigure/Config";

// The master may still know a driver that was killed.
void addDriver(const std::string& name_space, const std::string& node, MasterState* state) {
  state->types[name_space + "/connection"] = kConnection;
  state->publishers[name_space + "/connection"] = {"/killed", node};
}

// A driver has this setting, and nothing else has it.
void addSettings(const std::string& owner, const std::string& node, MasterState* state, bool of_driver = true) {
  state->types[owner + "/parameter_updates"] = kSettings;
  state->publishers[owner + "/parameter_updates"] = {"/another", node};
  state->parameters.insert(owner + (of_driver ? "/telemetry_rate" : "/quality"));
}

TEST(DriverSearch, FindsDriversByTheirTopicAndItsType) {
  MasterState state;
  state.types = {{"/left/connection", kConnection},
                 {"/lab/right/connection", kConnection},
                 {"/other/connection", "std_msgs/Bool"},
                 {"/left/camera_connection", kConnection}};
  EXPECT_THAT(driversIn(state), testing::ElementsAre("/lab/right", "/left"));
}

TEST(DriverSearch, TriesOneDriverAfterTheOther) {
  EXPECT_EQ(driverAfter("", {"/left", "/right"}), "/left");
  EXPECT_EQ(driverAfter("/left", {"/left", "/right"}), "/right");
  EXPECT_EQ(driverAfter("/right", {"/left", "/right"}), "/left") << "it may run by now";
  EXPECT_EQ(driverAfter("/middle", {"/left", "/right"}), "/right") << "the master does not know it any more";
  EXPECT_EQ(driverAfter("/left", {"/left"}), "/left");
  EXPECT_EQ(driverAfter("/left", {}), "/left");
}

TEST(DriverSearch, FindsTheSettingsOfTheNodeThatPublishes) {
  MasterState state;
  addDriver("/aibo", "/aibo_driver", &state);
  for (const std::string owner : {"/aibo_driver", "/camera"}) {
    addSettings(owner, owner, &state);
  }
  EXPECT_EQ(settingsOf("/aibo", state), "/aibo_driver");
  EXPECT_EQ(settingsOf("/right", state), "");
}

// The driver in /aibo was started bare, so its settings are elsewhere.
TEST(DriverSearch, InANodeletManagerTheSettingsAreThoseOfTheInnermostDriver) {
  MasterState state;
  for (const char* name_space : {"/aibo", "/lab", "/lab/right", "/lab2"}) {
    addDriver(name_space, "/manager", &state);
  }
  for (const char* owner : {"/z_driver", "/lab/z_driver", "/lab/right/z_driver", "/lab2/z_driver"}) {
    addSettings(owner, "/manager", &state);
  }
  for (const char* other : {"/aibo/a_debayer", "/a_debayer", "/lab/a_debayer"}) {
    addSettings(other, "/manager", &state, false);
  }
  EXPECT_EQ(settingsOf("/aibo", state), "/z_driver");
  for (const std::string name_space : {"/lab", "/lab/right", "/lab2"}) {
    EXPECT_EQ(settingsOf(name_space, state), name_space + "/z_driver");
  }
}

}  // namespace
}  // namespace aibo_driver::remote_control
