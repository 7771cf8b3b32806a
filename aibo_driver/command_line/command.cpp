#include "command_line/command.h"

#include <algorithm>

#include "command_line/commands/commands.h"
#include "command_line/help.h"

namespace aibo_driver::command_line {

const std::vector<Command>& allCommands() {
  static const std::vector<Command> commands = {
      doctorCommand(),  pictureCommand(),   watchCommand(),  snapCommand(),   picturesCommand(), fetchCommand(),
      jointsCommand(),  moveCommand(),      walkCommand(),   standCommand(),  sitCommand(),      restCommand(),
      motionsCommand(), playCommand(),      uploadCommand(), deleteCommand(), sensorsCommand(),  batteryCommand(),
      listenCommand(),  playSoundCommand(), sayCommand(),    motorsCommand(), stopCommand(),     helpCommand(),
      manualCommand(),  completionCommand()};
  return commands;
}

const Command* findCommand(const std::string& name) {
  const std::vector<Command>& commands = allCommands();
  const auto found =
      std::find_if(commands.begin(), commands.end(), [&name](const Command& each) { return each.name == name; });
  return found == commands.end() ? nullptr : &*found;
}

}  // namespace aibo_driver::command_line
