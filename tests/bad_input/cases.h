// Makes one mutated input, and the command that gets it, from a number.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/bad_input/judge.h"

namespace rotorub::test {

struct Case {
  Command command;
  std::string what;  // source and mutations, in words
};

// Writes the files of case `number` to `folder`; they are the same on every machine.
Case make_case(std::uint64_t number, const std::filesystem::path& folder);

}  // namespace rotorub::test
