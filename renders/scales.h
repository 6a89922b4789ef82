// The scales of a film: one for all runs that are shown together, so that lengths and heights can
// be compared.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renders/playback.h"

namespace rotorub::renders {

// From a value to a share of a height or length.
struct ValueScale {
  double low = 0.0, high = 1.0;      // value at share 0 and at share 1; low < high
  bool logarithmic = false;          // then low > 0
  double share(double value) const;  // [0, 1]: what is beyond is clipped
  bool clips(double value) const { return value > high; }
};

struct Scales {
  ValueScale force;    // N, normal force; high 0: no contact. Logarithmic where runs are far apart
  ValueScale control;  // N, size of the control force; high 0: there is none
  ValueScale current;  // A, of a coil, either sign; high 0: there is none
  ValueScale gap;      // um
  ValueScale impulse;  // N s, normal, of an impact
  bool impulses = false;  // a run has impacts and no lasting contact: impulses say more than forces
};

// Over the rows from `from` to `to`, s. `clearance` in m, 0 without a contact. Forces and gaps
// leave out the largest 2 % and 1 % of each run's rows in contact and from the first touch on.
Scales make_scales(std::span<const Playback* const> runs, double from, double to, double clearance);

// "14,050 N", "0.0512 N s", "3.1 µm": four digits at most, thousands apart.
std::string value_text(double value, const std::string& unit);
std::string length_text(double metres);  // in mm from 0.1 mm on, else in µm

}  // namespace rotorub::renders
