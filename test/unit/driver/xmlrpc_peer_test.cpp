#include "node/xmlrpc_peer.h"

#include <gtest/gtest.h>
#include <ros/this_node.h>
#include <sys/socket.h>
#include <xmlrpcpp/XmlRpcServer.h>
#include <xmlrpcpp/XmlRpcServerMethod.h>

#include <future>
#include <thread>

#include "support/sockets.h"

namespace aibo_driver::node {
namespace {

using XmlRpc::XmlRpcValue;

// A call without an answer: whether it has waited for one.
bool isSilent(const XmlRpcPeer& peer, const char* method, const std::vector<XmlRpcValue>& arguments) {
  try {
    peer.call(method, arguments);
  } catch (const NoAnswer& none) {
    return none.is_silent;
  }
  return ADD_FAILURE() << method << " is answered", false;
}

TEST(XmlRpcPeer, ACallToAProgramThatDoesNotAnswerEndsWithTheNode) {
  const auto silent = test_support::bindTo("127.0.0.1", 0);
  test_support::check(::listen(silent.get(), 50) == 0, "listen");
  std::promise<void> end;
  end.set_value();
  const XmlRpcPeer peer("127.0.0.1", static_cast<std::uint32_t>(test_support::portOf(silent)),
                        end.get_future().share());
  EXPECT_FALSE(isSilent(peer, "getPid", {})) << "it does not wait";
}

XmlRpcValue listOf(const std::vector<XmlRpcValue>& values) {
  XmlRpcValue list;
  list.setSize(0);
  for (const XmlRpcValue& value : values) {
    list[list.size()] = value;
  }
  return list;
}

// Its method answers with its argument.
struct Echo : XmlRpc::XmlRpcServerMethod {
  explicit Echo(XmlRpc::XmlRpcServer* server) : XmlRpcServerMethod("echo", server) {}

  void execute(XmlRpcValue& arguments, XmlRpcValue& answer) override {
    EXPECT_EQ(arguments[0], XmlRpcValue(ros::this_node::getName()));
    answer = arguments[1];
  }
};

TEST(XmlRpcPeer, AnAnswerIsThatOfROSOrItIsNone) {
  XmlRpc::XmlRpcServer server;
  ASSERT_TRUE(server.bindAndListen(0));
  const Echo echo(&server);
  std::atomic<bool> is_over{false};
  std::thread program([&] {
    while (!is_over) {
      server.work(0.01);
    }
  });
  const XmlRpcPeer peer("127.0.0.1", static_cast<std::uint32_t>(server.get_port()));
  EXPECT_EQ(peer.call("echo", {listOf({1, "accepted", 7})}), XmlRpcValue(7));
  EXPECT_EQ(peer.call("echo", {listOf({0, "refused", 7})}), std::nullopt);
  const std::pair<const char*, XmlRpcValue> strays[] = {
      {"echo", "hello"}, {"echo", listOf({1})}, {"getPid", ""}};  // this program has no such method
  for (const auto& [method, answer] : strays) {
    EXPECT_FALSE(isSilent(peer, method, {answer})) << method;
  }
  is_over = true;
  program.join();
}

}  // namespace
}  // namespace aibo_driver::node
