#include "node/xmlrpc_peer.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <chrono>
#include <future>

#include "support/sockets.h"

namespace aibo_driver::node {
namespace {

TEST(XmlRpcPeer, ACallToAProgramThatDoesNotAnswerEndsWithTheNode) {
  const auto silent = test_support::bindTo("127.0.0.1", 0);
  test_support::check(::listen(silent.get(), 1) == 0, "listen");
  std::promise<void> end;
  end.set_value();
  const auto begin = std::chrono::steady_clock::now();
  const XmlRpcPeer peer("127.0.0.1", static_cast<std::uint32_t>(test_support::portOf(silent)),
                        end.get_future().share());
  EXPECT_THROW(peer.call("getPid", {}), NoAnswer);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2)) << "for so long it waits for an answer";
}

}  // namespace
}  // namespace aibo_driver::node
