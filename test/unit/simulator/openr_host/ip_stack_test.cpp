// TCP and UDP endpoints on real sockets, from an object's point of view (OPEN-R SDK Internet Protocol Version4).
#include <EndpointTypes.h>
#include <gmock/gmock.h>

#include "support/raw_client.h"
#include "test_system.h"

namespace openr_host {
namespace {

using test_support::TestClient;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

constexpr Port kRobotPort = 7000;
constexpr char kClientAddress[] = "127.0.0.3";
constexpr int kPoolSize = 16 * 1024;
constexpr int kBufferSize = 4 * 1024 * 1024;
const IPAddress kThisComputer(127, 0, 0, 1);

/// An object that uses the stack.
class EndpointTest : public testing::Test {
 protected:
  EndpointTest() {
    object_.on_answer = [this](ANTENVMSG message) { record(*antEnvMsg::Receive(message)); };
    test_.boot();
    antEnvCreateSharedBufferMsg message(kBufferSize);
    call(message);
    EXPECT_EQ(message.buffer.Map(), ANT_SUCCESS);
    shared_buffer_ = message.buffer;
    buffer_ = static_cast<byte*>(message.buffer.GetAddress());
  }

  virtual void record(const antEnvMsg& message) = 0;

  template <typename Message>
  void call(Message& message) {
    test_.as(object_, [&] { EXPECT_EQ(message.Call(stack_, sizeof(message)), ANT_SUCCESS); });
  }
  template <typename Message>
  void post(Message message) {
    const auto send = [&] { return message.Send(stack_, object_.id(), TestObject::kEntry, sizeof(message)); };
    test_.as(object_, [&] { EXPECT_EQ(send(), ANT_SUCCESS); });
  }

  antModuleRef createEndpoint(int32 type, int pool_size) {
    antEnvCreateEndpointMsg message(type, pool_size);
    call(message);
    EXPECT_EQ(message.error, ANT_SUCCESS);
    return message.moduleRef;
  }

  /// Runs until this many answers have come back in total.
  bool haveAnswers(std::size_t count) {
    return test_.runUntil([&] { return answers_.size() >= count; });
  }

  /// Waits for these answers, which have to be all that have come back, and drops them.
  void expectAnswers(const std::vector<std::pair<antOperation, int>>& expected) {
    EXPECT_TRUE(haveAnswers(expected.size()));
    EXPECT_EQ(answers_, expected);
    answers_.clear();
  }

  std::string inBuffer(int size) const {
    return {reinterpret_cast<const char*>(buffer_), static_cast<std::size_t>(size)};
  }

  TestSystem test_;
  TestObject& object_ = test_.add("Object");
  const antStackRef stack_{"IPStack"};
  antSharedBuffer shared_buffer_;
  byte* buffer_ = nullptr;
  std::vector<std::pair<antOperation, int>> answers_;  ///< and their errors
};

class IpStackTest : public EndpointTest {
 protected:
  IpStackTest() {
    test_.system.ipStack().takePort(kRobotPort - 1, 0);  // of another object
    host_port_ = test_.system.ipStack().takePort(kRobotPort, 0);
  }

  void record(const antEnvMsg& message) override {
    answers_.emplace_back(message.operation, static_cast<const TCPEndpointBaseMsg&>(message).error);
    continuation_ = message.continuation;
    if (message.operation == antOperation_TCPListen) {
      addresses_.emplace(static_cast<const TCPEndpointAddressesMsg&>(message));
    } else if (message.operation == antOperation_TCPReceive) {
      received_ = static_cast<const TCPEndpointReceiveMsg&>(message).sizeMin;
    }
  }

  antModuleRef create(int pool_size = kPoolSize) { return createEndpoint(EndpointType_TCP, pool_size); }
  void listen(const antModuleRef& endpoint) {
    TCPEndpointListenMsg message(endpoint, IP_ADDR_ANY, kRobotPort);
    message.continuation = &host_port_;
    post(message);
  }
  void send(const antModuleRef& endpoint, int size) { post(TCPEndpointSendMsg(endpoint, buffer_, size)); }
  void receive(const antModuleRef& endpoint, int min, int max) {
    post(TCPEndpointReceiveMsg(endpoint, buffer_, min, max));
  }
  void close(const antModuleRef& endpoint) { post(TCPEndpointCloseMsg(endpoint)); }

