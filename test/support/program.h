/// @file program.h
#ifndef TEST_SUPPORT_PROGRAM_H
#define TEST_SUPPORT_PROGRAM_H

#include <boost/program_options.hpp>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>

namespace test_support {

/// The body of a main(): parses options, answers --help, runs the program and prints errors.
/// @param about what --help prints in front of the options
/// @param options all but "help"; they are set when `run` is called
/// @return the exit status: that of `run`; 2 for wrong options, or if `run` throws
inline int runProgram(int argc, char** argv, const std::string& about,
                      boost::program_options::options_description options, const std::function<int()>& run) {
  namespace po = boost::program_options;
  const std::string name = std::filesystem::path(argv[0]).filename().string() + ": ";
  options.add_options()("help", "print this text");
  try {
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options).positional({}).run(), values);
    if (values.count("help") > 0) {
      std::cout << about << "\n\n" << options;
      return EXIT_SUCCESS;
    }
    po::notify(values);
    return run();
  } catch (const po::error& error) {
    std::cerr << name << error.what() << " (--help lists all options)\n";
  } catch (const std::exception& error) {
    std::cerr << name << error.what() << "\n";
  }
  return 2;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_PROGRAM_H
