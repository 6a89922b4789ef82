// The contents of the help, the manual page and the completion, read from the program's parser.
#pragma once

#include "compare/manual/program_text.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rotorub {

OptionText option_text(const CLI::Option& option);

// The program, its commands and all options.
ProgramText program_text(const CLI::App& program);

}  // namespace rotorub
