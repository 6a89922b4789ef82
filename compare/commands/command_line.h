// The words of the command line before the parser sees them.
#pragma once

#include <string>
#include <vector>

namespace rotorub {

// `help` and `help COMMAND` as the options that the parser knows. arguments: without the program's
// name.
std::vector<std::string> with_help(std::vector<std::string> arguments);

// What is wrong with the first word where a command should stand, with the nearest command where
// one is near; or that there is none; empty: it is a command, or an option.
std::string unknown_command(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& commands);

}  // namespace rotorub
