// Judges how a program reacts to bad input.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bad_input/bounded_run.h"

namespace rotorub::test {

// A command, and the exit codes that its contract allows.
struct Command {
  std::vector<std::string> words;  // without the program's own name
  std::vector<int> codes;
  std::string input;  // the file that a refusal names, or "--set"
};

// All faults in how the command ended and in the files below `folder` (except those of its input,
// kept/); empty if there are none. It checks that the contract lists the exit code, a failure
// has a reason, a refusal names file and line or key, no message contains terminal codes or is too
// long, results contain only finite numbers, and no file is half written.
std::vector<std::string> faults(const Command& command, const Ended& ended,
                                const std::filesystem::path& folder);

}  // namespace rotorub::test
