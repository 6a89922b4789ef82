// Damages a text file of keys and values (TOML) or of rows (CSV) as users, editors and disks do.
#pragma once

#include <span>
#include <string>

#include "tests/bad_input/random.h"

namespace rotorub::test {

// Applies one to three mutations. `donors`: other texts of the kind, whose tables and words may be
// mixed in. `what`: receives a description for whoever examines a failure.
std::string mutated(std::string text, std::span<const std::string> donors, Random& random,
                    std::string& what);

// A value that may stand after `=`, also on a command line.
std::string odd_value(Random& random);

}  // namespace rotorub::test
