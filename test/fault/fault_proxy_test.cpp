// The proxy makes the faults that it is asked for, and no others.

#include "support/proxy/fault_proxy.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>

#include "support/raw_client.h"
#include "support/safety_net.h"
#include "support/scripted_server.h"
#include "support/test_pictures.h"

namespace test_support {
namespace {

using std::chrono::milliseconds;

class FaultProxyTest : public testing::Test {
 protected:
  static Bytes ascending(std::size_t size) {
    Bytes bytes(size);
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
    return bytes;
  }

  /// What the client receives when the server sends this.
  Bytes receivedOf(const Bytes& sent, std::size_t size) {
    server_end_.send(sent);
    return client_.read(size, kSafetyNet);
  }

  ScriptedServer server_;
  FaultProxy proxy_{server_.port()};
  RawClient client_{proxy_.port()};
  ScriptedPeer server_end_ = server_.accept();
  const Bytes reply_ = test_pictures::makeReply(ascending(200));
};

TEST_F(FaultProxyTest, OverwritesFlipsDropsAndInsertsAtTheGivenPlace) {
  proxy_.add({Action::kOverwrite, Place::kPicture, 10, Direction::kToClient, 0, {1, 2}});
  proxy_.add({Action::kFlip, Place::kPicture, 20, Direction::kToClient, 0, {0xFF}});
  proxy_.add({Action::kDrop, Place::kPicture, 30, Direction::kToClient, 3});
  proxy_.add({Action::kInsert, Place::kPicture, 40, Direction::kToClient, 0, {0xAA, 0xBB}});
  Bytes expected;
  for (int picture = 0; picture < 4; ++picture) {
    Bytes changed = reply_;
    if (picture == 0) {
      changed[10] = 1;
      changed[11] = 2;
    } else if (picture == 1) {
      changed[20] ^= 0xFF;
    } else if (picture == 2) {
      changed.erase(changed.begin() + 30, changed.begin() + 33);
    } else {
      changed.insert(changed.begin() + 40, {0xAA, 0xBB});
    }
    expected.insert(expected.end(), changed.begin(), changed.end());
    server_end_.send(reply_);
  }
  EXPECT_EQ(client_.read(expected.size(), kSafetyNet), expected);
}

TEST_F(FaultProxyTest, EndsTheConnectionAtTheGivenByte) {
  proxy_.add({Action::kClose, Place::kPicture, 17});
  const Bytes received = receivedOf(reply_, reply_.size());
  EXPECT_EQ(received, Bytes(reply_.begin(), reply_.begin() + 17));
  server_end_.waitUntilClosed();
}

TEST_F(FaultProxyTest, ASilencedConnectionStaysButNothingComes) {
  proxy_.add({Action::kSilence, Place::kPicture, 5});
  EXPECT_EQ(receivedOf(reply_, 5).size(), 5u);
  EXPECT_FALSE(client_.receive(milliseconds(100)).has_value());
  proxy_.heal();
  EXPECT_TRUE(client_.receive(kSafetyNet)->empty());
}

TEST_F(FaultProxyTest, WelcomesClientsAsAsked) {
  proxy_.setWelcome(Welcome::kReset);
  EXPECT_TRUE(RawClient(proxy_.port()).receive(kSafetyNet)->empty());
  proxy_.setWelcome(Welcome::kSilence);
  EXPECT_FALSE(RawClient(proxy_.port()).receive(milliseconds(50)).has_value());
  proxy_.setWelcome(Welcome::kRefuse);
  EXPECT_THROW(RawClient(proxy_.port()), std::system_error);
  proxy_.setWelcome(Welcome::kServe);
  RawClient served(proxy_.port());
  server_.accept().send(reply_);
  EXPECT_EQ(served.read(reply_.size(), kSafetyNet), reply_);
}

}  // namespace
}  // namespace test_support
