// The command line: the program's parser, to which commands are added, and the handling of the
// arguments.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/commands/command.h"

namespace rotorub {

// Replaces `help` and `help COMMAND` by the options that the parser knows. arguments: without the
// program's name.
std::vector<std::string> with_help(std::vector<std::string> arguments);

// The error message if the first word is neither a command nor an option, with the nearest command
// if one is similar. Empty if the word is valid.
std::string unknown_command(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& commands);

class CommandLine {
 public:
  CommandLine();
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  // The program, for the functions add_..._command().
  CLI::App& program() { return *program_; }

  // The result of parsing.
  struct Request {
    const Command* command = nullptr;  // null: nothing to run, exit with `code`
    int code = kBadInput;
  };
  // arguments: without the program's name. Prints help or version if requested. Throws UsageError
  // for all mistakes; a command that is named leads their messages (set_command_name). Call it
  // once, after all commands were added.
  Request parse(const std::vector<Command>& commands, std::vector<std::string> arguments);

 private:
  std::unique_ptr<CLI::App> program_;
};

}  // namespace rotorub
