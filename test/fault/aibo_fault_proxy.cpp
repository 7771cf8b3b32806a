/// @file aibo_fault_proxy.cpp
/// The fault proxy as a program: it carries out the lines of its standard input.

#include <signal.h>
#include <unistd.h>

#include <boost/program_options.hpp>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "support/program.h"
#include "support/proxy/fault_proxy.h"
#include "support/proxy/script.h"

namespace {

namespace po = boost::program_options;
using test_support::FaultProxy;
using test_support::Script;

struct Options {
  std::string target;
  FaultProxy::Options proxy;
};

po::options_description describe(Options* options) {
  po::options_description description("Options", 110);
  // clang-format off
  description.add_options()
    ("target", po::value(&options->target)->default_value("127.0.0.1:54321"), "IPv4 address and port of the server")
    ("bind", po::value(&options->proxy.address)->default_value("127.0.0.1"),
     "address of this computer that clients connect to; 0.0.0.0 means all")
    ("port", po::value(&options->proxy.port)->default_value(54322), "port for clients; 0 means any free one")
    ("seed", po::value(&options->proxy.seed)->default_value(1), "seed of all random choices");
  // clang-format on
  return description;
}

int run(Options* options) {
  const std::size_t colon = options->target.find(':');
  if (colon == std::string::npos) {
    throw po::error("option '--target' must be an address and a port, such as 192.168.0.57:54321");
  }
  options->proxy.target_host = options->target.substr(0, colon);
  options->proxy.target_port = std::atoi(options->target.c_str() + colon + 1);
  FaultProxy proxy(options->proxy);
  Script script(&proxy);
  std::cout << "From " << options->proxy.address << ":" << proxy.port() << " to " << options->target << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    try {
      script.carryOut(line);
    } catch (const std::exception& error) {
      std::cerr << "aibo_fault_proxy: " << error.what() << " (--help lists all commands)" << std::endl;
    }
  }
  ::pause();  // after the script everything stays as it is until Ctrl-C
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  ::signal(SIGPIPE, SIG_IGN);
  Options options;
  const std::string about =
      std::string(
          "A proxy between a driver and an RCServer that makes faults. It reads commands from its standard "
          "input:\n\n") +
      test_support::kScriptHelp +
      "\nFor instance: (sleep 5; echo 'fault reset@picture+1000') | aibo_fault_proxy\n"
      "with a driver that was started with _port:=54322.";
  return test_support::runProgram(argc, argv, about, describe(&options), [&] { return run(&options); });
}
