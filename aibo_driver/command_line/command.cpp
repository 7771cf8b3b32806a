#include "command_line/command.h"

#include <algorithm>

#include "aibo_client/exceptions.h"
#include "command_line/commands/commands.h"
#include "command_line/help.h"
#include "command_line/quantities.h"

namespace aibo_driver::command_line {

std::string Arguments::get(const std::string& option) const {
  const auto found = values.find(option);
  return found == values.end() ? "" : found->second;
}

double Arguments::number(const std::string& option, double lowest, double highest) const {
  return parseNumber("--" + option, get(option), lowest, highest);
}

int Arguments::wholeNumber(const std::string& option, int lowest, int highest) const {
  return parseWholeNumber("--" + option, get(option), lowest, highest);
}

const std::vector<Command>& allCommands() {
  static const std::vector<Command> commands = [] {
    std::vector<Command> all;
    for (const auto& commands_of : {doctorCommands, cameraCommands, jointCommands, legCommands, motionCommands,
                                    bodyCommands, soundCommands, powerCommands, helpCommands}) {
      const std::vector<Command> more = commands_of();
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }();
  return commands;
}

const Command& commandNamed(const std::string& name) {
  const std::vector<Command>& commands = allCommands();
  const auto found =
      std::find_if(commands.begin(), commands.end(), [&name](const Command& each) { return each.name == name; });
  if (found == commands.end()) {
    throw aibo_client::InvalidArgumentException("there is no command '" + name + "': `aibo help` lists them");
  }
  return *found;
}

}  // namespace aibo_driver::command_line
