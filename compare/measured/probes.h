// Probes that are not aligned with x and y: two that measure one place along other directions, such
// as the probes of API 670 at 45 degrees to either side of the vertical.
#pragma once

#include "compare/measured/record.h"

namespace rotorub {

// Takes `rotor_x` and `rotor_y` of a record, and `ring_x` and `ring_y`, as the place along
// directions (cos a, sin a) at these angles (rad, in the scene, from x to y), and replaces them by
// x and y of the scene:
//
//   [cos a  sin a] [x]   [m_1]
//   [cos b  sin b] [y] = [m_2]
//
// If one probe lacks a value or is at its limit, both new values are missing or clipped; clipped
// samples are marked first. Throws MeasuredError if a probe of a pair is missing, if there is no
// pair, or if the directions are within kLeastApart of one line.
void resolve_probes(MeasuredRecord& record, double first, double second);

inline constexpr double kLeastApart = 0.26;  // rad, 15 degrees: errors grow as 1 / sin

}  // namespace rotorub
