/// @file aibo_soak.cpp
/// Runs the driver's node and the robot's server for a long time, with random orders from five nodes and all kinds of
/// faults.

#include <ros/ros.h>
#include <signal.h>

#include <boost/program_options.hpp>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "order_user.h"
#include "soak.h"
#include "support/program.h"

namespace {

namespace po = boost::program_options;

constexpr int kNoUser = -1;

int run(const soak::Options& options, int user) {
  if (user != kNoUser) {
    soak::runUser(ros::this_node::getNamespace(), static_cast<unsigned>(user), options.seed);
    return EXIT_SUCCESS;
  }
  if (!(options.minutes > 0)) {
    throw po::error("option '--minutes' must be above 0");
  }
  std::printf("%g minutes with seed %u\n", options.minutes, options.seed);
  std::fflush(stdout);
  const ros::NodeHandle handle;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return soak::Soak(options).run() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  ::signal(SIGPIPE, SIG_IGN);
  // Ctrl-C ends this program and all that it has started at once.
  ros::init(argc, argv, "aibo_soak", ros::init_options::NoSigintHandler);
  soak::Options options;
  int user = kNoUser;
  options.program = argv[0];
  po::options_description description("Options", 110);
  // clang-format off
  description.add_options()
    ("minutes", po::value(&options.minutes)->default_value(60), "how long")
    ("seed", po::value(&options.seed)->default_value(std::random_device()(), "random"), "seed of all random choices")
    ("folder", po::value(&options.folder)->default_value("."), "existing folder for logs")
    ("user", po::value(&user)->default_value(kNoUser, "none"),
     "be one of the nodes that give orders, 0 to 4; the program starts them itself");
  // clang-format on
  return test_support::runProgram(
      argc, argv,
      "Runs driver and simulated robot for a long time, with random orders and all kinds of faults.\n"
      "Needs a ROS master of its own, which scripts/soak starts.",
      description, [&] { return run(options, user); });
}
