#include "node/xmlrpc_peer.h"

#include <gtest/gtest.h>
#include <ros/this_node.h>
#include <sys/socket.h>
#include <xmlrpcpp/XmlRpcServer.h>
#include <xmlrpcpp/XmlRpcServerMethod.h>

#include <future>
#include <list>
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

XmlRpcValue listOf(const std::vector<XmlRpcValue>& values) {
  XmlRpcValue list;
  list.setSize(0);
  for (const XmlRpcValue& value : values) {
    list[list.size()] = value;
  }
  return list;
}

TEST(XmlRpcPeer, AnAnswerIsThatOfROSOrItIsNone) {
  using Answer = XmlRpcValue (*)(const XmlRpcValue& arguments);
  struct Method : XmlRpc::XmlRpcServerMethod {
    Method(const char* name, Answer answer, XmlRpc::XmlRpcServer* server)
        : XmlRpcServerMethod(name, server), answer_(answer) {}

    void execute(XmlRpcValue& arguments, XmlRpcValue& answer) override { answer = answer_(arguments); }

    const Answer answer_;
  };
  const XmlRpcValue arguments = listOf({ros::this_node::getName(), "an argument", 7});  // the first says who calls
  enum class Result { kArguments, kRefused, kNone };
  const std::tuple<const char*, Answer, Result> rows[] = {
      {"accepted",
       [](const XmlRpcValue& given) {
         return listOf({1, "", given});
       },
       Result::kArguments},
      {"refused",
       [](const XmlRpcValue& given) {
         return listOf({0, "", given});
       },
       Result::kRefused},
      {"stray", [](const XmlRpcValue&) { return XmlRpcValue("hello"); }, Result::kNone},
      {"stray list", [](const XmlRpcValue&) { return listOf({1}); }, Result::kNone},
  };
  XmlRpc::XmlRpcServer server;
  ASSERT_TRUE(server.bindAndListen(0));
  std::list<Method> methods;
  for (const auto& [name, answer, result] : rows) {
    methods.emplace_back(name, answer, &server);
  }
  std::atomic<bool> is_over{false};
  std::thread program([&] {
    while (!is_over) {
      server.work(0.01);
    }
  });
  const XmlRpcPeer peer("127.0.0.1", static_cast<std::uint32_t>(server.get_port()));
  for (const auto& [name, answer, result] : rows) {
    try {
      const auto value = peer.call(name, {"an argument", 7});
      EXPECT_EQ(value ? Result::kArguments : Result::kRefused, result) << name;
      EXPECT_TRUE(!value || *value == arguments) << name;
    } catch (const NoAnswer& none) {
      EXPECT_EQ(Result::kNone, result) << name;
      EXPECT_FALSE(none.is_silent) << name;
    }
  }
  EXPECT_THROW(peer.call("getPid", {}), NoAnswer) << "this program has no such method";
  is_over = true;
  program.join();
}

}  // namespace
}  // namespace aibo_driver::node
