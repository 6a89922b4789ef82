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

// The program, for the functions add_..._command().
std::shared_ptr<CLI::App> new_program();

// The action of the command that is named; for help or version, which it prints, an action that
// returns the exit code. arguments: without the program's name. Throws UsageError for all mistakes;
// a command that is named leads their messages (set_command_name). Call it once, after all commands
// were added.
Action parse(CLI::App& program, const std::vector<Command>& commands,
             std::vector<std::string> arguments);

}  // namespace rotorub
