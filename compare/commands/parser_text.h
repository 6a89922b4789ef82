// What the manual page and the completion say about the program, read from its parser.
#pragma once

#include "compare/manual/program_text.h"

namespace CLI {
class App;
}

namespace rotorub {

// The program, its commands and all their options.
ProgramText program_text(const CLI::App& program);

}  // namespace rotorub
