// Probes that do not stand along x and y: two that see one place along directions of their own, as
// those of API 670, 45 degrees to either side of the vertical.
#pragma once

#include "compare/measured/record.h"

namespace rotorub {

// What `rotor_x` and `rotor_y` of a record are, and `ring_x`, `ring_y`: the place along directions
// at these angles (rad, in the scene, from x to y), (cos a, sin a). Puts x and y of the scene in
// their place,
//
//   [cos a  sin a] [x]   [m_1]
//   [cos b  sin b] [y] = [m_2]
//
// and a sample of which one probe has no value, or is at its limit, has or is none of either;
// clipped samples are marked first. Throws MeasuredError where one of a pair is missing, where
// there is no pair, and where the directions are within kLeastApart of one line.
void resolve_probes(MeasuredRecord& record, double first, double second);

inline constexpr double kLeastApart = 0.26;  // rad, 15 degrees: errors grow by 1 / sin

}  // namespace rotorub
