/// @file aibo_hostile_robot.cpp
/// A robot that attacks the drivers of this computer that connect to it.

#include <signal.h>

#include <boost/program_options.hpp>
#include <iostream>
#include <random>
#include <thread>

#include "hostile/attacks.h"
#include "support/program.h"

namespace {

namespace po = boost::program_options;

struct Options {
  std::string attack;
  int version = 2;
  int port = 54321;
  int seconds = 10;
  unsigned seed = 1;
  bool list = false;
};

po::options_description describe(Options* options) {
  po::options_description description("Options", 110);
  // clang-format off
  description.add_options()
    ("attack", po::value(&options->attack)->default_value("values"), "what it does; --list prints all attacks")
    ("protocol-version", po::value(&options->version)->default_value(2), "1 or 2")
    ("port", po::value(&options->port)->default_value(54321), "of 127.0.0.1, for drivers; 0 means any free one")
    ("seconds", po::value(&options->seconds)->default_value(10), "1 to 600; before and after, it behaves well")
    ("seed", po::value(&options->seed)->default_value(1), "seed of all random choices")
    ("list", po::bool_switch(&options->list), "print all attacks");
  // clang-format on
  return description;
}

int run(const Options& options) {
  if (options.list) {
    for (const hostile::RobotAttack& attack : hostile::robotAttacks()) {
      std::cout << "version " << attack.version << "  " << attack.name << ": " << attack.title << "\n";
    }
    return EXIT_SUCCESS;
  }
  hostile::checkLimits("127.0.0.1", options.seconds);
  const hostile::RobotAttack& attack = hostile::findRobotAttack(options.attack, options.version);
  test_support::PictureServer server(options.version, std::chrono::milliseconds(33), options.port);
  server.setTelemetry(true);
  std::cout << "A hostile robot on 127.0.0.1:" << server.port() << ". In 3 s: " << attack.title << std::endl;
  std::this_thread::sleep_for(std::chrono::seconds(3));
  server.misbehave(attack.begin(options.seed));
  std::this_thread::sleep_for(std::chrono::seconds(options.seconds));
  server.misbehave({});
  std::cout << "The attack is over. 3 s of good behaviour follow." << std::endl;
  std::this_thread::sleep_for(std::chrono::seconds(3));
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  ::signal(SIGPIPE, SIG_IGN);
  Options options;
  return test_support::runProgram(argc, argv,
                                  "A robot that attacks drivers. Only programs of this computer can connect to it.\n"
                                  "For instance with a driver that was started with _host:=127.0.0.1.",
                                  describe(&options), [&] { return run(options); });
}
