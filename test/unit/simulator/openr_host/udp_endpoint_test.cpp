// UDP endpoints on real sockets, from an object's point of view (OPEN-R SDK Internet Protocol Version4, chapter 3).
#include <EndpointTypes.h>
#include <gmock/gmock.h>

#include "support/udp_socket.h"
#include "test_system.h"

namespace openr_host {
namespace {

using testing::ElementsAre;

constexpr uint32 kSharedSize = 64 * 1024;
const IPAddress kThisComputer(127, 0, 0, 1);

class UdpEndpointTest : public testing::Test {
 protected:
  struct Answer {
    antOperation operation;
    UDPEndpointError error;

    bool operator==(const Answer& other) const { return operation == other.operation && error == other.error; }
  };

  UdpEndpointTest() {
    object_.on_answer = [this](ANTENVMSG message) {
      const auto& answered = static_cast<const UDPEndpointBaseMsg&>(*antEnvMsg::Receive(message));
      answers_.push_back({answered.operation, answered.error});
      if (answered.operation == antOperation_UDPReceive) {
        received_.push_back(static_cast<const UDPEndpointReceiveMsg&>(answered));
      }
    };
    test_.boot();
    antEnvCreateSharedBufferMsg message(kSharedSize);
    call(message);
    buffer_ = static_cast<byte*>(message.buffer.GetAddress());
  }

  template <typename Message>
  void call(Message& message) {
    test_.as(object_, [&] { EXPECT_EQ(message.Call(stack_, sizeof(message)), ANT_SUCCESS); });
  }
  template <typename Message>
  void post(Message message) {
    test_.as(object_,
             [&] { EXPECT_EQ(message.Send(stack_, object_.id(), TestObject::kEntry, sizeof(message)), ANT_SUCCESS); });
  }

  antModuleRef create() {
    antEnvCreateEndpointMsg message(EndpointType_UDP, 8192);
    call(message);
    EXPECT_EQ(message.error, ANT_SUCCESS);
    return message.moduleRef;
  }
  /// @return the port taken
  Port bind(const antModuleRef& endpoint, Port port = IP_PORT_ANY) {
    UDPEndpointBindMsg message(endpoint, IP_ADDR_ANY, port);
    call(message);
    EXPECT_EQ(message.error, UDP_SUCCESS);
    EXPECT_EQ(message.address, kThisComputer);
    return message.port;
  }
  void sendTo(const antModuleRef& endpoint, Port port, const std::string& text) {
    std::memcpy(buffer_, text.data(), text.size());
    post(UDPEndpointSendMsg(endpoint, kThisComputer, port, buffer_, static_cast<int>(text.size())));
  }
  byte* inbox() const { return buffer_ + kSharedSize / 2; }
  void receive(const antModuleRef& endpoint, int size) { post(UDPEndpointReceiveMsg(endpoint, inbox(), size)); }
  std::string inboxText(std::size_t size) const { return {reinterpret_cast<const char*>(inbox()), size}; }
  bool haveAnswers(std::size_t count) {
    return test_.runUntil([&] { return answers_.size() >= count; });
  }

  TestSystem test_;
  TestObject& object_ = test_.add("Object");
  const antStackRef stack_{"IPStack"};
  byte* buffer_ = nullptr;
  std::vector<Answer> answers_;
  std::vector<UDPEndpointReceiveMsg> received_;
};

TEST_F(UdpEndpointTest, APacketArrivesWithTheAddressOfItsSender) {
  const auto server = create();
  const Port server_port = bind(server);
  EXPECT_GE(server_port, 1024);
  const auto client = create();
  const Port client_port = bind(client);
  receive(server, 100);
  test_.runPending();
  EXPECT_THAT(answers_, testing::IsEmpty());
  sendTo(client, server_port, "hello");
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_THAT(answers_,
              ElementsAre(Answer{antOperation_UDPSend, UDP_SUCCESS}, Answer{antOperation_UDPReceive, UDP_SUCCESS}));
  EXPECT_EQ(received_[0].size, 5);
  EXPECT_EQ(inboxText(5), "hello");
  EXPECT_EQ(received_[0].address, kThisComputer);
  EXPECT_EQ(received_[0].port, client_port);
}

TEST_F(UdpEndpointTest, APortOfTheRobotMayBeAnotherOneOfTheComputer) {
  constexpr Port kPrivileged = 7;  // only root may open it
  const Port host_port = test_.system.ipStack().takePort(kPrivileged, 0);
  const auto server = create();
  EXPECT_EQ(bind(server, kPrivileged), kPrivileged);
  const auto client = create();
  bind(client);
  receive(server, 100);
  sendTo(client, host_port, "hello");
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_EQ(inboxText(5), "hello");
}

TEST_F(UdpEndpointTest, ASecondReceiveIsBusyAndClosingEndsTheFirst) {
  const auto endpoint = create();
  bind(endpoint);
  receive(endpoint, 1);
  receive(endpoint, 1);
  post(UDPEndpointCloseMsg(endpoint));
  receive(endpoint, 1);
  ASSERT_TRUE(haveAnswers(4));
  EXPECT_THAT(answers_, ElementsAre(Answer{antOperation_UDPReceive, UDP_CONNECTION_BUSY},
                                    Answer{antOperation_UDPReceive, UDP_CONNECTION_CLOSED},
                                    Answer{antOperation_UDPClose, UDP_SUCCESS},
                                    Answer{antOperation_UDPReceive, UDP_OPERATION_INVALID}));
}

TEST_F(UdpEndpointTest, APortCanBeTakenOnlyOnceUntilItIsClosed) {
  const auto first = create();
  const Port port = bind(first);
  const auto other = create();
  UDPEndpointBindMsg second(other, IP_ADDR_ANY, port);
  call(second);
  EXPECT_EQ(second.error, UDP_ADDRESSINUSE);
  UDPEndpointCloseMsg close(first);
  call(close);
  EXPECT_EQ(bind(other, port), port);
}

TEST_F(UdpEndpointTest, DataOutsideASharedBufferOrTooLargeForAPacketIsRefused) {
  const auto endpoint = create();
  const Port port = bind(endpoint);
  byte own[4];
  post(UDPEndpointSendMsg(endpoint, kThisComputer, port, own, sizeof(own)));
  post(UDPEndpointReceiveMsg(endpoint, own, sizeof(own)));
  post(UDPEndpointSendMsg(endpoint, kThisComputer, port, buffer_, 0));
  post(UDPEndpointSendMsg(endpoint, kThisComputer, port, buffer_, kSharedSize));
  sendTo(endpoint, port, "small");
  ASSERT_TRUE(haveAnswers(5));
  EXPECT_THAT(
      answers_,
      ElementsAre(Answer{antOperation_UDPSend, UDP_BUFFER_INVALID}, Answer{antOperation_UDPReceive, UDP_BUFFER_INVALID},
                  Answer{antOperation_UDPSend, UDP_BUFFER_INVALID}, Answer{antOperation_UDPSend, UDP_MESSAGE_TOO_LONG},
                  Answer{antOperation_UDPSend, UDP_SUCCESS}));
}

}  // namespace
}  // namespace openr_host
