#include "node/parameter_watch.h"

#include <gmock/gmock.h>

#include <optional>

using namespace aibo_driver::node;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

class ParameterWatchTest : public testing::Test {
 protected:
  ParameterWatchTest() {
    parameters_["host"] = "robot";
    parameters_["jpeg_quality"] = 85;
    parameters_["speed_scale"] = 1.0;
    parameters_["adaptive"] = false;
    watch_.emplace(parameters_, "/aibo/aibo_driver/");
  }

  std::vector<std::string> check() { return watch_->check(parameters_, in_force_); }

  XmlRpc::XmlRpcValue parameters_;
  ParameterTexts in_force_ = {{"jpeg_quality", "85"}, {"speed_scale", "1"}, {"adaptive", "false"}};
  std::optional<ParameterWatch> watch_;
};

TEST_F(ParameterWatchTest, ASettingThatWasSetWithoutEffectIsToldOnceWithTheWayToSetIt) {
  parameters_["jpeg_quality"] = 50;
  EXPECT_THAT(check(), IsEmpty()) << "dynamic_reconfigure may be changing it";
  EXPECT_THAT(check(), ElementsAre(AllOf(HasSubstr("/aibo/aibo_driver/jpeg_quality was set to '50', but '85' stays"),
                                         HasSubstr("dynparam set /aibo/aibo_driver jpeg_quality 50"))));
  EXPECT_THAT(check(), IsEmpty());
  EXPECT_THAT(check(), IsEmpty());
  parameters_["jpeg_quality"] = 51;
  check();
  EXPECT_EQ(1u, check().size()) << "another change";
  parameters_["jpeg_quality"] = 85;
  check();
  EXPECT_THAT(check(), IsEmpty());
  parameters_["jpeg_quality"] = 51;
  check();
  EXPECT_EQ(1u, check().size()) << "the same change again";
  parameters_["adaptive"] = true;
  parameters_["speed_scale"] = 0.5;
  check();
  EXPECT_EQ(2u, check().size()) << "the first and the last one";
}

TEST_F(ParameterWatchTest, AChangeByDynamicReconfigureIsNone) {
  in_force_["jpeg_quality"] = "50";
  EXPECT_THAT(check(), IsEmpty());
  parameters_["jpeg_quality"] = 50;
  EXPECT_THAT(check(), IsEmpty());
  EXPECT_THAT(check(), IsEmpty());
}

TEST_F(ParameterWatchTest, ParametersOfTheStartNeedANewStart) {
  parameters_["host"] = "other";
  parameters_["port"] = 1;
  check();
  EXPECT_THAT(check(), ElementsAre(AllOf(HasSubstr("/aibo/aibo_driver/host was set to 'other'"),
                                         HasSubstr("no effect before the driver is started again")),
                                   HasSubstr("port was set to '1'")));
}

TEST_F(ParameterWatchTest, NumbersMayBeWrittenInAnotherWay) {
  parameters_["speed_scale"] = 1;
  parameters_["jpeg_quality"] = 85.0;
  check();
  EXPECT_THAT(check(), IsEmpty());
}

}  // namespace
