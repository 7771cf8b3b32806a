#include "remote_control/driver_search.h"

#include <gmock/gmock.h>

namespace aibo_driver::remote_control {
namespace {

using ::testing::ElementsAre;

constexpr const char* kConnection = "aibo_driver/Connection";
constexpr const char* kSettings = "dynamic_reconfigure/Config";

TEST(DriverSearch, FindsDriversByTheirTopicAndItsType) {
  MasterState state;
  state.types = {{"/left/connection", kConnection},
                 {"/lab/right/connection", kConnection},
                 {"/other/connection", "std_msgs/Bool"},
                 {"/left/camera_connection", kConnection}};
  EXPECT_THAT(driversIn(state), ElementsAre("/lab/right", "/left"));
}

TEST(DriverSearch, FindsTheSettingsOfTheNodeThatPublishes) {
  MasterState state;
  state.types = {{"/aibo/connection", kConnection},
                 {"/aibo_driver/parameter_updates", kSettings},
                 {"/camera/parameter_updates", kSettings},
                 {"/zoom/parameter_updates", "std_msgs/Bool"}};
  state.publishers = {{"/aibo/connection", {"/aibo_driver"}},
                      {"/aibo_driver/parameter_updates", {"/aibo_driver"}},
                      {"/camera/parameter_updates", {"/camera"}},
                      {"/zoom/parameter_updates", {"/aibo_driver"}}};
  EXPECT_EQ(settingsOf("/aibo", state), "/aibo_driver");
  EXPECT_EQ(settingsOf("/right", state), "");
}

TEST(DriverSearch, InANodeletManagerTheSettingsAreThoseInTheSameNamespace) {
  MasterState state;
  for (const char* owner : {"/a/driver", "/left/driver", "/z/driver"}) {
    state.types[std::string(owner) + "/parameter_updates"] = kSettings;
    state.publishers[std::string(owner) + "/parameter_updates"] = {"/manager"};
  }
  state.publishers["/left/connection"] = {"/manager"};
  EXPECT_EQ(settingsOf("/left", state), "/left/driver");
}

// The driver in /aibo was started bare, so its settings are elsewhere.
TEST(DriverSearch, SettingsInTheNamespaceOfAnotherDriverAreNotTakenForThoseElsewhere) {
  for (const std::string owner : {"/a_driver", "/driver", "/z_driver"}) {
    MasterState state;
    for (const std::string name_space : {"/aibo", "/aibo2", "/right"}) {
      state.types[name_space + "/connection"] = kConnection;
      state.publishers[name_space + "/connection"] = {"/manager"};
    }
    for (const std::string& each : {owner, std::string("/aibo2/driver"), std::string("/right/driver")}) {
      state.types[each + "/parameter_updates"] = kSettings;
      state.publishers[each + "/parameter_updates"] = {"/manager"};
    }
    EXPECT_EQ(settingsOf("/aibo", state), owner);
    EXPECT_EQ(settingsOf("/right", state), "/right/driver");
  }
}

TEST(DriverSearch, SettingsBelongToTheInnermostDriver) {
  MasterState state;
  for (const std::string name_space : {"/lab", "/lab/right", "/lab/right/arm", "/lab2"}) {
    state.types[name_space + "/connection"] = kConnection;
    state.publishers[name_space + "/connection"] = {"/manager"};
    state.types[name_space + "/z_driver/parameter_updates"] = kSettings;
    state.publishers[name_space + "/z_driver/parameter_updates"] = {"/manager"};
  }
  for (const std::string name_space : {"/lab", "/lab/right", "/lab/right/arm", "/lab2"}) {
    EXPECT_EQ(settingsOf(name_space, state), name_space + "/z_driver");
  }
}

}  // namespace
}  // namespace aibo_driver::remote_control
