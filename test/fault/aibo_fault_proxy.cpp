/// @file aibo_fault_proxy.cpp
/// The fault proxy, for people: it does what it reads on its standard input.

#include <signal.h>
#include <unistd.h>

#include <boost/program_options.hpp>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "support/proxy/fault_proxy.h"
#include "support/proxy/script.h"

namespace {

namespace po = boost::program_options;
using test_support::FaultProxy;
using test_support::Script;
using test_support::ScriptError;

struct Options {
  std::string target;
  FaultProxy::Options proxy;
  bool help = false;
};

po::options_description describe(Options* options) {
  po::options_description description("Options", 110);
  // clang-format off
  description.add_options()
    ("help", "say this and exit")
    ("target", po::value(&options->target)->default_value("127.0.0.1:54321"), "the server, an IPv4 address and port")
    ("bind", po::value(&options->proxy.address)->default_value("127.0.0.1"),
     "address of this computer that clients connect to; 0.0.0.0 is all of them")
    ("port", po::value(&options->proxy.port)->default_value(54322), "for clients; 0 is any free one")
    ("seed", po::value(&options->proxy.seed)->default_value(1), "of all that is random");
  // clang-format on
  return description;
}

void parse(const po::options_description& description, int argc, char** argv, Options* options) {
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(description).positional({}).run(), values);
  po::notify(values);
  options->help = values.count("help") > 0;
  const std::size_t colon = options->target.find(':');
  if (colon == std::string::npos) {
    throw po::error("option '--target' must be an address and a port, such as 192.168.0.57:54321");
  }
  options->proxy.target_host = options->target.substr(0, colon);
  options->proxy.target_port = std::atoi(options->target.c_str() + colon + 1);
}

void run(const Options& options) {
  FaultProxy proxy(options.proxy);
  Script script(&proxy);
  std::cout << "From " << options.proxy.address << ":" << proxy.port() << " to " << options.target << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    try {
      script.carryOut(line);
    } catch (const std::exception& error) {
      std::cerr << "aibo_fault_proxy: " << error.what() << " (--help tells what there is)" << std::endl;
    }
  }
  ::pause();  // at the end of the script things stay as they are, until Ctrl-C
}

}  // namespace

int main(int argc, char** argv) {
  ::signal(SIGPIPE, SIG_IGN);
  try {
    Options options;
    const po::options_description description = describe(&options);
    parse(description, argc, argv, &options);
    if (options.help) {
      std::cout << "Stands between a driver and an RCServer, and makes go wrong what it is told to.\n\n"
                << description << "\nWhat it does, line by line on its standard input:\n"
                << test_support::kScriptHelp
                << "\nFor instance: (sleep 5; echo 'fault reset@picture+1000') | aibo_fault_proxy\n"
                   "with a driver that was started with _port:=54322.\n";
      return EXIT_SUCCESS;
    }
    run(options);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << "aibo_fault_proxy: " << error.what() << " (--help tells all options)\n";
    return EXIT_FAILURE;
  }
}
