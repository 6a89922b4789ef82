// The rungs that every engine is put on.
#pragma once

#include <string>
#include <vector>

namespace rotorub::bench {

// What the settings are taken from: steps of the fixed steps, tolerances of the others.
struct Ladder {
  std::vector<double> steps;       // s, > 0
  std::vector<double> tolerances;  // relative, > 0
};

// 1-2-5 from 200 us to 1 us; decades from 1e-4 to 1e-12.
Ladder default_ladder();

// "100us,20us, 1e-6": times separated by commas. Throws std::invalid_argument that says which entry
// is wrong and what is accepted.
std::vector<double> parse_steps(const std::string& list);
// "1e-6,1e-9": numbers in (0, 1).
std::vector<double> parse_tolerances(const std::string& list);

}  // namespace rotorub::bench
