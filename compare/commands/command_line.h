// The words of the command line before the parser sees them, and its help.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rotorub {

// `help` and `help COMMAND` as the options that the parser knows. arguments: without the program's
// name.
std::vector<std::string> with_help(std::vector<std::string> arguments);

// What is wrong with the first word where a command should stand, with the nearest command where
// one is near; or that there is none; empty: it is a command, or an option.
std::string unknown_command(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& commands);

// The parser's help, of the program and of the commands that it is given later, no wider than a
// terminal of 80 columns.
void set_help_format(CLI::App& program);

}  // namespace rotorub
