#include "node/only_driver.h"

#include <gmock/gmock.h>

namespace aibo_driver::node {
namespace {

TEST(OnlyDriver, OfSeveralThatStartAtOnceTheFirstStays) {
  XmlRpc::XmlRpcValue state;
  state[0][0][0] = "/other/connection";
  state[0][0][1][0] = "/a_driver_of_another_robot";
  state[0][1][0] = "/aibo/connection";
  int place = 0;
  for (const char* node : {"/first", "/second", "/third"}) {
    state[0][1][1][place++] = node;
  }
  const auto before = [&state](const char* node) { return publishersBefore(node, "/aibo/connection", state); };
  EXPECT_THAT(before("/first"), ::testing::IsEmpty());
  EXPECT_THAT(before("/second"), ::testing::ElementsAre("/first"));
  EXPECT_THAT(before("/third"), ::testing::ElementsAre("/first", "/second"));
}

}  // namespace
}  // namespace aibo_driver::node
