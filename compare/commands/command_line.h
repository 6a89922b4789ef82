// The command line: the program's parser, which commands are added to, and what becomes of the
// arguments.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/commands/command.h"

namespace rotorub {

// `help` and `help COMMAND` as the options that the parser knows. arguments: without the program's
// name.
std::vector<std::string> with_help(std::vector<std::string> arguments);

// What is wrong with the first word, where a command should stand, with the nearest command if one
// is near. Empty: the word is a command or an option.
std::string unknown_command(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& commands);

class CommandLine {
 public:
  CommandLine();
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  // The program, for the functions add_..._command.
  CLI::App& program() { return *program_; }

  // What the arguments ask for.
  struct Request {
    const Command* command = nullptr;  // null: nothing further, end with `code`
    int code = kBadInput;
  };
  // arguments: without the program's name. Prints the help or the version where they are asked for,
  // and the parser's own error messages. Throws UsageError for all other mistakes. Called once,
  // after all commands have been added.
  Request parse(const std::vector<Command>& commands, std::vector<std::string> arguments);

 private:
  std::unique_ptr<CLI::App> program_;
};

}  // namespace rotorub
