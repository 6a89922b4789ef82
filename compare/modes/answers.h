// The answers of `rotorub modes` in sentences.
#pragma once

#include <string>
#include <vector>

#include "compare/modes/rotor_analysis.h"
#include "compare/result/result.h"

namespace rotorub {

// The first sentences on the terminal. For each speed: the nearest critical speed with its margin,
// the free orbit at each contact against its clearance, and the stable rubs with their forces.
std::vector<result::Part> summary_parts(const RotorAnalysis& analysis);

// Where a whirl grows, also as JSON. Where the closed loop of magnetic bearings is unstable or
// unknown at a speed, that replaces the stability of the whirl, which leaves out parts of the
// controls.
std::vector<result::Part> stability_parts(const RotorAnalysis& analysis);

// "3600 rpm (377.0 rad/s)". speed: rad/s.
std::string speed_text(double speed);
// A number with four significant digits and groups of thousands: "170,000".
std::string grouped(double value);

}  // namespace rotorub
