// Samples of a sensor at its limit: the record says "at least so much", and no more.
#pragma once

#include "compare/measured/record.h"

namespace rotorub {

// At the least and the greatest value of a column with a limit (Measurable::clips) samples are
// marked kClipped where the record comes to that value, stays for kLeastClipped samples or more,
// bit for bit, and leaves it or ends, and does so faster than a peak of its own would (what it
// begins with may be a machine at rest):
//
//   flat part   l l l ... l, of more samples than any other equal values in a row but 0
//   both ends   the sample outside is more than kSteps of the record's resolution away from l; or a
//   parabola through
//               the three samples outside would pass l by as much at the second sample inside
//
// The resolution is the least difference of two values: a converter's peak is flat too, but comes
// there in steps of one. 0 is no limit: it is where a force without contact, a ring at rest, or a
// gap in contact stays. A limit that is met once counts for every sample that has its value.
void mark_clipped(MeasuredRecord& record);

inline constexpr std::size_t kLeastClipped = 3;
inline constexpr double kSteps =
    10.0;  // more than 1/2 (6 + 8 + 3), what rounding does to the parabola

}  // namespace rotorub
