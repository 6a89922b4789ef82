// The amplitude of a mode: 1 at the contact, so that the deflection there is the plain sum of the
// modal coordinates (design section 2, Scaling).
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace rotorub {

struct ModeScale {
  double factor;   // multiplies the mode
  double contact;  // 1, mode value at the contact after scaling: exactly 1, or 0 for a node there
};

// value(z): the unscaled mode along the shaft. Scaled to 1 at `contact` (m); where the mode has a
// node there (below 1e-6 of its largest value), and where there is no contact, to 1 at the largest
// value among `stations` (m, ascending) and the peaks between them; of several equally large ones
// the first. Without a contact the value there counts as 1.
ModeScale mode_scale(const std::function<double(double)>& value,
                     const std::vector<double>& stations, std::optional<double> contact);

}  // namespace rotorub
