#include <cstdlib>
#include <memory>

#include "tools/program.h"
#include "web/web_node.h"

namespace {

constexpr char kHelp[] = R"(  rosrun aibo_driver aibo_web [__ns:=aibo] [_PARAMETER:=VALUE...]

Serves a page for browsers, which shows and steers the robot, and prints its address.

  ~web_address  the address of this computer at which it is served (127.0.0.1: for this computer only)
  ~web_port     its port (8080); 0: any free port
  ~speed, ~side_speed  at the edges of the pad, in m/s (0.1 and 0.05)
  ~turn_speed          the same for turns, in rad/s (0.5)
)";

}  // namespace

int main(int argc, char** argv) {
  aibo_driver::tools::init(argc, argv, "aibo_web", kHelp);
  return aibo_driver::node::runNode("page", [] {
    return std::make_shared<aibo_driver::web::WebNode>(aibo_driver::node::inDriverNamespace(ros::NodeHandle(), "aibo"),
                                                       ros::NodeHandle("~"));
  });
}