  /// An endpoint with client_.
  antModuleRef connect(int receive_buffer = 0, int pool_size = kPoolSize) {
    const antModuleRef endpoint = create(pool_size);
    listen(endpoint);
    test_.runPending();
    EXPECT_THAT(answers_, IsEmpty());
    client_.emplace(host_port_, receive_buffer, kClientAddress);
    expectAnswers({{antOperation_TCPListen, TCP_SUCCESS}});
    return endpoint;
  }

  std::uint16_t host_port_ = 0;
  std::optional<TestClient> client_;
  void* continuation_ = nullptr;
  int received_ = 0;
  std::optional<TCPEndpointAddressesMsg> addresses_;  ///< the last answer to a listen
};

TEST_F(IpStackTest, AListenIsAnsweredWithTheAddressOfTheClient) {
  connect();
  EXPECT_EQ(continuation_, &host_port_);
  EXPECT_EQ(addresses_->lAddress, kThisComputer);
  EXPECT_EQ(addresses_->fAddress, IPAddress(kClientAddress));
  EXPECT_EQ(addresses_->fPort, client_->port());
}

TEST_F(IpStackTest, AReceiveTakesFromTheMinimumToTheMaximum) {
  const auto endpoint = connect();
  receive(endpoint, 3, 4);
  client_->send("ab");
  test_.runPending();
  EXPECT_THAT(answers_, IsEmpty());
  client_->send("cdefg");
  ASSERT_TRUE(haveAnswers(1));
  EXPECT_EQ(inBuffer(received_), "abcd");
  receive(endpoint, 3, 3);
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_EQ(inBuffer(3), "efg") << "the rest";
}

TEST_F(IpStackTest, ALargeSendArrivesCompletelyThroughASmallSendBuffer) {
  const auto endpoint = connect(4096);
  for (int i = 0; i < kBufferSize; ++i) {
    buffer_[i] = static_cast<byte>(i * 31 + i / 251);
  }
  send(endpoint, kBufferSize);
  test_.runPending();
  EXPECT_THAT(answers_, IsEmpty()) << "4 MiB cannot fit into 16 KiB while nobody reads";
  ASSERT_TRUE(test_.runUntil([&] { return client_->received().size() == kBufferSize; }));
  EXPECT_EQ(client_->received(), inBuffer(kBufferSize));
  expectAnswers({{antOperation_TCPSend, TCP_SUCCESS}});
}

// docs/architecture.md, "Threads": a client that stops reading gets few stale pictures.
TEST_F(IpStackTest, ASmallPoolHoldsLittleForAClientThatDoesNotRead) {
  const auto endpoint = connect(4096, 8 * 1024);
  std::size_t pictures = 0;
  do {
    send(endpoint, 4 * 1024);
    test_.runPending();
    ++pictures;
  } while (answers_.size() == pictures);
  EXPECT_LE(pictures, 16U);  // with the kernel's default, hundreds
}

TEST_F(IpStackTest, BytesSentBeforeTheClientClosedAreReceivedFirst) {
  const auto endpoint = connect();
  client_->send("last words");
  client_->close();
  receive(endpoint, 1, 100);
  expectAnswers({{antOperation_TCPReceive, TCP_SUCCESS}});
  EXPECT_EQ(inBuffer(received_), "last words");
  receive(endpoint, 1, 100);
  expectAnswers({{antOperation_TCPReceive, TCP_CONNECTION_CLOSED}});
}

TEST_F(IpStackTest, ASecondSendOrReceiveIsBusyAndAResetEndsTheFirst) {
  const auto endpoint = connect(4096);
  for (int i = 0; i < 2; ++i) {
    receive(endpoint, 1, 1);
    send(endpoint, kBufferSize);
  }
  expectAnswers({{antOperation_TCPReceive, TCP_CONNECTION_BUSY}, {antOperation_TCPSend, TCP_CONNECTION_BUSY}});
  client_->reset();
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_THAT(answers_, testing::UnorderedElementsAre(Pair(antOperation_TCPReceive, TCP_CONNECTION_RESET),
                                                      Pair(antOperation_TCPSend, TCP_CONNECTION_RESET)));
}

// Figure 4 and 2.7: an active close waits in WAITCLOSEIND for the other side. "It can no longer send or receive data",
// and the other side "will receive the rest of the transmission".
TEST_F(IpStackTest, ACloseEndsTheReceiveLetsTheSendFinishAndWaitsForTheClient) {
  const auto endpoint = connect(4096);
  receive(endpoint, 1, 1);
  send(endpoint, kBufferSize);
  close(endpoint);
  send(endpoint, 1);
  expectAnswers({{antOperation_TCPReceive, TCP_CONNECTION_CLOSED}, {antOperation_TCPSend, TCP_OPERATION_INVALID}});
  ASSERT_TRUE(test_.runUntil([&] { return client_->isAtEnd(); }));
  EXPECT_EQ(client_->received().size(), static_cast<std::size_t>(kBufferSize));
  expectAnswers({{antOperation_TCPSend, TCP_SUCCESS}});
  test_.runPending();
  EXPECT_THAT(answers_, IsEmpty()) << "the client has not closed yet";
  client_->close();
  expectAnswers({{antOperation_TCPClose, TCP_SUCCESS}});
  send(endpoint, 1);
  expectAnswers({{antOperation_TCPSend, TCP_OPERATION_INVALID}});
}

TEST_F(IpStackTest, ClosingAListeningEndpointEndsTheListen) {
  const auto endpoint = create();
  listen(endpoint);
  close(endpoint);
  expectAnswers({{antOperation_TCPListen, TCP_CONNECTION_CLOSED}, {antOperation_TCPClose, TCP_SUCCESS}});
}

class UdpEndpointTest : public EndpointTest {
 protected:
  void record(const antEnvMsg& message) override {
    answers_.emplace_back(message.operation, static_cast<const UDPEndpointBaseMsg&>(message).error);
    if (message.operation == antOperation_UDPReceive) {
      received_.emplace(static_cast<const UDPEndpointReceiveMsg&>(message));
    }
  }

