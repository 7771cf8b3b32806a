#include "node/xmlrpc_peer.h"

#include <gtest/gtest.h>
#include <ros/this_node.h>
#include <sys/socket.h>
#include <xmlrpcpp/XmlRpcServer.h>
#include <xmlrpcpp/XmlRpcServerMethod.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <future>
#include <thread>

#include "support/sockets.h"

namespace aibo_driver::node {
namespace {

using XmlRpc::XmlRpcValue;

TEST(XmlRpcPeer, ACallToAProgramThatDoesNotAnswerEndsWithTheNode) {
  const auto silent = test_support::bindTo("127.0.0.1", 0);
  test_support::check(::listen(silent.get(), 50) == 0, "listen");
  std::promise<void> end;
  end.set_value();
  const XmlRpcPeer peer("127.0.0.1", static_cast<std::uint32_t>(test_support::portOf(silent)),
                        end.get_future().share());
  // It waits for an answer for 2 s. A busy computer may be as slow, but not always.
  bool was_faster = false;
  for (int call = 0; call < 20 && !was_faster; ++call) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_THROW(peer.call("getPid", {}), NoAnswer);
    was_faster = std::chrono::steady_clock::now() - begin < std::chrono::seconds(2);
  }
  EXPECT_TRUE(was_faster);
}

TEST(XmlRpcPeer, AFaultIsNoAnswerAndARefusalIsNoResult) {
  struct Method : XmlRpc::XmlRpcServerMethod {
    Method(const char* name, int status, XmlRpc::XmlRpcServer* server)
        : XmlRpcServerMethod(name, server), status_(status) {}

    void execute(XmlRpcValue& arguments, XmlRpcValue& answer) override {
      answer[0] = status_;
      answer[1] = "";
      answer[2] = arguments;
    }

    const int status_;
  };
  XmlRpc::XmlRpcServer server;
  ASSERT_TRUE(server.bindAndListen(0));
  const Method accepts("accept", 1, &server);
  const Method refuses("refuse", 0, &server);
  const Method fails("fail", -1, &server);
  std::atomic<bool> is_over{false};
  std::thread program([&] {
    while (!is_over) {
      server.work(0.01);
    }
  });
  const XmlRpcPeer peer("127.0.0.1", static_cast<std::uint32_t>(server.get_port()));
  XmlRpcValue arguments;
  arguments[0] = ros::this_node::getName();
  arguments[1] = "an argument";
  arguments[2] = 7;
  EXPECT_EQ(peer.call("accept", {"an argument", 7}), arguments) << "the first says who calls";
  EXPECT_FALSE(peer.call("refuse", {1}));
  EXPECT_FALSE(peer.call("fail", {1}));
  EXPECT_THROW(peer.call("getPid", {}), NoAnswer) << "this program has no such method";
  is_over = true;
  program.join();
}

}  // namespace
}  // namespace aibo_driver::node
