#include "node/connection_message.h"

#include <gmock/gmock.h>

namespace aibo_driver::node {
namespace {

TEST(DescribeConnection, SaysWhereReasonAndAdvice) {
  aibo_client::ClientOptions options;
  options.host = "aibo.local";
  options.port = 4711;
  aibo_client::ConnectionStatus status;
  EXPECT_EQ(describeConnection(status, options), "not connected to aibo.local:4711");
  status.state = aibo_client::ConnectionState::kConnecting;
  status.reason = "connection refused";
  status.advice = "is the RCServer running?";
  EXPECT_EQ(describeConnection(status, options),
            "connecting to aibo.local:4711: connection refused (is the RCServer running?)");
  status = aibo_client::ConnectionStatus();
  status.state = aibo_client::ConnectionState::kConnected;
  status.protocol_version = 1;
  EXPECT_EQ(describeConnection(status, options), "connected to aibo.local:4711, protocol version 1");
}

}  // namespace
}  // namespace aibo_driver::node