  antModuleRef create() { return createEndpoint(EndpointType_UDP, 8192); }
  /// @return the port taken
  Port bind(const antModuleRef& endpoint, Port port = IP_PORT_ANY) {
    UDPEndpointBindMsg message(endpoint, IP_ADDR_ANY, port);
    call(message);
    EXPECT_EQ(message.error, UDP_SUCCESS);
    EXPECT_EQ(message.address, kThisComputer);
    return message.port;
  }
  void send(const antModuleRef& endpoint, Port port, byte* data, int size) {
    post(UDPEndpointSendMsg(endpoint, kThisComputer, port, data, size));
  }
  void receive(const antModuleRef& endpoint, int size) {
    post(UDPEndpointReceiveMsg(endpoint, buffer_ + kBufferSize / 2, size));
  }

  std::optional<UDPEndpointReceiveMsg> received_;
};

TEST_F(UdpEndpointTest, APacketArrivesWithItsSenderAtAnyPortOfTheComputer) {
  constexpr Port kPrivileged = 7;  // only root may open it
  const Port host_port = test_.system.ipStack().takePort(kPrivileged, 0);
  const auto server = create();
  EXPECT_EQ(bind(server, kPrivileged), kPrivileged);
  const auto client = create();
  const Port client_port = bind(client);
  EXPECT_GE(client_port, 1024);
  receive(server, 100);
  test_.runPending();
  EXPECT_THAT(answers_, IsEmpty());
  std::memcpy(buffer_, "hello", 5);
  send(client, host_port, buffer_, 5);
  expectAnswers({{antOperation_UDPSend, UDP_SUCCESS}, {antOperation_UDPReceive, UDP_SUCCESS}});
  EXPECT_EQ(received_->size, 5);
  EXPECT_EQ(std::memcmp(buffer_ + kBufferSize / 2, "hello", 5), 0);
  EXPECT_EQ(received_->address, kThisComputer);
  EXPECT_EQ(received_->port, client_port);
}

TEST_F(UdpEndpointTest, ASecondReceiveIsBusyAndClosingEndsTheFirst) {
  const auto endpoint = create();
  bind(endpoint);
  receive(endpoint, 1);
  receive(endpoint, 1);
  post(UDPEndpointCloseMsg(endpoint));
  receive(endpoint, 1);
  expectAnswers({{antOperation_UDPReceive, UDP_CONNECTION_BUSY},
                 {antOperation_UDPReceive, UDP_CONNECTION_CLOSED},
                 {antOperation_UDPClose, UDP_SUCCESS},
                 {antOperation_UDPReceive, UDP_OPERATION_INVALID}});
}

}  // namespace
}  // namespace openr_host
