/// @file program.h
#ifndef AIBO_DRIVER_TOOLS_PROGRAM_H
#define AIBO_DRIVER_TOOLS_PROGRAM_H

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "node/node.h"

namespace aibo_driver::tools {

/// Calls node::init(). With -h or --help it prints the help instead, and ends the process. It refuses all other
/// arguments but ROS' NAME:=VALUE.
/// @param help what the program does, and its parameters
/// @param options ros::InitOption
inline void init(int& argc, char** argv, const std::string& name, const char* help, std::uint32_t options = 0) {
  for (int i = 1; i < argc; ++i) {
    if (const std::string argument = argv[i]; argument == "-h" || argument == "--help") {
      std::printf("%s", help);
      std::exit(EXIT_SUCCESS);
    }
  }
  node::init(argc, argv, name, options);  // removes ROS' arguments
  if (argc > 1) {
    std::fprintf(stderr, "%s: there is no argument '%s'. --help lists the parameters.\n", name.c_str(), argv[1]);
    std::exit(EXIT_FAILURE);
  }
}

/// Runs a program that is one node, which finds the driver's topics in the namespace aibo or its own.
/// @tparam Node is made with a handle in the driver's namespace and one for the parameters
/// @param help see init()
/// @return see node::runNode()
template <typename Node>
int run(int argc, char** argv, const std::string& name, const char* help) {
  init(argc, argv, name, help);
  return node::runNode("node " + name, [] {
    return std::make_shared<Node>(node::inDriverNamespace(ros::NodeHandle(), "aibo"), ros::NodeHandle("~"));
  });
}

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_PROGRAM_H
