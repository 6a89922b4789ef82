// Judges how a program reacts to bad input.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bad_input/bounded_run.h"

namespace rotorub::test {

// A command, and what its contract lets it end with.
struct Command {
  std::vector<std::string> words;  // without the program's own name
  std::vector<int> codes;
  std::string input;  // the file that a refusal names, or "--set"
};

// All that is wrong with how the command ended and with the files below `folder` (but for those of
// its input, kept/); empty: nothing. An exit code of its contract; a failure that says why, a
// refusal with file and line or key; nothing that a terminal obeys, no message without end; no
// number in a result that is none; no file half written.
std::vector<std::string> faults(const Command& command, const Ended& ended,
                                const std::filesystem::path& folder);

}  // namespace rotorub::test
