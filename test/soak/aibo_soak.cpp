/// @file aibo_soak.cpp
/// The driver's node and the robot's server for a long time, through all that goes wrong between them.

#include <ros/ros.h>
#include <signal.h>

#include <boost/program_options.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <random>

#include "soak.h"

namespace {

namespace po = boost::program_options;

struct ProgramOptions {
  bool help = false;
  soak::Options soak;
};

po::options_description describe(ProgramOptions* options) {
  po::options_description description("Options", 110);
  // clang-format off
  description.add_options()
    ("help", "say this and exit")
    ("minutes", po::value(&options->soak.minutes)->default_value(60), "how long")
    ("seed", po::value(&options->soak.seed), "of all that is random; another one each time unless it is given")
    ("folder", po::value(&options->soak.folder)->default_value("."),
     "where resources.csv and driver.log are put; has to be there");
  // clang-format on
  return description;
}

void parse(const po::options_description& description, int argc, char** argv, ProgramOptions* options) {
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(description).positional({}).run(), values);
  po::notify(values);
  options->help = values.count("help") > 0;
  if (values.count("seed") == 0) {
    options->soak.seed = std::random_device()();
  }
  if (!(options->soak.minutes > 0)) {
    throw po::error("option '--minutes' must be above 0");
  }
}

}  // namespace

int main(int argc, char** argv) {
  ::signal(SIGPIPE, SIG_IGN);
  // Ctrl-C ends it at once, and with it what it has started.
  ros::init(argc, argv, "aibo_soak", ros::init_options::AnonymousName | ros::init_options::NoSigintHandler);
  try {
    ProgramOptions options;
    const po::options_description description = describe(&options);
    parse(description, argc, argv, &options);
    if (options.help) {
      std::cout << "Runs driver and simulated robot for a long time, with everything that goes wrong between them.\n"
                   "Needs a ROS master of its own: scripts/soak starts one.\n\n"
                << description;
      return EXIT_SUCCESS;
    }
    std::printf("%g minutes with seed %u\n", options.soak.minutes, options.soak.seed);
    std::fflush(stdout);
    const ros::NodeHandle handle;
    ros::AsyncSpinner spinner(2);
    spinner.start();
    return soak::Soak(options.soak).run() ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::cerr << "aibo_soak: " << error.what() << " (--help tells all options)\n";
    return 2;
  }
}
