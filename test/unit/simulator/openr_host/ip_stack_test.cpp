// TCP endpoints on real sockets, from an object's point of view (OPEN-R SDK Internet Protocol Version4).
#include <EndpointTypes.h>
#include <gmock/gmock.h>
#include <netinet/tcp.h>
#include <sys/resource.h>

#include <cstring>
#include <functional>
#include <optional>
#include <sstream>

#include "support/test_client.h"
#include "test_system.h"

namespace openr_host {
namespace {

using test_support::TestClient;
using testing::IsEmpty;

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
    test_.as(object_, [&] { error = message.Send(stack_, object_.id(), TestObject::kSecond, sizeof(message)); });
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
  EXPECT_THAT(answers_, IsEmpty());
  const TestClient client(host_port_, 0, kClientAddress);
  expectAnswers({is(antOperation_TCPListen, TCP_SUCCESS)});
  EXPECT_EQ(answers_.at(0).continuation, reinterpret_cast<void*>(7));
  EXPECT_EQ(addresses_->lAddress, IPAddress(127, 0, 0, 1));
  EXPECT_EQ(addresses_->fAddress, IPAddress(kClientAddress));
  EXPECT_EQ(addresses_->fPort, client.port());
}

TEST_F(IpStackTest, AReceiveIsAnsweredWhenTheMinimumHasArrived) {
  const auto endpoint = connect();
  receive(endpoint, 3, 10);
  for (const char letter : {'a', 'b'}) {
    client_->send(std::string(1, letter));
    test_.runPending();
    EXPECT_THAT(answers_, IsEmpty());
  }
  client_->send("c");
  expectAnswers({is(antOperation_TCPReceive, TCP_SUCCESS)});
  EXPECT_EQ(answers_.at(0).size, 3);
  EXPECT_EQ(inBuffer(3), "abc");
}

TEST_F(IpStackTest, AReceiveTakesAtMostTheMaximumAndLeavesTheRest) {
  const auto endpoint = connect();
  client_->send("abcdefg");
  receive(endpoint, 1, 4);
  ASSERT_TRUE(haveAnswers(1));
  EXPECT_EQ(answers_.at(0).size, 4);
  EXPECT_EQ(inBuffer(4), "abcd");
  receive(endpoint, 3, 3);
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_EQ(inBuffer(3), "efg");
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
  expectAnswers({is(antOperation_TCPSend, TCP_SUCCESS)});
}

TEST_F(IpStackTest, ASmallPoolHoldsLittleForAClientThatDoesNotRead) {
  const auto endpoint = connect(4096, 8 * 1024);
  constexpr std::size_t kPicture = 4 * 1024;
  std::size_t pictures = 0;
  do {
    send(endpoint, kPicture);
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
  // The first ones still succeed.
  client_->send("x");
  ASSERT_TRUE(test_.runUntil([&] { return client_->received().size() == kBufferSize && answers_.size() == 4; }));
  EXPECT_THAT(answers_, testing::Contains(is(antOperation_TCPSend, TCP_SUCCESS)));
  EXPECT_THAT(answers_, testing::Contains(is(antOperation_TCPReceive, TCP_SUCCESS)));
}

TEST_F(IpStackTest, AReceiveEndsWithConnectionClosedWhenTheClientHasClosed) {
  const auto endpoint = connect();
  client_->send("ab");
  receive(endpoint, 3, 10);
  client_->close();
  expectAnswers({is(antOperation_TCPReceive, TCP_CONNECTION_CLOSED)});
  EXPECT_EQ(answers_.at(0).size, 2);
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

TEST_F(IpStackTest, AClientThatHasFinishedSendingStillGetsItsReply) {
  const auto endpoint = connect();
  client_->finishSending();
  receive(endpoint, 1, 1);
  send(endpoint, "reply");
  ASSERT_TRUE(test_.runUntil([&] { return client_->received() == "reply"; }));
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_THAT(answers_, testing::UnorderedElementsAre(is(antOperation_TCPReceive, TCP_CONNECTION_CLOSED),
                                                      is(antOperation_TCPSend, TCP_SUCCESS)));
  close(endpoint);
  ASSERT_TRUE(test_.runUntil([&] { return client_->ended(); }));
  EXPECT_FALSE(client_->wasReset());
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
  send(endpoint, 1);
  ASSERT_TRUE(haveAnswers(3));
  EXPECT_EQ(answers_.at(2).error, TCP_CONNECTION_RESET);
}

// Internet Protocol Version4, figure 4 and 2.7: an active close waits in WAITCLOSEIND for the other side.
TEST_F(IpStackTest, ACloseIsAnsweredWhenTheClientHasClosedToo) {
  const auto endpoint = connect();
  close(endpoint);
  ASSERT_TRUE(test_.runUntil([&] { return client_->isAtEnd(); }));
  test_.runPending();
  EXPECT_THAT(answers_, IsEmpty()) << "the client has not closed yet";
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
  receive(endpoint, 1, 1);
  send(endpoint, 1);
  close(endpoint);
  expectAnswers({is(antOperation_TCPReceive, TCP_CONNECTION_CLOSED), is(antOperation_TCPReceive, TCP_OPERATION_INVALID),
                 is(antOperation_TCPSend, TCP_OPERATION_INVALID), is(antOperation_TCPClose, TCP_OPERATION_INVALID)});
  answers_.clear();
  ASSERT_TRUE(test_.runUntil([&] { return client_->isAtEnd(); }));
  EXPECT_EQ(client_->received().size(), static_cast<std::size_t>(kBufferSize));
  client_->close();
  expectAnswers({is(antOperation_TCPSend, TCP_SUCCESS), is(antOperation_TCPClose, TCP_SUCCESS)});
}

TEST_F(IpStackTest, ACloseIsAnsweredAtOnceIfTheClientHasClosedBefore) {
  const auto endpoint = connect();
  client_->send("unread");
  client_->close();
  receive(endpoint, 100, 100);
  ASSERT_TRUE(haveAnswers(1));
  EXPECT_EQ(answers_.at(0).error, TCP_CONNECTION_CLOSED);
  close(endpoint);
  test_.run();
  ASSERT_EQ(answers_.size(), 2U);
  EXPECT_THAT(answers_.at(1), is(antOperation_TCPClose, TCP_SUCCESS));
}

// 2.7: "a normal close takes too much time and is aborted by one of the objects".
TEST_F(IpStackTest, AnAbortEndsACloseThatWaits) {
  const auto endpoint = connect();
  close(endpoint);
  test_.runPending();
  close(endpoint, true);
  expectAnswers({is(antOperation_TCPClose, TCP_CONNECTION_RESET), is(antOperation_TCPClose, TCP_SUCCESS)});
}

TEST_F(IpStackTest, AResetByTheClientEndsACloseThatWaits) {
  const auto endpoint = connect(4096);
  send(endpoint, kBufferSize);
  close(endpoint);
  test_.runPending();
  client_->reset();
  ASSERT_TRUE(haveAnswers(2));
  close(endpoint);
  expectAnswers({is(antOperation_TCPSend, TCP_CONNECTION_RESET), is(antOperation_TCPClose, TCP_CONNECTION_RESET),
                 is(antOperation_TCPClose, TCP_OPERATION_INVALID)});
}

TEST_F(IpStackTest, AnAbortFirstEndsTheRequestsUnderWay) {
  const auto endpoint = connect(4096);
  receive(endpoint, 1, 1);
  send(endpoint, kBufferSize);
  close(endpoint, true);
  expectAnswers({is(antOperation_TCPReceive, TCP_CONNECTION_CLOSED), is(antOperation_TCPSend, TCP_CONNECTION_CLOSED),
                 is(antOperation_TCPClose, TCP_SUCCESS)});
}

TEST_F(IpStackTest, ACloseThatWaitsCannotBeCalled) {
  const auto endpoint = connect();
  TCPEndpointCloseMsg orderly(endpoint);
  EXPECT_EQ(call(orderly), ANT_FAIL);
  TCPEndpointCloseMsg aborting(endpoint, false, 0, true);
  for (const TCPEndpointError error : {TCP_SUCCESS, TCP_OPERATION_INVALID}) {
    EXPECT_EQ(call(aborting), ANT_SUCCESS);
    EXPECT_EQ(aborting.error, error);
  }
}

TEST_F(IpStackTest, TheClientGetsAllBytesSentBeforeTheCloseEvenIfItsOwnWereNeverRead) {
  const auto endpoint = connect();
  client_->send("nobody reads this");
  send(endpoint, "goodbye");
  close(endpoint);
  ASSERT_TRUE(test_.runUntil([&] { return client_->isAtEnd(); }));
  EXPECT_EQ(client_->received(), "goodbye");
  client_->send("nor this");
  test_.runPending();
  EXPECT_FALSE(client_->wasReset());
}

TEST_F(IpStackTest, AnAbortResetsTheConnection) {
  const auto endpoint = connect();
  close(endpoint, true);
  ASSERT_TRUE(test_.runUntil([&] { return client_->wasReset(); }));
  expectAnswers({is(antOperation_TCPClose, TCP_SUCCESS)});
}

TEST_F(IpStackTest, ClosingAListeningEndpointEndsTheListen) {
  const auto endpoint = createEndpoint();
  const auto other = createEndpoint();
  listen(endpoint);
  listen(other);
  close(endpoint);
  TCPEndpointCloseMsg message(other);
  EXPECT_EQ(call(message), ANT_SUCCESS);
  EXPECT_EQ(message.error, TCP_SUCCESS);
  expectAnswers({is(antOperation_TCPListen, TCP_CONNECTION_CLOSED), is(antOperation_TCPClose, TCP_SUCCESS),
                 is(antOperation_TCPListen, TCP_CONNECTION_CLOSED)});
  TestClient client(host_port_);
  EXPECT_TRUE(test_.runUntil([&] { return client.isAtEnd(); }));
}

TEST_F(IpStackTest, AClientIsTurnedAwayAtOnceWhileNoEndpointListens) {
  const auto closed = createEndpoint();
  const auto endpoint = connect();
  TCPEndpointCloseMsg message(closed);
  call(message);
  test_.runPending();
  createEndpoint();  // not in place of another one
  TestClient newcomer(host_port_);
  ASSERT_TRUE(test_.runUntil([&] { return newcomer.isAtEnd() || newcomer.wasReset(); }));
  send(endpoint, "still here");
  EXPECT_TRUE(test_.runUntil([&] { return client_->received() == "still here"; }));
}

TEST_F(IpStackTest, ClientsAreTurnedAwayWithoutDescriptorsAndTheNextOneIsServed) {
  listen(createEndpoint());
  TestClient client(host_port_);
  TestClient second_client(host_port_);
  rlimit usual{};
  getrlimit(RLIMIT_NOFILE, &usual);
  rlimit exhausted = usual;
  exhausted.rlim_cur = static_cast<rlim_t>(FileDescriptor(dup(STDERR_FILENO)).get());  // the lowest free one
  setrlimit(RLIMIT_NOFILE, &exhausted);
  EXPECT_TRUE(test_.runUntil([&] { return client.isAtEnd() || client.wasReset(); }));
  EXPECT_TRUE(test_.runUntil([&] { return second_client.isAtEnd() || second_client.wasReset(); }));
  setrlimit(RLIMIT_NOFILE, &usual);
  EXPECT_THAT(answers_, IsEmpty());
  const TestClient next(host_port_);
  expectAnswers({is(antOperation_TCPListen, TCP_SUCCESS)});
}

TEST_F(IpStackTest, EndpointsThatListenOnTheSamePortGetClientsInTheirOrder) {
  listen(createEndpoint(), 1);
  listen(createEndpoint(), 2);
  const TestClient first(host_port_);
  const TestClient second(host_port_);
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_EQ(answers_.at(0).continuation, reinterpret_cast<void*>(1));
  EXPECT_EQ(answers_.at(1).continuation, reinterpret_cast<void*>(2));
}

/// Whatever has ended before, and however.
TEST_F(IpStackTest, ANewEndpointIsAsTheFirstOne) {
  std::ostringstream seen;
  const auto tell = [&](std::size_t count) {
    EXPECT_TRUE(haveAnswers(count));
    for (const Answer& answer : answers_) {
      seen << answer.operation << " " << answer.error << " " << answer.size << " " << answer.continuation << "\n";
    }
    answers_.clear();
  };
  const auto use_new_endpoint = [&] {
    constexpr int kMuch = 100000;
    answers_.clear();
    seen.str("");
    const auto endpoint = createEndpoint();
    listen(endpoint, 5);
    test_.runPending();
    tell(0);
    TestClient client(host_port_, 4096);
    tell(1);
    seen << (addresses_->fPort == client.port()) << "\n";
    for (const char* parts : {"cdefgh", "uvwxyz"}) {
      receive(endpoint, 3, 6);
      client.send("ab");
      test_.runPending();
      tell(0);
      client.send(parts);
      tell(1);
      seen << inBuffer(6) << "\n";
      receive(endpoint, 1, 6);  // the rest
      tell(1);
    }
    for (int i = 0; i < kMuch; ++i) {
      buffer_[i] = static_cast<byte>(i / 100);
    }
    for (const int size : {kMuch, kMuch - 1}) {
      receive(endpoint, 9, 9);
      receive(endpoint, 9, 9);
      send(endpoint, size);
      send(endpoint, 1);
      test_.runPending();
      tell(2);
      EXPECT_TRUE(test_.runUntil([&] { return client.received().size() == static_cast<std::size_t>(size); }));
      seen << (client.take(static_cast<std::size_t>(size)).back() == buffer_[size - 1]) << "\n";
      client.send("until nine");
      tell(2);
      receive(endpoint, 1, 1);
      tell(1);
    }
    receive(endpoint, 1, 1);
    close(endpoint);
    EXPECT_TRUE(test_.runUntil([&] { return client.isAtEnd(); }));
    tell(1);
    client.close();
    tell(1);
    close(endpoint);
    tell(1);
    return seen.str();
  };
  const std::string first = use_new_endpoint();
  const auto connect_and_work = [this] {
    const auto endpoint = connect(4096);
    client_->send("ab");
    receive(endpoint, 3, 9);
    send(endpoint, kBufferSize);
    test_.runPending();
    return endpoint;
  };
  const std::pair<const char*, std::function<void()>> histories[] = {
      {"an abort", [&] { close(connect_and_work(), true); }},
      {"a reset",
       [&] {
         const auto endpoint = connect_and_work();
         client_->reset();
         haveAnswers(2);
         close(endpoint);
       }},
      {"a client that has gone",
       [&] {
         const auto endpoint = connect_and_work();
         client_->finishSending();
         haveAnswers(1);
         close(endpoint, true);
       }},
      {"a close that was aborted",
       [&] {
         const auto endpoint = connect_and_work();
         close(endpoint);
         test_.runPending();
         close(endpoint, true);
       }},
      {"a close that was reset",
       [&] {
         const auto endpoint = connect();
         close(endpoint);
         test_.runPending();
         client_->reset();
         haveAnswers(1);
       }},
      {"closed listeners",
       [&] {
         const auto endpoint = createEndpoint();
         const auto other = createEndpoint();
         listen(endpoint);
         listen(other);
         close(endpoint);
         TCPEndpointCloseMsg message(other);
         call(message);
       }},
      {"a listener that was closed with its client",
       [&] {
         const auto endpoint = createEndpoint();
         listen(endpoint);
         TestClient(host_port_).reset();
         haveAnswers(1);
         close(endpoint, true);
       }},
      {"connections to others",
       [&] {
         const auto under_way = createEndpoint();
         const auto refused = createEndpoint();
         const TcpListener server("127.0.0.1", 0);
         post(TCPEndpointConnectMsg(under_way, IP_ADDR_ANY, IP_PORT_ANY, IPAddress("127.0.0.1"), server.port()));
         post(TCPEndpointConnectMsg(refused, IP_ADDR_ANY, IP_PORT_ANY, IPAddress("127.0.0.1"), 1));
         haveAnswers(2);
         close(under_way, true);
         close(refused);
       }},
      {"refused requests",
       [&] {
         const auto endpoint = connect();
         post(TCPEndpointSendMsg(endpoint, buffer_ - 1, 5));
         post(TCPEndpointReceiveMsg(endpoint, buffer_, 5, 4));
         listen(endpoint);
         haveAnswers(3);
         client_->close();
         close(endpoint);
       }},
      {"a client without an endpoint", [&] {
         TestClient client(host_port_);
         test_.runUntil([&] { return client.ended(); });
       }}};
  for (const auto& [name, history] : histories) {
    answers_.clear();
    history();
    test_.runPending();
    EXPECT_EQ(use_new_endpoint(), first) << "after " << name;
  }
}

TEST_F(IpStackTest, AClientThatArrivesWhileTheObjectIsAboutToListenAgainIsServed) {
  antModuleRef endpoint = connect();
  object_.on_answer = [&](ANTENVMSG message) {
    record(*antEnvMsg::Receive(message));
    if (answers_.back().operation == antOperation_TCPReceive) {
      close(endpoint);
    } else if (answers_.back().operation == antOperation_TCPClose) {
      listen(createEndpoint());
    }
  };
  receive(endpoint, 1, 1);
  client_->close();
  TestClient next(host_port_);
  expectAnswers({is(antOperation_TCPReceive, TCP_CONNECTION_CLOSED), is(antOperation_TCPClose, TCP_SUCCESS),
                 is(antOperation_TCPListen, TCP_SUCCESS)});
}

// Internet Protocol Version4, 2.3.
TEST_F(IpStackTest, AnEndpointConnectsToAServerAndGetsItsOwnAddress) {
  TcpListener server("127.0.0.1", 0);
  const auto endpoint = createEndpoint();
  post(TCPEndpointConnectMsg(endpoint, IP_ADDR_ANY, IP_PORT_ANY, IPAddress("127.0.0.1"), server.port()));
  expectAnswers({is(antOperation_TCPConnect, TCP_SUCCESS)});
  std::optional<TcpConnection> connection;
  ASSERT_TRUE(test_.runUntil([&] { return (connection = server.accept()).has_value(); }));
  EXPECT_EQ(addresses_->lAddress, connection->client.address);
  EXPECT_EQ(addresses_->lPort, connection->client.port);

  send(endpoint, "hello");
  ASSERT_TRUE(haveAnswers(2));
  char heard[5] = {};
  EXPECT_EQ(::recv(connection->socket.get(), heard, sizeof(heard), 0), 5);
  EXPECT_EQ(std::string(heard, 5), "hello");
  EXPECT_EQ(::send(connection->socket.get(), "you", 3, 0), 3);
  receive(endpoint, 3, 3);
  ASSERT_TRUE(haveAnswers(3));
  EXPECT_EQ(inBuffer(3), "you");
}

TEST_F(IpStackTest, ClosingEndsAConnectThatIsUnderWay) {
  const TcpListener server("127.0.0.1", 0);
  const auto endpoint = createEndpoint();
  post(TCPEndpointConnectMsg(endpoint, IP_ADDR_ANY, IP_PORT_ANY, IPAddress("127.0.0.1"), server.port()));
  close(endpoint);
  expectAnswers({is(antOperation_TCPConnect, TCP_CONNECTION_CLOSED), is(antOperation_TCPClose, TCP_SUCCESS)});
}

TEST_F(IpStackTest, ConnectingFailsWhereNothingListens) {
#ifdef __mips__
  GTEST_SKIP() << "QEMU 7.2 returns the host's error number in SO_ERROR: 111 instead of MIPS's 146.";
#endif
  std::uint16_t free_port = 0;
  {
    const TcpListener gone("127.0.0.1", 0);
    free_port = gone.port();
  }
  const auto endpoint = createEndpoint();
  post(TCPEndpointConnectMsg(endpoint, IP_ADDR_ANY, IP_PORT_ANY, IPAddress("127.0.0.1"), free_port));
  expectAnswers({is(antOperation_TCPConnect, TCP_PORT_UNREACHABLE)});
  close(endpoint);
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_EQ(answers_.at(1).error, TCP_SUCCESS);
}

TEST_F(IpStackTest, AnEndpointConnectsOrListensOnlyOnce) {
  const auto endpoint = createEndpoint();
  listen(endpoint);
  post(TCPEndpointConnectMsg(endpoint, IP_ADDR_ANY, IP_PORT_ANY, IPAddress("127.0.0.1"), host_port_));
  expectAnswers({is(antOperation_TCPConnect, TCP_OPERATION_INVALID)});
}

TEST(IPAddressTest, ReadsAndWritesDottedNumbers) {
  char text[16];
  EXPECT_STREQ(IPAddress(192, 168, 1, 20).GetAsString(text), "192.168.1.20");
  EXPECT_EQ(IPAddress("255.255.255.255"), IP_ADDR_BROADCAST);
  EXPECT_EQ(IPAddress("10.0.0.1").Address(), 0x0a000001U);
  EXPECT_EQ(IPAddress("somewhere"), IP_ADDR_ANY);
}

TEST_F(IpStackTest, ConnectionsSendAtOnceAndNoticeAVanishedClient) {
  TcpListener listener("127.0.0.1", 0);
  const TestClient client(listener.port());
  std::optional<TcpConnection> connection;
  ASSERT_TRUE(test_.runUntil([&] { return (connection = listener.accept()).has_value(); }));
  const auto option = [&](int level, int name) {
    int value = -1;
    socklen_t size = sizeof(value);
    getsockopt(connection->socket.get(), level, name, &value, &size);
    return value;
  };
  EXPECT_EQ(option(IPPROTO_TCP, TCP_NODELAY), 1);
  EXPECT_EQ(option(SOL_SOCKET, SO_KEEPALIVE), 1);
  EXPECT_EQ(option(IPPROTO_TCP, TCP_KEEPIDLE), 1);
  EXPECT_EQ(option(IPPROTO_TCP, TCP_KEEPINTVL), 1);
  EXPECT_EQ(option(IPPROTO_TCP, TCP_KEEPCNT), 2);
  EXPECT_EQ(option(IPPROTO_TCP, TCP_USER_TIMEOUT), 2000);
}

TEST_F(IpStackTest, DataOutsideASharedBufferIsRefused) {
  const auto endpoint = connect();
  byte own[16];
  test_.on_send = [](const void*, std::size_t) { ADD_FAILURE() << "it is not sent"; };
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

TEST_F(IpStackTest, APortOfAnotherProgramIsInUse) {
  TcpListener other_program("127.0.0.1", 0);
  const auto endpoint = createEndpoint();
  post(TCPEndpointListenMsg(endpoint, IP_ADDR_ANY, other_program.port()));
  ASSERT_TRUE(haveAnswers(1));
  EXPECT_EQ(answers_.at(0).error, TCP_ADDRESSINUSE);
  listen(endpoint);  // on another one
  const TestClient client(host_port_);
  ASSERT_TRUE(haveAnswers(2));
  EXPECT_EQ(answers_.at(1).error, TCP_SUCCESS);
}

TEST_F(IpStackTest, RequestsThatNeedAClientCanBeSentButNotCalled) {
  TCPEndpointListenMsg message(createEndpoint(), IP_ADDR_ANY, kRobotPort);
  EXPECT_EQ(call(message), ANT_FAIL);
  EXPECT_EQ(message.error, TCP_FAIL);
}

TEST_F(IpStackTest, AMessageToAnUnknownStackObjectOrEntryFails) {
  TCPEndpointCloseMsg message(createEndpoint());
  test_.as(object_, [&] {
    EXPECT_EQ(message.Call(antStackRef("OtherStack"), sizeof(message)), ANT_FAIL);
    EXPECT_EQ(message.Call(stack_, sizeof(antEnvMsg)), ANT_FAIL);
    EXPECT_EQ(message.Send(stack_, OID(), 0, sizeof(message)), ANT_FAIL);
    EXPECT_EQ(message.Send(stack_, OID(reinterpret_cast<void*>(1000)), 0, sizeof(message)), ANT_FAIL);
    EXPECT_EQ(message.Send(stack_, object_.id(), TestObject::kSecond + 1, sizeof(message)), ANT_FAIL);
    EXPECT_EQ(message.Call(stack_, sizeof(message)), ANT_SUCCESS);
  });
  EXPECT_EQ(message.error, TCP_SUCCESS);
}

TEST_F(IpStackTest, ASharedBufferHasWholePagesAndCanBeFreedWhenUnused) {
  antEnvCreateSharedBufferMsg create(1);
  call(create);
  std::memset(create.buffer.GetAddress(), 1, 4096);

  const auto endpoint = connect();
  post(TCPEndpointReceiveMsg(endpoint, static_cast<byte*>(create.buffer.GetAddress()), 4096, 4096));
  antEnvDestroySharedBufferMsg destroy(create.buffer);
  call(destroy);
  EXPECT_EQ(destroy.error, ANT_FAIL) << "a receive is writing to it";
  send(endpoint, kBufferSize);
  antEnvDestroySharedBufferMsg destroy_sent(shared_buffer_);
  call(destroy_sent);
  EXPECT_EQ(destroy_sent.error, ANT_FAIL) << "a send is reading from it";
  close(endpoint);
  call(destroy);
  EXPECT_EQ(destroy.error, ANT_SUCCESS);
  call(destroy);
  EXPECT_EQ(destroy.error, ANT_FAIL) << "it is already freed";

  antEnvCreateSharedBufferMsg empty(0);
  call(empty);
  EXPECT_EQ(empty.error, ANT_FAIL);
  EXPECT_EQ(empty.buffer.Map(), ANT_FAIL);
}

}  // namespace
}  // namespace openr_host
