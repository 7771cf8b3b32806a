// The manual page and the completion. They are made from the table of commands.

#include <string>

#include "command_line/help.h"

namespace aibo_driver::command_line {
namespace {

/// Escapes a text for roff, so that none of its characters is a request.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char character : text) {
    escaped += character == '\\' ? "\\e" : character == '-' ? "\\-" : std::string(1, character);
  }
  return (escaped.rfind('.', 0) == 0 || escaped.rfind('\'', 0) == 0 ? "\\&" : "") + escaped;
}

std::string roffOf(const std::vector<Option>& options) {
  std::string text;
  const auto description = describe("", options);
  for (const auto& option : description.options()) {
    const std::string argument = option->format_parameter();
    text += ".TP\n.B " + roff(option->format_name()) + (argument.empty() ? "" : " \\fR" + roff(argument)) + "\n" +
            roff(option->description()) + "\n";
  }
  return text;
}

std::string roffOf(const Command& command) {
  std::string text = ".SS " + roff(command.name + (command.synopsis.empty() ? "" : " " + command.synopsis)) + "\n" +
                     roff(command.name + ": " + command.summary + ". " + command.details) + "\n" +
                     roffOf(command.options);
  for (const Example& example : command.examples) {
    text += ".TP\n.B " + roff("aibo " + example.arguments) + "\n" + roff(example.effect) + "\n";
  }
  return text;
}

std::string manual() {
  std::string text = ".TH AIBO 1 \"\" \"aibo_driver " AIBO_DRIVER_VERSION
                     "\" \"User Commands\"\n"
                     ".SH NAME\naibo \\- talks to the RCServer of a Sony Aibo, without ROS\n"
                     ".SH SYNOPSIS\n.B aibo\n[\\-\\-host NAME] [\\-\\-port N] [\\-\\-json] COMMAND ...\n"
                     ".SH OPTIONS\n" +
                     roffOf(commonOptions()) + ".SH COMMANDS\n";
  for (const Command& command : allCommands()) {
    text += roffOf(command);
  }
  return text +
         ".SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 1\nthe robot refused, or did not do what it was told; a file could "
         "not be read or written\n.TP\n.B 2\nwrong arguments\n.TP\n.B 3\nno connection to the robot, or it was "
         "lost\n.TP\n.B 130\nCtrl\\-C; for watch this is the usual end, and the status is 0\n.SH ENVIRONMENT\n.TP\n.B "
         "AIBO_HOST\nname or address of the robot, unless \\-\\-host is given";
}

std::string longName(const Option& option) {
  return option.name.substr(0, option.name.find(','));
}

/// The options and words that bash offers behind a command.
std::string completionOf(const Command& command) {
  std::string words;
  std::string files;
  for (const std::string& word : command.completions) {
    if (word == "FILE") {
      files = " -f";
    } else {
      words += " " + word;
    }
  }
  for (const Option& option : command.options) {
    words += " --" + longName(option);
    files = option.argument == "FILE" || option.argument == "FOLDER" ? " -f" : files;
  }
  return "    " + command.name + ") COMPREPLY=($(compgen" + files + " -W \"" + words + " $common\" -- \"$word\")) ;;\n";
}

std::string completion() {
  std::string names;
  std::string cases;
  std::string common;
  for (const Command& command : allCommands()) {
    names += (names.empty() ? "" : " ") + command.name;
    cases += completionOf(command);
  }
  for (const Option& option : commonOptions()) {
    common += (common.empty() ? "--" : " --") + longName(option);
  }
  return "# bash completion of aibo: source <(aibo completion)\n"
         "_aibo() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} command='' each common='" +
         common +
         "'\n"
         "  local names='" +
         names +
         "'\n"
         "  COMPREPLY=()\n"
         "  for each in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    case \" $names \" in *\" $each \"*) command=$each; break ;; esac\n"
         "  done\n"
         "  case $command in\n"
         "    '') COMPREPLY=($(compgen -W \"$names $common\" -- \"$word\")) ;;\n"
         "    help) COMPREPLY=($(compgen -W \"$names\" -- \"$word\")) ;;\n" +
         cases +
         "  esac\n  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]]; then compopt -o nospace; fi\n}\ncomplete "
         "-F _aibo aibo";
}

ExitStatus showManual(const Arguments&, Output& output) {
  output.result(manual(), Json::object({{"manual", manual()}}));
  return kDone;
}

ExitStatus showCompletion(const Arguments&, Output& output) {
  output.result(completion(), Json::object({{"completion", completion()}}));
  return kDone;
}

}  // namespace

std::vector<Command> manualCommands() {
  return {{"manual",
           "",
           "prints the manual page",
           "The page is in roff, for man. Where the program is installed, `man aibo` shows it.",
           {{"manual | man -l -", "shows it from anywhere"}},
           showManual},
          {"completion",
           "",
           "prints the completion for bash",
           "Put `source <(aibo completion)` into ~/.bashrc.",
           {{"completion > ~/.local/share/bash-completion/completions/aibo", "installs it"}},
           showCompletion}};
}

}  // namespace aibo_driver::command_line
