// TCP endpoints on real sockets, from an object's point of view (OPEN-R SDK Internet Protocol Version4).
#include <EndpointTypes.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include "support/test_client.h"
#include "test_system.h"

namespace openr_host {
namespace {

using test_support::TestClient;

constexpr Port kRobotPort = 7000;
constexpr char kClientAddress[] = "127.0.0.3";
constexpr int kPoolSize = 16 * 1024;
constexpr int kBufferSize = 4 * 1024 * 1024;

/// An answer from the stack.
struct Answer {
  antOperation operation;
  int error;
  int size;  ///< of a receive
  void* continuation;
};

bool operator==(const Answer& answer, const std::pair<antOperation, int>& expected) {
  return answer.operation == expected.first && answer.error == expected.second;
}

std::pair<antOperation, int> is(antOperation operation, int error) {
  return {operation, error};
}

class IpStackTest : public testing::Test {
 protected:
  IpStackTest() {
    object_.on_answer = [this](ANTENVMSG message) { record(*antEnvMsg::Receive(message)); };
    test_.boot();
    test_.system.ipStack().takePort(kRobotPort - 1, 0);  // of another object
    host_port_ = test_.system.ipStack().takePort(kRobotPort, 0);
    antEnvCreateSharedBufferMsg message(kBufferSize);
    EXPECT_EQ(call(message), ANT_SUCCESS);
    EXPECT_EQ(message.error, ANT_SUCCESS);
    EXPECT_EQ(message.buffer.Map(), ANT_SUCCESS);
    shared_buffer_ = message.buffer;
    buffer_ = static_cast<byte*>(message.buffer.GetAddress());
  }

  void record(const antEnvMsg& message) {
    Answer answer{message.operation, static_cast<const TCPEndpointBaseMsg&>(message).error, 0, message.continuation};
    if (message.operation == antOperation_TCPListen || message.operation == antOperation_TCPConnect) {
      addresses_.emplace(static_cast<const TCPEndpointAddressesMsg&>(message));
    } else if (message.operation == antOperation_TCPReceive) {
      const auto& received = static_cast<const TCPEndpointReceiveMsg&>(message);
      answer.size = received.sizeMin;
      EXPECT_TRUE(answer.error != TCP_SUCCESS || received.sizeMax == received.sizeMin);
    }
    answers_.push_back(answer);
  }

  template <typename Message>
  antError call(Message& message) {
    antError error = ANT_FAIL;
    test_.as(object_, [&] { error = message.Call(stack_, sizeof(message)); });
    return error;
  }

  template <typename Message>
  antError post(Message message, int continuation = 0) {
    message.continuation = reinterpret_cast<void*>(continuation);
    antError error = ANT_FAIL;
    test_.as(object_, [&] { error = message.Send(stack_, object_.id(), TestObject::kEntry, sizeof(message)); });
    return error;
  }

  antModuleRef createEndpoint(int pool_size = kPoolSize) {
    antEnvCreateEndpointMsg message(EndpointType_TCP, pool_size);
    call(message);
    EXPECT_EQ(message.error, ANT_SUCCESS);
    return message.moduleRef;
  }

  void listen(const antModuleRef& endpoint, int continuation = 0) {
    EXPECT_EQ(post(TCPEndpointListenMsg(endpoint, IP_ADDR_ANY, kRobotPort), continuation), ANT_SUCCESS);
  }
  void send(const antModuleRef& endpoint, int size) { post(TCPEndpointSendMsg(endpoint, buffer_, size)); }
  void send(const antModuleRef& endpoint, const std::string& text) {
    std::memcpy(buffer_, text.data(), text.size());
    send(endpoint, static_cast<int>(text.size()));
  }
  void receive(const antModuleRef& endpoint, int min, int max) {
    post(TCPEndpointReceiveMsg(endpoint, buffer_, min, max));
  }
  void close(const antModuleRef& endpoint, bool abort = false) {
    TCPEndpointCloseMsg message(endpoint);
    message.abort = abort;
    post(message);
  }

  /// Runs until this many answers have come back in total.
  bool haveAnswers(std::size_t count) {
    return test_.runUntil([&] { return answers_.size() >= count; });
  }

  /// Waits for these answers, which have to be all that have come back.
  void expectAnswers(const std::vector<std::pair<antOperation, int>>& expected) {
    EXPECT_TRUE(haveAnswers(expected.size()));
    EXPECT_THAT(answers_, testing::ElementsAreArray(expected));
  }

  /// An endpoint with client_; the answer to the listen is dropped.
  antModuleRef connect(int receive_buffer = 0, int pool_size = kPoolSize) {
    const antModuleRef endpoint = createEndpoint(pool_size);
    listen(endpoint);
    client_.emplace(host_port_, receive_buffer, kClientAddress);
    expectAnswers({is(antOperation_TCPListen, TCP_SUCCESS)});
    answers_.clear();
    return endpoint;
  }

