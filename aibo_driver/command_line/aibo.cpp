// aibo is a command line for an Aibo, without ROS. docs/command_line.md describes it.

#include <csignal>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "command_line/command.h"
#include "command_line/help.h"
#include "command_line/interruption.h"
#include "command_line/parse.h"

namespace aibo_driver::command_line {
namespace {

int run(const std::vector<std::string>& words, Output& output) {
  const CommandLine line = parse(words);
  if (line.version) {
    output.result("aibo " AIBO_DRIVER_VERSION, Json::object({{"version", AIBO_DRIVER_VERSION}}));
    return kDone;
  }
  if (line.help) {
    const std::string help = line.command == nullptr ? generalHelp() : helpOf(*line.command);
    output.result(help, Json::object({{"help", help}}));
    return kDone;
  }
  return line.command->run(line.arguments, output);
}

/// With --json, the error is printed as a JSON document.
int fail(Output& output, const std::string& problem, int status) {
  output.note("aibo: " + problem);
  if (output.json()) {
    output.result("", Json::object({{"error", problem}, {"status", status}}));
  }
  return status;
}

int runAndReport(const std::vector<std::string>& words) {
  Output output(wantsJson(words));
  try {
    return run(words, output);
  } catch (const Interrupted& error) {
    return fail(output, error.what(), 128 + interruption());
  } catch (const aibo_client::InvalidArgumentException& error) {
    return fail(output, error.what(), kWrongUsage);
  } catch (const OutputException& error) {
    output.note(std::string("aibo: ") + error.what());
    return kFailed;
  } catch (const aibo_client::NetworkException& error) {
    return fail(output, error.what(), kUnreachable);
  } catch (const std::exception& error) {
    return fail(output, error.what(), kFailed);
  }
}

}  // namespace
}  // namespace aibo_driver::command_line

int main(int argc, char** argv) {
  // If nobody reads the output any more, the program ends silently, like other programs in a pipe.
  std::signal(SIGPIPE, SIG_DFL);
  aibo_driver::command_line::noteInterruptions();
  return aibo_driver::command_line::runAndReport({argv + 1, argv + argc});
}
