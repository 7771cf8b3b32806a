/// @file aibo_hostile_client.cpp
/// Clients that attack an aibo_rcserver of this computer.

#include <signal.h>

#include <boost/program_options.hpp>
#include <iostream>

#include "hostile/attacks.h"
#include "support/program.h"

namespace {

namespace po = boost::program_options;

struct Options {
  std::string attack;
  std::string address;
  hostile::Target target;
  int seconds = 10;
  unsigned seed = 1;
  bool list = false;
};

po::options_description describe(Options* options) {
  po::options_description description("Options", 110);
  // clang-format off
  description.add_options()
    ("attack", po::value(&options->attack)->default_value("payloads"), "what they do; --list prints all attacks")
    ("address", po::value(&options->address)->default_value("127.0.0.1"), "of aibo_rcserver; only 127.0.0.1 is attacked")
    ("port", po::value(&options->target.port)->default_value(54321), "of aibo_rcserver")
    ("console-port", po::value(&options->target.console_port)->default_value(59000), "of its console")
    ("seconds", po::value(&options->seconds)->default_value(10), "1 to 600")
    ("seed", po::value(&options->seed)->default_value(1), "seed of all random choices")
    ("list", po::bool_switch(&options->list), "print all attacks");
  // clang-format on
  return description;
}

int run(const Options& options) {
  if (options.list) {
    for (const hostile::ClientAttack& attack : hostile::clientAttacks()) {
      std::cout << attack.name << ": " << attack.title << "\n";
    }
    return EXIT_SUCCESS;
  }
  hostile::checkLimits(options.address, options.seconds);
  const hostile::ClientAttack& attack = hostile::findClientAttack(options.attack);
  hostile::Random random(options.seed);
  std::cout << "For " << options.seconds << " s: " << attack.title << std::endl;
  attack.run(options.target, random, std::chrono::steady_clock::now() + std::chrono::seconds(options.seconds));
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  ::signal(SIGPIPE, SIG_IGN);
  Options options;
  return test_support::runProgram(argc, argv, "Clients that attack an aibo_rcserver of this computer.",
                                  describe(&options), [&] { return run(options); });
}
