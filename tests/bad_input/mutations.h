// Damages a text file of keys and values (TOML) or of rows (CSV) as users, editors and disks do.
#pragma once

#include <span>
#include <string>

#include "tests/bad_input/random.h"

namespace rotorub::test {

// One to three mutations. `donors`: other texts of the kind, whose tables and words may be mixed
// in. `what`: in words, for whoever looks at a fault.
std::string mutated(std::string text, std::span<const std::string> donors, Random& random,
                    std::string& what);

// A value as it may stand after `=`, on a command line too.
std::string odd_value(Random& random);

}  // namespace rotorub::test