  std::string inBuffer(int size) const {
    return {reinterpret_cast<const char*>(buffer_), static_cast<std::size_t>(size)};
  }

  TestSystem test_;
  TestObject& object_ = test_.add("Object");
  const antStackRef stack_{"IPStack"};
  std::uint16_t host_port_ = 0;
  antSharedBuffer shared_buffer_;
  byte* buffer_ = nullptr;
  std::optional<TestClient> client_;
  std::vector<Answer> answers_;
  std::optional<TCPEndpointAddressesMsg> addresses_;  ///< the last answer to a listen or connect
};

TEST_F(IpStackTest, AListenIsAnsweredWithTheAddressOfTheClient) {
  listen(createEndpoint(), 7);
  test_.runPending();
  EXPECT_THAT(answers_, testing::IsEmpty());
  const TestClient client(host_port_, 0, kClientAddress);
  expectAnswers({is(antOperation_TCPListen, TCP_SUCCESS)});
  EXPECT_EQ(answers_.at(0).continuation, reinterpret_cast<void*>(7));
  EXPECT_EQ(addresses_->lAddress, IPAddress(127, 0, 0, 1));
  EXPECT_EQ(addresses_->fAddress, IPAddress(kClientAddress));
  EXPECT_EQ(addresses_->fPort, client.port());
}

TEST_F(IpStackTest, AReceiveIsAnsweredWhenTheMinimumHasArrivedAndTakesAtMostTheMaximum) {
  const auto endpoint = connect();
  receive(endpoint, 3, 4);
  client_->send("ab");
  test_.runPending();
  EXPECT_THAT(answers_, testing::IsEmpty());
  client_->send("cdefg");
  ASSERT_TRUE(haveAnswers(1));
  EXPECT_EQ(inBuffer(answers_.at(0).size), "abcd");
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
  EXPECT_THAT(answers_, testing::IsEmpty()) << "4 MiB cannot fit into 16 KiB while nobody reads";
  ASSERT_TRUE(test_.runUntil([&] { return client_->received().size() == kBufferSize; }));
  EXPECT_EQ(client_->received(), inBuffer(kBufferSize));
  expectAnswers({is(antOperation_TCPSend, TCP_SUCCESS)});
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

TEST_F(IpStackTest, OneSendAndOneReceiveMayBeUnderWayAndASecondOfEachIsBusy) {
  const auto endpoint = connect(4096);
  receive(endpoint, 1, 1);
  send(endpoint, kBufferSize);
  send(endpoint, 1);
  receive(endpoint, 1, 1);
  expectAnswers({is(antOperation_TCPSend, TCP_CONNECTION_BUSY), is(antOperation_TCPReceive, TCP_CONNECTION_BUSY)});
  client_->send("x");
  ASSERT_TRUE(test_.runUntil([&] { return client_->received().size() == kBufferSize && answers_.size() == 4; }));
  EXPECT_THAT(answers_, testing::Contains(is(antOperation_TCPSend, TCP_SUCCESS)));
  EXPECT_THAT(answers_, testing::Contains(is(antOperation_TCPReceive, TCP_SUCCESS)));
}

TEST_F(IpStackTest, BytesSentBeforeTheClientClosedAreReceivedFirst) {
  const auto endpoint = connect();
  client_->send("last words");
  client_->close();
  receive(endpoint, 1, 100);
  ASSERT_TRUE(haveAnswers(1));
  EXPECT_EQ(inBuffer(answers_.at(0).size), "last words");
  receive(endpoint, 1, 100);
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_EQ(answers_.at(1).error, TCP_CONNECTION_CLOSED);
}

TEST_F(IpStackTest, AResetEndsBothTheSendAndTheReceive) {
  const auto endpoint = connect(4096);
  receive(endpoint, 1, 1);
  send(endpoint, kBufferSize);
  test_.runPending();
  client_->reset();
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_THAT(answers_, testing::UnorderedElementsAre(is(antOperation_TCPReceive, TCP_CONNECTION_RESET),
                                                      is(antOperation_TCPSend, TCP_CONNECTION_RESET)));
}

// Internet Protocol Version4, figure 4 and 2.7: an active close waits in WAITCLOSEIND for the other side.
TEST_F(IpStackTest, ACloseIsAnsweredWhenTheClientHasClosedToo) {
  const auto endpoint = connect();
  close(endpoint);
  ASSERT_TRUE(test_.runUntil([&] { return client_->isAtEnd(); }));
  test_.runPending();
  EXPECT_THAT(answers_, testing::IsEmpty()) << "the client has not closed yet";
  client_->close();
  expectAnswers({is(antOperation_TCPClose, TCP_SUCCESS)});
  send(endpoint, 1);
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_EQ(answers_.at(1).error, TCP_OPERATION_INVALID) << "the endpoint no longer exists";
}

// 2.7: "it can no longer send or receive data", and the other side "will receive the rest of the transmission".
TEST_F(IpStackTest, ACloseEndsTheReceiveAndLetsTheSendFinish) {
  const auto endpoint = connect(4096);
  receive(endpoint, 1, 1);
  send(endpoint, kBufferSize);
  close(endpoint);
  send(endpoint, 1);
  expectAnswers({is(antOperation_TCPReceive, TCP_CONNECTION_CLOSED), is(antOperation_TCPSend, TCP_OPERATION_INVALID)});
  answers_.clear();
  ASSERT_TRUE(test_.runUntil([&] { return client_->isAtEnd(); }));
  EXPECT_EQ(client_->received().size(), static_cast<std::size_t>(kBufferSize));
  client_->close();
  expectAnswers({is(antOperation_TCPSend, TCP_SUCCESS), is(antOperation_TCPClose, TCP_SUCCESS)});
}

// 2.7: "a normal close takes too much time and is aborted by one of the objects".
TEST_F(IpStackTest, AnAbortEndsACloseThatWaits) {
  const auto endpoint = connect();
  close(endpoint);
  test_.runPending();
  close(endpoint, true);
  expectAnswers({is(antOperation_TCPClose, TCP_CONNECTION_RESET), is(antOperation_TCPClose, TCP_SUCCESS)});
}

TEST_F(IpStackTest, ClosingAListeningEndpointEndsTheListen) {
  const auto endpoint = createEndpoint();
  listen(endpoint);
  close(endpoint);
  expectAnswers({is(antOperation_TCPListen, TCP_CONNECTION_CLOSED), is(antOperation_TCPClose, TCP_SUCCESS)});
}

TEST_F(IpStackTest, AClientIsTurnedAwayAtOnceWhileNoEndpointListens) {
  const auto endpoint = connect();
  createEndpoint();  // does not listen
  TestClient newcomer(host_port_);
  ASSERT_TRUE(test_.runUntil([&] { return newcomer.ended(); }));
  send(endpoint, "still here");
  EXPECT_TRUE(test_.runUntil([&] { return client_->received() == "still here"; }));
}

TEST_F(IpStackTest, ConnectionsSendAtOnceAndNoticeAVanishedClient) {
  TcpListener listener("127.0.0.1", 0);
  const TestClient client(listener.port());
  std::optional<TcpConnection> connection;
  ASSERT_TRUE(test_.runUntil([&] { return (connection = listener.accept()).has_value(); }));
  const std::tuple<int, int, int> rows[] = {
      {IPPROTO_TCP, TCP_NODELAY, 1},   {SOL_SOCKET, SO_KEEPALIVE, 1},         {IPPROTO_TCP, TCP_KEEPIDLE, 1},
      {IPPROTO_TCP, TCP_KEEPINTVL, 1}, {IPPROTO_TCP, TCP_USER_TIMEOUT, 2000},
  };
  for (const auto& [level, name, expected] : rows) {
    int value = -1;
    socklen_t size = sizeof(value);
    getsockopt(connection->socket.get(), level, name, &value, &size);
    EXPECT_EQ(value, expected) << name;
  }
}

TEST_F(IpStackTest, DataOutsideASharedBufferIsRefused) {
  const auto endpoint = connect();
  byte own[16];
  post(TCPEndpointSendMsg(endpoint, own, sizeof(own)));
  post(TCPEndpointSendMsg(endpoint, buffer_ + 1, kBufferSize));
  post(TCPEndpointSendMsg(endpoint, buffer_, 0));
  post(TCPEndpointReceiveMsg(endpoint, own, 1, sizeof(own)));
  post(TCPEndpointReceiveMsg(endpoint, buffer_, 1, kBufferSize + 1));
  post(TCPEndpointReceiveMsg(endpoint, buffer_, 0, 1));
  post(TCPEndpointReceiveMsg(endpoint, buffer_, 2, 1));
  ASSERT_TRUE(haveAnswers(7));
  for (const auto& answer : answers_) {
    EXPECT_EQ(answer.error, TCP_BUFFER_INVALID);
  }
}

TEST_F(IpStackTest, RequestsThatDoNotFitTheEndpointsStateAreInvalid) {
  const auto endpoint = createEndpoint();
  send(endpoint, 1);
  receive(endpoint, 1, 1);
  send(antModuleRef(), 1);
  close(antModuleRef());
  listen(antModuleRef());
  ASSERT_TRUE(haveAnswers(5));
  listen(endpoint);
  listen(endpoint);
  ASSERT_TRUE(haveAnswers(6));
  for (const auto& answer : answers_) {
    EXPECT_EQ(answer.error, TCP_OPERATION_INVALID);
  }
}

}  // namespace
}  // namespace openr_host
