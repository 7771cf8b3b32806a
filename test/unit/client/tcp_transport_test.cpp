#include "client/tcp_transport.h"

#include <gmock/gmock.h>

#include <future>
#include <random>

#include "aibo_client/exceptions.h"
#include "client/fault.h"
#include "support/safety_net.h"
#include "support/scripted_server.h"
#include "support/udp_socket.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_support::ScriptedPeer;
using test_support::ScriptedServer;

namespace {

TimePoint in(milliseconds time) {
  return std::chrono::steady_clock::now() + time;
}

TimePoint soon() {
  return in(test_support::kSafetyNet);
}

template <typename Call>
FaultKind faultOf(const Call& call) {
  try {
    call();
  } catch (const Fault& fault) {
    EXPECT_THAT(fault.what(), testing::MatchesRegex("([0-9.]+:[0-9]+ |the name ').*"));
    EXPECT_NE("", fault.advice());
    return fault.kind();
  }
  ADD_FAILURE() << "no fault";
  return FaultKind::kInternal;
}

TEST(TcpTransportTest, EachKindOfFailureIsRecognised) {
  ScriptedServer absent;
  absent.vanish();
  TcpTransport transport;
  EXPECT_EQ(FaultKind::kRefused, faultOf([&] { transport.connect("127.0.0.1", absent.port(), soon()); }));
  EXPECT_EQ(FaultKind::kNameNotFound, faultOf([&] { transport.connect("no.such.robot.invalid", 54321, soon()); }));
  EXPECT_EQ(FaultKind::kUnreachable, faultOf([&] { transport.connect("255.255.255.255", 54321, soon()); }));
  absent.listen(0);
  TcpTransport first;
  first.connect("127.0.0.1", absent.port(), soon());  // fills the backlog: the next one is not answered
  EXPECT_EQ(FaultKind::kNoAnswer,
            faultOf([&] { transport.connect("127.0.0.1", absent.port(), in(milliseconds(200))); }));
}

TEST(TcpTransportTest, AnAddressThatFailsOrDoesNotAnswerLeavesTimeToOthers) {
  ScriptedServer absent;
  absent.vanish();
  ScriptedServer full;
  full.listen(0);
  TcpTransport other;
  other.connect("127.0.0.1", full.port(), soon());
  ScriptedServer server;
  const auto connect = [](int first, int second, milliseconds time) {
    TcpTransport transport([=](const std::string& host, int) {
      NameLookupResult result = resolveWithSystem(host, first);
      result.addresses.push_back(resolveWithSystem(host, second).addresses.front());
      return result;
    });
    transport.connect("127.0.0.1", 54321, in(time));
  };
  for (const int port : {absent.port(), full.port()}) {
    EXPECT_NO_THROW(connect(port, server.port(), std::chrono::seconds(4)));
    server.accept();
  }
  EXPECT_EQ(FaultKind::kNoAnswer, faultOf([&] { connect(absent.port(), full.port(), milliseconds(600)); }))
      << "an address that has failed counts once";
}

TEST(TcpTransportTest, TheRobotsCloseAndResetAreFaults) {
  ScriptedServer server;
  TcpTransport transport;
  std::uint8_t buffer[16];
  for (const bool resets : {false, true}) {
    transport.connect("127.0.0.1", server.port(), soon());
    ScriptedPeer peer = server.accept();
    resets ? peer.reset() : peer.close();
    ASSERT_TRUE(transport.wait(soon()).connection);
    EXPECT_EQ(FaultKind::kClosed, faultOf([&] { transport.receive(buffer, sizeof buffer); })) << resets;
  }
}

TEST(TcpTransportTest, BytesThatTheNetworkDoesNotTakeAtOnceAreSentWhileWaiting) {
  ScriptedServer server;
  server.limitReceiveBuffer();
  TcpTransport transport;
  transport.connect("127.0.0.1", server.port(), soon());
  ScriptedPeer peer = server.accept();
  constexpr std::size_t kPart = 64 * 1024;  // as large as the largest request
  constexpr std::size_t kFarMoreThanTheKernelKeeps = 128 * kPart;
  test_support::Bytes request(kFarMoreThanTheKernelKeeps);
  std::mt19937 random(1);
  std::generate(request.begin(), request.end(), [&random] { return static_cast<std::uint8_t>(random()); });
  // How much the network takes at once depends on the kernel: send until something stays. That is quick, because a
  // peer that reads nothing for 2 s is given up.
  std::size_t sent = 0;
  for (; !transport.hasUnsent(); sent += kPart) {
    ASSERT_LT(sent, request.size()) << "it takes everything";
    transport.send(&request[sent], kPart);
  }
  request.resize(sent);
  auto received = std::async(std::launch::async, [&] { return peer.read(request.size()); });
  while (received.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    EXPECT_FALSE(transport.wait(in(milliseconds(10))).connection);
  }
  EXPECT_TRUE(request == received.get());
  EXPECT_FALSE(transport.hasUnsent());
}

TEST(TcpTransportTest, APeerThatNeverReadsIsGivenUp) {
  ScriptedServer server;
  TcpTransport transport;
  transport.connect("127.0.0.1", server.port(), soon());
  ScriptedPeer peer = server.accept();
  const test_support::Bytes request(512 * 1024);
  EXPECT_EQ(FaultKind::kUnreachable, faultOf([&] {
              for (int i = 0; i < 200; ++i) {  // far more than the kernel keeps
                transport.send(request.data(), request.size());
              }
            }));
}

TEST(TcpTransportTest, DatagramsAreAnsweredToTheRobotsPortWhoeverElseSendsSome) {
  for (const char* const host : {"127.0.0.1", "::ffff:127.0.0.1"}) {  // the whole IPv6 address counts
    ScriptedServer server;
    TcpTransport transport;
    transport.connect(host, server.port(), soon());
    const ScriptedPeer peer = server.accept();
    ASSERT_TRUE(transport.openDatagrams());
    DatagramSocket& datagrams = transport.datagrams();
    test_support::UdpSocket robot;
    test_support::UdpSocket stranger("127.0.0.2");
    std::uint8_t buffer[16];
    std::size_t size = 0;
    EXPECT_FALSE(datagrams.receive(buffer, sizeof buffer, &size));
    robot.send(datagrams.port(), {1, 2, 3});
    EXPECT_EQ(datagrams.receive(buffer, sizeof buffer, &size), DatagramSocket::Origin::kPeer) << host;
    EXPECT_EQ(size, 3u);
    datagrams.replyToLastSender();
    stranger.send(datagrams.port(), {4});
    EXPECT_EQ(datagrams.receive(buffer, sizeof buffer, &size), DatagramSocket::Origin::kForeign) << host;
    const std::uint8_t reply[] = {'a', 0, 7};
    datagrams.reply(reply, sizeof reply);
    EXPECT_EQ(robot.next(), (std::vector<std::uint8_t>{'a', 0, 7}));
    EXPECT_FALSE(stranger.next());
  }
}

}  // namespace
